#include "Deformation/TargetSearch.h"

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

// Along the normals, so that a displacement is told by one number; every seventh vertex is solitary
// and every eleventh far off.
struct Example
{
  explicit Example(int n)
    : Sphere(n)
  {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(2, 0.3);
    this->Normals = this->Sphere.Points().rowwise() - Eigen::RowVector3d(10, -20, 30);
    this->Normals.rowwise().normalize();
    const int size = this->Sphere.Mesh.NumberOfPoints();
    this->Field.Displacements = PointList::Zero(size, 3);
    this->Field.States.assign(size, VertexState::Solitary);
    for (int vertex = 0; vertex < size; ++vertex)
    {
      const double distance = noise(random) + (vertex % 11 == 0 ? 12 : 0);
      if (vertex % 7 != 3)
      {
        this->Field.Displacements.row(vertex) = distance * this->Normals.row(vertex);
        this->Field.States[vertex] = VertexState::Matched;
      }
    }
  }

  TestSphere Sphere;
  PointList Normals;
  CorrespondenceField Field;
};

double MedianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace

TEST(TargetSearch, RejectsWhatIsUnlikeTheTwoRing)
{
  const Example example(8);
  const ContourMesh& mesh = example.Sphere.Mesh;
  const Eigen::VectorXd distances =
    example.Field.Displacements.cwiseProduct(example.Normals).rowwise().sum();
  CorrespondenceField field = example.Field;
  RejectOutliers(mesh, example.Normals, 3, 1, SerialFor, field);
  int rejected = 0;
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    // As often as there are ways to a vertex of one or two edges, so often it counts.
    std::vector<double> ring;
    for (int first : mesh.Neighbors[vertex])
    {
      for (int member : { first, mesh.Neighbors[first][0], mesh.Neighbors[first][1],
             mesh.Neighbors[first][2], mesh.Neighbors[first][3] })
      {
        if (member != vertex && example.Field.States[member] == VertexState::Matched)
        {
          ring.push_back(distances[member]);
        }
      }
    }
    const double median = MedianOf(ring);
    for (double& distance : ring)
    {
      distance = std::abs(distance - median);
    }
    const bool isUnlike = std::abs(distances[vertex] - median) > 3 * 1.4826 * MedianOf(ring) + 1;
    const bool wasMatched = example.Field.States[vertex] == VertexState::Matched;
    EXPECT_EQ(field.States[vertex] == VertexState::Matched, wasMatched && !isUnlike) << vertex;
    EXPECT_EQ(field.Displacements.row(vertex).isZero(0), !wasMatched || isUnlike) << vertex;
    rejected += static_cast<int>(wasMatched && isUnlike);
  }
  EXPECT_GT(rejected, 10);
  EXPECT_LT(rejected, 60);
  CorrespondenceField parts = example.Field;
  RejectOutliers(mesh, example.Normals, 3, 1, ScatteredFor, parts);
  EXPECT_EQ(parts.Displacements, field.Displacements);
  EXPECT_EQ(parts.States, field.States);
}

// A box around a sphere, whose corners are farther away than a search line is long, and whose rough
// sides make outliers: these count as solitary, but have a boundary.
TEST(TargetSearch, OutliersAreNotWithoutBoundary)
{
  const TestSphere sphere(8);
  ImageGeometry geometry;
  geometry.Dimensions = { { 41, 41, 41 } };
  geometry.Spacing = { 2, 2, 2 };
  geometry.Origin = Eigen::Vector3d(10, -20, 30) - Eigen::Vector3d::Constant(40); // the sphere's
  BitMask foreground(geometry);
  std::mt19937 random(2);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const int from = std::max({ std::abs(i - 20), std::abs(j - 20), std::abs(k - 20) });
      if (from < 14 || (from < 16 && random() % 2 == 0))
      {
        foreground.Insert(i, j, k);
      }
    });
  const std::vector<float> edges(geometry.NumberOfVoxels(), 0);
  TargetSettings settings;
  settings.Correspondence.SearchDistance = 16;
  settings.Correspondence.RunLength = 0;
  settings.Correspondence.RunVoxels = 1;
  settings.Correspondence.ImageBoundaryDistance = 0;
  settings.Correspondence.EdgeWindow = 0;
  settings.MaximumDisplacement = 0;
  settings.OutlierStandardDeviations = 0;
  const auto search = [&]
  {
    TargetReport report;
    FindTargets(sphere.Mesh, sphere.Points(), foreground, {}, { edges.data(), geometry }, 10,
      settings, SerialFor, report);
    return report;
  };
  const TargetReport all = search();
  EXPECT_GT(all.Solitary, 0);
  EXPECT_GT(all.Matched, all.Solitary);
  EXPECT_EQ(all.WithoutBoundary, all.Solitary);
  settings.OutlierStandardDeviations = 1e-6;
  const TargetReport some = search();
  EXPECT_EQ(some.WithoutBoundary, all.Solitary);
  EXPECT_GT(some.Solitary, all.Solitary);
}

TEST(TargetSearch, FewNeighborsRejectNothing)
{
  Example example(4);
  std::fill(example.Field.States.begin(), example.Field.States.end(), VertexState::Solitary);
  example.Field.States[0] = VertexState::Matched;
  example.Field.Displacements.row(0) = 50 * example.Normals.row(0);
  RejectOutliers(example.Sphere.Mesh, example.Normals, 3, 1, SerialFor, example.Field);
  EXPECT_EQ(example.Field.States[0], VertexState::Matched);
}

TEST(TargetSearch, LimitsLengthsAndKeepsDirections)
{
  const Example example(4);
  CorrespondenceField field = example.Field;
  LimitDisplacements(2, field);
  for (Eigen::Index vertex = 0; vertex < field.Displacements.rows(); ++vertex)
  {
    const double before = example.Field.Displacements.row(vertex).norm();
    EXPECT_NEAR(field.Displacements.row(vertex).norm(), std::min(before, 2.0), 1e-12);
    EXPECT_NEAR(field.Displacements.row(vertex).dot(example.Field.Displacements.row(vertex)),
      before * std::min(before, 2.0), 1e-12);
  }
}
