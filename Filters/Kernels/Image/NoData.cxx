#include "Image/NoData.h"

#include "Error.h"
#include "Image/VoxelOffsets.h"
#include "MessageText.h"

#include <algorithm>
#include <vector>

namespace FlipFree
{
namespace
{

// In vectors: zero times infinity or NaN is NaN.
bool AllHaveData(const std::vector<float>& row)
{
  const Eigen::Map<const Eigen::ArrayXf> values(row.data(), static_cast<Eigen::Index>(row.size()));
  return (0 * values).sum() == 0;
}

[[noreturn]] void RefuseVoxelAt(const Eigen::Vector3d& place, const std::string& name,
  const std::string& remedy)
{
  throw Error(ErrorCode::NonFiniteValue,
    name + " touches a voxel without data (not a finite number), at " + TextOf(place) + " mm; " +
      remedy);
}

void RequireDataAt(const VoxelReader& read, const ImageGeometry& geometry,
  const std::vector<std::size_t>& voxels, const std::string& name, const std::string& remedy)
{
  for (const std::size_t voxel : voxels)
  {
    const auto [i, j, k] = IndexOf(voxel, geometry);
    float value = 0;
    read(i, i + 1, j, k, &value);
    if (!HasData(value))
    {
      RefuseVoxelAt(geometry.ToPhysical(Eigen::Vector3d(i, j, k)), name, remedy);
    }
  }
}

} // namespace

BitMask FindNoData(const VoxelReader& read, const ImageGeometry& geometry,
  const ParallelFor& parallelFor)
{
  const auto& size = geometry.Dimensions;
  std::vector<unsigned char> lacksData(size[2], 0); // by slice
  const auto forEachRow = [&](const auto& visit)
  {
    parallelFor(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::vector<float> row(size[0]);
        for (int k = static_cast<int>(first); k < last; ++k)
        {
          for (int j = 0; j < size[1]; ++j)
          {
            read(0, size[0], j, k, row.data());
            visit(row, j, k);
          }
        }
      });
  };
  forEachRow(
    [&](const std::vector<float>& row, int, int k) { lacksData[k] |= AllHaveData(row) ? 0 : 1; });
  if (std::find(lacksData.begin(), lacksData.end(), 1) == lacksData.end())
  {
    return {};
  }
  BitMask mask(geometry);
  forEachRow(
    [&](const std::vector<float>& row, int j, int k)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        if (!HasData(row[i]))
        {
          mask.Insert(i, j, k);
        }
      }
    });
  return mask;
}

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
