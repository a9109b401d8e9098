/**
 * Voxels without data: those that are no finite number as floats, such as the padding around a
 * resampled image, what lies outside the field of view, and what a mask hides. They are to an image
 * as its end is: nothing flows across their border, nothing is learned from them, and they are
 * never foreground, so a surface may lie along them, not in them. What an organ encloses, such as a
 * hole, is inside its surface as any hole is.
 */
#ifndef FlipFreeNoData_h
#define FlipFreeNoData_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/BitMask.h"
#include "Image/PointConstraint.h"

#include <string>

namespace FlipFree
{

inline bool HasData(float value)
{
  return std::isfinite(value);
}

/// The voxels without data; an empty mask without any.
BitMask FindNoData(const VoxelReader& read, const ImageGeometry& geometry,
  const ParallelFor& parallelFor);

/// Removes from a mask, which is on the grid of the voxels that `read` reads, those without data.
void RemoveNoData(const VoxelReader& read, const ParallelFor& parallelFor, BitMask& mask);

/// Throws Error unless all voxels of a seed sphere, named by `name`, have data; if it holds none,
/// the one next to its center. `remedy` says what to do.
void RequireData(const VoxelReader& read, const ImageGeometry& geometry, const SeedSphere& seed,
  const std::string& name = "the seed sphere",
  const std::string& remedy = "move {SeedCenter}, or lower {SeedRadius}");

/// Likewise for the voxel that a point lies in.
void RequireData(const VoxelReader& read, const ImageGeometry& geometry,
  const Eigen::Vector3d& point, const std::string& name);

/// Throws Error, naming it, where a constraint that the surface must hold or touch lies in a voxel
/// without data.
void RequireData(const VoxelReader& read, const ImageGeometry& geometry,
  const ConstraintList& constraints);

} // namespace FlipFree

#endif
