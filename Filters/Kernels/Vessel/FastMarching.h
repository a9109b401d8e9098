/**
 * Fast marching (J. A. Sethian: A fast marching level set method for monotonically advancing
 * fronts, 1996): when a front that spreads from some voxels arrives at others, if each voxel has
 * its own speed; and the fastest way back.
 */
#ifndef FlipFreeFastMarching_h
#define FlipFreeFastMarching_h

#include "Image/SeedRegion.h"

#include <vector>

namespace FlipFree
{

struct Arrivals
{
  /// Per voxel, in millimeters over speed; infinite where the front has not been.
  std::vector<float> Times;
  /// The targets that the front has reached, in the order of its arrival.
  std::vector<std::size_t> Reached;
  /// Of fronts that meet: per voxel, from which source it was reached; -1 where none has been.
  std::vector<int> Owners;
};

/// Solves |grad T| = 1 / speed by upwind differences of the first order, until the front has
/// reached `count` of the targets, or the time is `latest`. It does not enter voxels whose speed is
/// not positive. The monitor is asked now and then; if it stops it, nothing is reached.
Arrivals MarchFront(const ImageView<float>& speed, const std::vector<std::size_t>& sources,
  const std::vector<std::size_t>& targets, std::size_t count, float latest, const Monitor& monitor);

/// Where fronts from two of the sources meet that is on the fastest way between any two of them:
/// two neighbors, each reached from another source, the one with the smaller offset first. No
/// voxels where no two fronts meet, or where the monitor stops it. All fronts spread at once, each
/// half as far as one alone would have to. The order of the sources does not matter.
struct Meeting
{
  Arrivals Times;
  std::vector<std::size_t> Voxels;
};

Meeting MeetFronts(const ImageView<float>& speed, const std::vector<std::size_t>& sources,
  const Monitor& monitor);

/// From a voxel that the front has reached down the times to a source, by steps to the steepest of
/// the 26 neighbors, of those with the same owner: the voxels passed, the target first.
std::vector<std::size_t> DescendToSource(const Arrivals& arrivals, const ImageGeometry& geometry,
  std::size_t target);

} // namespace FlipFree

#endif
