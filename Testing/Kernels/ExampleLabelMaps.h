/**
 * Label maps for the tests, and what is expected of the surfaces of any.
 */
#ifndef ExampleLabelMaps_h
#define ExampleLabelMaps_h

#include "Geometry/SelfIntersection.h"
#include "LabelSurface/LabelSurfaces.h"
#include "Mesh/SurfaceTopology.h"
#include "Mesh/SurfaceVoxelization.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace FlipFree
{

struct LabelMap
{
  explicit LabelMap(int i, int j, int k)
  {
    this->Geometry.Dimensions = { { i, j, k } };
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), 0);
  }
  ImageView<int> View() const { return { this->Voxels.data(), this->Geometry }; }
  int& At(int i, int j, int k) { return this->Voxels[this->Geometry.Offset(i, j, k)]; }

  ImageGeometry Geometry;
  std::vector<int> Voxels;
};

inline LabelSurfaces SurfacesOf(const LabelMap& map, const LabelSurfaceSettings& settings,
  const ParallelFor& parallelFor = SerialFor)
{
  return MakeLabelSurfaces(MakeLabelGrid(map.View(), {}, "the label map", parallelFor),
    map.Geometry, settings, parallelFor);
}

inline LabelSurfaceSettings ExactSettings(int iterations = 50)
{
  LabelSurfaceSettings settings;
  settings.Exact = true;
  settings.Iterations = iterations;
  return settings;
}

/// Whether the triangles at each vertex are one fan.
inline bool HasDisksOnly(const LabelBoundary& boundary)
{
  std::vector<std::map<int, int>> next(boundary.Points.rows());
  std::vector<std::size_t> counts(boundary.Points.rows(), 0);
  for (Eigen::Index triangle = 0; triangle < boundary.Triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int vertex = boundary.Triangles(triangle, corner);
      next[vertex][boundary.Triangles(triangle, (corner + 1) % 3)] =
        boundary.Triangles(triangle, (corner + 2) % 3);
      ++counts[vertex];
    }
  }
  for (std::size_t vertex = 0; vertex < next.size(); ++vertex)
  {
    const int first = next[vertex].begin()->first;
    int now = first;
    std::size_t turns = 0;
    do
    {
      const auto found = next[vertex].find(now);
      if (found == next[vertex].end())
      {
        return false;
      }
      now = found->second;
      ++turns;
    } while (now != first && turns <= counts[vertex]);
    if (turns != counts[vertex])
    {
      return false;
    }
  }
  return true;
}

/// All that is promised of any label map, without self-intersections, which take longer.
inline void ExpectManifold(const LabelSurfaces& surfaces)
{
  ASSERT_TRUE(surfaces.Complete);
  const TrianglesByLabel triangles(surfaces.Walls, surfaces.Values.size());
  for (std::size_t index = 0; index < surfaces.Measures.size(); ++index)
  {
    const LabelMeasures& measures = surfaces.Measures[index];
    const LabelBoundary boundary = triangles.BoundaryOf(static_cast<int>(index) + 1);
    const FaceList faces = FacesOf(boundary.Triangles);
    const SurfaceTopology topology =
      MeasureTopology(faces, CollectEdges(static_cast<int>(boundary.Points.rows()), faces));
    EXPECT_EQ(topology.BoundaryEdges, 0) << measures.Label;
    EXPECT_EQ(topology.NonManifoldEdges, 0) << measures.Label;
    EXPECT_EQ(topology.MisorientedEdges, 0) << measures.Label;
    EXPECT_TRUE(HasDisksOnly(boundary)) << measures.Label;
    EXPECT_EQ(topology.EulerNumber(), measures.EulerNumber);
    EXPECT_EQ(topology.Faces, measures.Triangles);
    EXPECT_GT(EnclosedVolume(boundary.Points, boundary.Triangles), 0);
    EXPECT_NEAR(EnclosedVolume(boundary.Points, boundary.Triangles), measures.Volume,
      1e-9 * measures.VoxelVolume);
  }
}

inline void ExpectEmbedded(const LabelSurfaces& surfaces)
{
  EXPECT_EQ(CountSelfIntersections(surfaces.Walls.Points, FacesOf(surfaces.Walls.Triangles)), 0);
}

/// Voxelized by the kernel that is meant for one surface.
inline void ExpectSameVoxels(const LabelMap& map, const LabelSurfaces& surfaces)
{
  std::vector<int> voxels(map.Voxels.size(), 0);
  const TrianglesByLabel triangles(surfaces.Walls, surfaces.Values.size());
  for (int label = 1; label < static_cast<int>(surfaces.Values.size()); ++label)
  {
    const LabelBoundary boundary = triangles.BoundaryOf(label);
    FillRuns(VoxelizeSurface(boundary.Points, boundary.Triangles, map.Geometry),
      surfaces.Values[label], map.Geometry, voxels.data());
  }
  EXPECT_EQ(voxels, map.Voxels);
  EXPECT_EQ(surfaces.WrongVoxels, 0U);
}

inline LabelMap RandomMap(std::mt19937& random, int size, int labels)
{
  LabelMap map(size, size, size);
  std::uniform_int_distribution<int> label(0, labels);
  for (int& voxel : map.Voxels)
  {
    voxel = label(random);
  }
  return map;
}

/// Two balls that overlap, and a box behind both.
inline LabelMap TwoBallsAndBox(int size)
{
  LabelMap map(size, size, size);
  for (int k = 0; k < size; ++k)
  {
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        const Eigen::Vector3d place = Eigen::Vector3d(i, j, k) / size;
        const bool isInBox =
          place.z() > 0.55 && (place.array() > 0.15).all() && (place.array() < 0.85).all();
        map.At(i, j, k) = (place - Eigen::Vector3d(0.35, 0.5, 0.4)).norm() < 0.25 ? 3
          : (place - Eigen::Vector3d(0.65, 0.5, 0.4)).norm() < 0.25               ? 700
          : isInBox                                                               ? 2147483647
                                                                                  : 0;
      }
    }
  }
  return map;
}

} // namespace FlipFree

#endif
