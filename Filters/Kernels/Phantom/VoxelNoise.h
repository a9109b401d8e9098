/**
 * Random numbers by a hash of seed and position. A voxel's number does not depend on how the volume
 * is divided into parts and threads.
 */
#ifndef FlipFreeVoxelNoise_h
#define FlipFreeVoxelNoise_h

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace FlipFree
{

/// A uniform number in [0, 1). Indices may be negative.
double PositionUniform(std::uint64_t seed, int i, int j, int k);

/// Throws Error unless AddNoise accepts these.
void RequireNoise(double standardDeviation, double correlation);

/// Adds a normal number of mean 0 to each voxel of a box, x fastest. As in a reconstructed CT, the
/// noise is correlated within a slice: `correlation`, in [0, 0.7], is that of direct neighbors;
/// slices are independent. `first` is the index of the box's first voxel in the volume.
void AddNoise(std::uint64_t seed, double standardDeviation, double correlation,
  const Eigen::Array3i& first, const Eigen::Array3i& size, float* values);

/// A smooth random field of mean 0 and standard deviation 1 that varies over about `cell` mm.
class SmoothField
{
public:
  /// Covers the box of the given extent around the origin, or 64 cells of it. Outside, the values
  /// at its boundary are continued.
  SmoothField(std::uint64_t seed, double cell, const Eigen::Vector3d& extent);

  double operator()(const Eigen::Vector3d& point) const;

private:
  double InverseCell;
  Eigen::Vector3d First;
  Eigen::Array3i Size;
  std::vector<float> Nodes;
};

} // namespace FlipFree

#endif
