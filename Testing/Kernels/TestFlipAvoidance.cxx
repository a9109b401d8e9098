#include "Deformation/FlipAvoidance.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

// What every result must be: nothing flips, nothing is left marked, solitary vertices rest, and the
// others keep their targets.
void ExpectAvoided(const ContourMesh& mesh, const PointList& points, double r,
  const CorrespondenceField& before, CorrespondenceField after, int dropped)
{
  int lost = 0;
  for (std::size_t vertex = 0; vertex < after.States.size(); ++vertex)
  {
    ASSERT_NE(after.States[vertex], VertexState::Flipping);
    if (after.States[vertex] == VertexState::Solitary)
    {
      EXPECT_TRUE(after.Displacements.row(vertex).isZero(0));
      lost += before.States[vertex] != VertexState::Solitary;
    }
    else
    {
      EXPECT_NE(before.States[vertex], VertexState::Solitary);
      EXPECT_EQ(after.Displacements.row(vertex), before.Displacements.row(vertex));
    }
  }
  EXPECT_EQ(lost, dropped);
  EXPECT_EQ(DetectFlips(mesh, points, r, after), 0);
}

// One closed contour, a regular polygon; further ones can be appended.
struct Ring
{
  explicit Ring(int size)
    : Points(size, 3)
  {
    this->Mesh.Neighbors.resize(size);
    this->Mesh.Contours.resize(1);
    for (int vertex = 0; vertex < size; ++vertex)
    {
      const double angle = 2 * EIGEN_PI * vertex / size;
      this->Points.row(vertex) << 10 * std::cos(angle), 10 * std::sin(angle), 0;
      this->Mesh.Contours[0].push_back(vertex);
    }
    this->Field.Displacements = PointList::Zero(size, 3);
    this->Field.States.assign(size, VertexState::Matched);
  }

  void Target(int vertex, const Eigen::RowVector3d& target)
  {
    this->Field.Displacements.row(vertex) = target - this->Points.row(vertex);
  }
  void Swap(int one, int other)
  {
    this->Target(one, this->Points.row(other));
    this->Target(other, this->Points.row(one));
  }
  void Drop(int vertex)
  {
    this->Field.States[vertex] = VertexState::Solitary;
    this->Field.Displacements.row(vertex).setZero();
  }
  std::vector<int> With(VertexState state) const
  {
    std::vector<int> vertices;
    for (std::size_t vertex = 0; vertex < this->Field.States.size(); ++vertex)
    {
      if (this->Field.States[vertex] == state)
      {
        vertices.push_back(static_cast<int>(vertex));
      }
    }
    return vertices;
  }

  void ExpectAvoided(double r)
  {
    const CorrespondenceField before = this->Field;
    const int dropped = AvoidFlips(this->Mesh, this->Points, r, this->Field);
    ::ExpectAvoided(this->Mesh, this->Points, r, before, this->Field, dropped);
  }

  ContourMesh Mesh;
  PointList Points;
  CorrespondenceField Field;
};

using Vertices = std::vector<int>;

} // namespace

TEST(FlipDetection, NothingFlipsAtRestOrInAMotionOfTheWhole)
{
  Ring ring(12);
  EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.99, ring.Field), 0);
  ring.Field.Displacements.rowwise() = Eigen::RowVector3d(30, -20, 10);
  EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.99, ring.Field), 0);
  ring.Field.Displacements = 4 * ring.Points;
  EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.99, ring.Field), 0);
}

TEST(FlipDetection, AQuarterTurnedEdgeFlipsAccordingToR)
{
  for (double angle : { 0.2, 0.8, 1.3, 2.5 })
  {
    for (double r : { 0.0, 0.3, 0.7, 0.9 })
    {
      Ring ring(4);
      // Two vertices; the edge between them turns by the angle.
      ring.Drop(2);
      ring.Drop(3);
      ring.Points.row(0) << 0, 0, 0;
      ring.Points.row(1) << 1, 0, 0;
      ring.Target(1, 5 * Eigen::RowVector3d(std::cos(angle), std::sin(angle), 0));
      EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, r, ring.Field), std::cos(angle) < r ? 2 : 0);
    }
  }
}

TEST(FlipDetection, SolitaryVerticesAreSkippedAndCoincidentTargetsFlip)
{
  Ring ring(12);
  ring.Drop(4);
  ring.Drop(5);
  ring.Swap(3, 6);
  EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.3, ring.Field), 2);
  EXPECT_EQ(ring.With(VertexState::Flipping), (Vertices{ 3, 6 }));

  Ring other(12);
  other.Target(3, other.Points.row(4));
  EXPECT_EQ(DetectFlips(other.Mesh, other.Points, 0.0, other.Field), 2);
  EXPECT_EQ(other.With(VertexState::Flipping), (Vertices{ 3, 4 }));
  // Marks are those of the present targets.
  other.Target(3, other.Points.row(3));
  EXPECT_EQ(DetectFlips(other.Mesh, other.Points, 0.0, other.Field), 0);
  EXPECT_TRUE(other.With(VertexState::Flipping).empty());
}

