/**
 * Random numbers that depend on where they are used, not on when: a hash of seed and position. What
 * one voxel gets is the same however the volume is cut into parts and threads.
 */
#ifndef FlipFreeVoxelNoise_h
#define FlipFreeVoxelNoise_h

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <vector>

namespace FlipFree
{

/// 64 well-mixed bits for a position; indices may be negative.
std::uint64_t PositionHash(std::uint64_t seed, int i, int j, int k);

/// In [0, 1).
double PositionUniform(std::uint64_t seed, int i, int j, int k);

/// Mean 0, deviation 1.
double PositionNormal(std::uint64_t seed, int i, int j, int k);

/// Throws where AddNoise could not work with these.
void RequireNoise(double deviation, double correlation);

/// Adds to each voxel of a box, x fastest, a normal number of mean 0 and the given deviation. As
/// the reconstruction kernel of a CT does it, the noise of neighbors within a slice is correlated:
/// `correlation`, in [0, 0.7], is that of direct neighbors; slices are independent. `first` is the
/// index of the box's first voxel in the volume.
void AddNoise(std::uint64_t seed, double deviation, double correlation,
  const std::array<int, 3>& first, const std::array<int, 3>& size, float* values);

/// A smooth random field: mean 0, deviation 1, varying over about `cell` mm.
class SmoothField
{
public:
  /// Covers the box of the given extent around the origin, or 64 cells of it; outside, what is at
  /// the rim goes on.
  SmoothField(std::uint64_t seed, double cell, const Eigen::Vector3d& extent);

  double operator()(const Eigen::Vector3d& point) const;

private:
  double InverseCell;
  Eigen::Vector3d First;
  std::array<int, 3> Size;
  std::vector<float> Nodes;
};

} // namespace FlipFree

#endif
