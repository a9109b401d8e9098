#include "Image/NoData.h"

#include "Error.h"
#include "Image/VoxelOffsets.h"
#include "MessageText.h"

#include <vector>

namespace FlipFree
{
namespace
{

// The first voxel of the list without data, or the list's end.
std::vector<std::size_t>::const_iterator FindNoData(const VoxelReader& read,
  const ImageGeometry& geometry, const std::vector<std::size_t>& voxels)
{
  return std::find_if(voxels.begin(), voxels.end(),
    [&](std::size_t voxel)
    {
      const auto [i, j, k] = IndexOf(voxel, geometry);
      float value = 0;
      read(i, i + 1, j, k, &value);
      return !HasData(value);
    });
}

void RequireDataAt(const VoxelReader& read, const ImageGeometry& geometry,
  const std::vector<std::size_t>& voxels, const std::string& name, const std::string& remedy)
{
  const auto found = FindNoData(read, geometry, voxels);
  if (found != voxels.end())
  {
    const auto [i, j, k] = IndexOf(*found, geometry);
    throw Error(ErrorCode::NonFiniteValue,
      name + " touches a voxel without data (not a finite number), at " +
        TextOf(geometry.ToPhysical(Eigen::Vector3d(i, j, k))) + " mm; " + remedy);
  }
}

} // namespace

void RemoveNoData(const VoxelReader& read, const ParallelFor& parallelFor, BitMask& mask)
{
  parallelFor(0, mask.GetGeometry().Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::array<float, BitMask::BitsOfWord> values{};
      mask.ForEachRun(first, last,
        [&](int begin, int end, int j, int k)
        {
          read(begin, end, j, k, values.data());
          for (int i = begin; i < end; ++i)
          {
            if (!HasData(values[i - begin]))
            {
              mask.RemoveRun(i, i + 1, j, k);
            }
          }
        });
    });
}

void RequireData(const VoxelReader& read, const ImageGeometry& geometry, const SeedSphere& seed,
  const std::string& name, const std::string& remedy)
{
  RequireDataAt(read, geometry, VoxelsAround(geometry, seed), name, remedy);
}

void RequireData(const VoxelReader& read, const ImageGeometry& geometry,
  const Eigen::Vector3d& point, const std::string& name)
{
  const auto [i, j, k] = NearestVoxel(geometry, point);
  RequireDataAt(read, geometry, { geometry.Offset(i, j, k) }, name, "move it, or remove it");
}

void RequireData(const VoxelReader& read, const ImageGeometry& geometry,
  const ConstraintList& constraints)
{
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Seed)
    {
      RequireData(read, geometry, { constraint.Point, constraint.Radius },
        "the sphere of " + NameOf(constraint), "move it, or lower its radius");
    }
    else if (constraint.Kind != ConstraintKind::Outside)
    {
      RequireData(read, geometry, constraint.Point, NameOf(constraint));
    }
  }
}

} // namespace FlipFree