// Wherever the contour begins.
TEST(FlipAvoidance, KeepsTheMiddleOfARun)
{
  for (int turn = 0; turn < 24; ++turn)
  {
    Ring ring(24);
    for (int vertex = 3; vertex <= 7; ++vertex)
    {
      ring.Target(vertex, ring.Points.row(10 - vertex)); // in reverse order
    }
    auto& contour = ring.Mesh.Contours[0];
    std::rotate(contour.begin(), contour.begin() + turn, contour.end());
    EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.3, ring.Field), 5);
    EXPECT_EQ(ring.With(VertexState::Flipping), (Vertices{ 3, 4, 5, 6, 7 }));
    ring.ExpectAvoided(0.3);
    EXPECT_EQ(ring.With(VertexState::Solitary), (Vertices{ 3, 4, 6, 7 })) << turn;
  }
}

TEST(FlipAvoidance, TwoRunsKeepOneEach)
{
  Ring ring(24);
  ring.Target(5, ring.Points.row(6));
  ring.Target(6, ring.Points.row(6));
  ring.Target(15, ring.Points.row(16));
  ring.Target(16, ring.Points.row(16));
  EXPECT_EQ(AvoidFlips(ring.Mesh, ring.Points, 0.3, ring.Field), 2);
  EXPECT_EQ(ring.With(VertexState::Solitary), (Vertices{ 5, 15 }));
}

TEST(FlipAvoidance, AContourThatFlipsAsAWholeKeepsOne)
{
  Ring ring(10);
  ring.Field.Displacements = -2 * ring.Points; // through the center: all edges reverse
  EXPECT_EQ(DetectFlips(ring.Mesh, ring.Points, 0.3, ring.Field), 10);
  EXPECT_EQ(AvoidFlips(ring.Mesh, ring.Points, 0.3, ring.Field), 9);
  EXPECT_EQ(ring.With(VertexState::Matched).size(), 1u);

  Ring collapsed(10);
  collapsed.Field.Displacements = -collapsed.Points; // all targets coincide
  EXPECT_EQ(AvoidFlips(collapsed.Mesh, collapsed.Points, 0.3, collapsed.Field), 9);
}

// A vertex that flips along one contour only must not be acquitted by the other one, whichever
// comes first.
TEST(FlipAvoidance, TheOrderOfContoursDoesNotHideAFlip)
{
  for (bool crossingFirst : { false, true })
  {
    Ring ring(20);
    ring.Swap(4, 5);
    // Two more contours that cross at 4 and 5, on which nothing flips.
    const std::vector<Vertices> crossing{ { 4, 12, 14 }, { 5, 15, 17 } };
    auto& contours = ring.Mesh.Contours;
    contours.insert(crossingFirst ? contours.begin() : contours.end(), crossing.begin(),
      crossing.end());
    ring.ExpectAvoided(0);
    EXPECT_FALSE(ring.With(VertexState::Solitary).empty());
  }
}

TEST(FlipAvoidance, AContourMayPassAVertexTwice)
{
  Ring ring(12);
  ring.Mesh.Contours[0] = { 0, 1, 2, 3, 4, 5, 3, 6, 7, 8, 9, 10, 11 };
  ring.Target(3, ring.Points.row(9));
  ring.Target(4, ring.Points.row(8));
  ring.Target(5, ring.Points.row(10));
  ring.ExpectAvoided(0.3);
}

TEST(FlipAvoidance, RandomTargetsOnASphereEndWithoutFlips)
{
  std::mt19937 random(9);
  for (int repeat = 0; repeat < 200; ++repeat)
  {
    const TestSphere sphere(1 + repeat % 9);
    const int count = sphere.Mesh.NumberOfPoints();
    CorrespondenceField field;
    field.States.assign(count, VertexState::Matched);
    field.Displacements = PointList::Zero(count, 3);
    const double length = sphere.EdgeLength * (0.2 + 0.4 * (repeat % 7));
    const PointList noise = WhiteNoise(count, length, random);
    // Few, many or all vertices move; some are solitary.
    for (int vertex = 0; vertex < count; ++vertex)
    {
      if (random() % 5 == 0)
      {
        field.States[vertex] = VertexState::Solitary;
      }
      else if (repeat % 3 == 0 || random() % 20 < 3)
      {
        field.Displacements.row(vertex) = noise.row(vertex);
      }
    }
    const double r = 0.1 * (repeat % 8);
    const CorrespondenceField before = field;
    const int dropped = AvoidFlips(sphere.Mesh, sphere.Points(), r, field);
    ExpectAvoided(sphere.Mesh, sphere.Points(), r, before, field, dropped);
  }
}
