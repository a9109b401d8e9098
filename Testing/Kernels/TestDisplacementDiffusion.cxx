#include "Deformation/DisplacementDiffusion.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

CorrespondenceField AllSolitary(int count)
{
  CorrespondenceField field;
  field.Displacements = PointList::Zero(count, 3);
  field.States.assign(count, VertexState::Solitary);
  return field;
}

void Match(CorrespondenceField& field, int vertex, const Eigen::RowVector3d& displacement)
{
  field.States[vertex] = VertexState::Matched;
  field.Displacements.row(vertex) = displacement;
}

} // namespace

TEST(DisplacementDiffusion, AConstantFieldIsCompletedAndStays)
{
  const TestSphere sphere(6);
  const Eigen::RowVector3d constant(1, -2, 3);
  CorrespondenceField field = AllSolitary(sphere.Mesh.NumberOfPoints());
  for (int vertex = 0; vertex < sphere.Mesh.NumberOfPoints(); vertex += 5)
  {
    Match(field, vertex, constant);
  }
  DiffuseDisplacements(sphere.Mesh, { 20, 3 }, field);
  EXPECT_LT((field.Displacements.rowwise() - constant).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(DisplacementDiffusion, OneMatchedVertexReachesAsFarAsThePassesGo)
{
  const TestSphere sphere(6);
  const Eigen::RowVector3d only(0, 4, 0);
  std::vector<int> ring(sphere.Mesh.NumberOfPoints(), -1);
  ring[17] = 0;
  std::vector<int> front{ 17 };
  for (std::size_t at = 0; at < front.size(); ++at)
  {
    for (int neighbor : sphere.Mesh.Neighbors[front[at]])
    {
      if (ring[neighbor] < 0)
      {
        ring[neighbor] = ring[front[at]] + 1;
        front.push_back(neighbor);
      }
    }
  }
  for (int passes : { 0, 1, 3, 40 })
  {
    CorrespondenceField field = AllSolitary(sphere.Mesh.NumberOfPoints());
    Match(field, 17, only);
    DiffuseDisplacements(sphere.Mesh, { passes, 0 }, field);
    for (int vertex = 0; vertex < sphere.Mesh.NumberOfPoints(); ++vertex)
    {
      // The only displacement there is arrives undiminished; beyond its reach is rest.
      const Eigen::RowVector3d expected = only * (ring[vertex] <= passes ? 1.0 : 0.0);
      ASSERT_LT((field.Displacements.row(vertex) - expected).norm(), 1e-12) << vertex;
    }
  }
}

TEST(DisplacementDiffusion, AveragesStayWithinWhatIsGiven)
{
  std::mt19937 random(5);
  const TestSphere sphere(8);
  const int count = sphere.Mesh.NumberOfPoints();
  const PointList noise = WhiteNoise(count, 3.0, random);
  CorrespondenceField field = AllSolitary(count);
  Eigen::RowVector3d low = Eigen::RowVector3d::Constant(1e9);
  Eigen::RowVector3d high = -low;
  for (int vertex = 0; vertex < count; ++vertex)
  {
    if (random() % 4 == 0)
    {
      Match(field, vertex, noise.row(vertex));
      low = low.cwiseMin(noise.row(vertex));
      high = high.cwiseMax(noise.row(vertex));
    }
  }
  const CorrespondenceField given = field;
  DiffuseDisplacements(sphere.Mesh, { 30, 0 }, field);
  for (int vertex = 0; vertex < count; ++vertex)
  {
    if (given.States[vertex] == VertexState::Matched)
    {
      EXPECT_EQ(field.Displacements.row(vertex), given.Displacements.row(vertex));
    }
    EXPECT_TRUE((field.Displacements.row(vertex).array() >= low.array() - 1e-12).all());
    EXPECT_TRUE((field.Displacements.row(vertex).array() <= high.array() + 1e-12).all());
  }
  CorrespondenceField smooth = given;
  DiffuseDisplacements(sphere.Mesh, { 30, 4 }, smooth);
  EXPECT_TRUE((smooth.Displacements.colwise().minCoeff().array() >= low.array() - 1e-12).all());
  EXPECT_TRUE((smooth.Displacements.colwise().maxCoeff().array() <= high.array() + 1e-12).all());
  EXPECT_LT((smooth.Displacements.rowwise() - smooth.Displacements.colwise().mean()).norm(),
    (field.Displacements.rowwise() - field.Displacements.colwise().mean()).norm());
}

// After many passes each solitary vertex is the mean of itself and its neighbors: the discrete
// harmonic field, here by a direct solution.
TEST(DisplacementDiffusion, ConvergesToTheHarmonicField)
{
  std::mt19937 random(6);
  const TestSphere sphere(3);
  const int count = sphere.Mesh.NumberOfPoints();
  const PointList noise = WhiteNoise(count, 3.0, random);
  CorrespondenceField field = AllSolitary(count);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  for (int vertex = 0; vertex < count; ++vertex)
  {
    if (vertex % 9 == 0)
    {
      Match(field, vertex, noise.row(vertex));
      right.row(vertex) = noise.row(vertex);
    }
    else
    {
      for (int neighbor : sphere.Mesh.Neighbors[vertex])
      {
        matrix(vertex, neighbor) = -0.25;
      }
    }
  }
  DiffuseDisplacements(sphere.Mesh, { 2000, 0 }, field);
  const Eigen::MatrixXd harmonic = matrix.partialPivLu().solve(right);
  EXPECT_LT((field.Displacements - harmonic).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(DisplacementDiffusion, NothingMatchedStaysAtRest)
{
  const TestSphere sphere(3);
  CorrespondenceField field = AllSolitary(sphere.Mesh.NumberOfPoints());
  DiffuseDisplacements(sphere.Mesh, { 10, 2 }, field);
  EXPECT_TRUE(field.Displacements.isZero(0));
}
