/**
 * The parts of a shape that are connected by necks, from large parts, which only narrow necks
 * divide, to small ones.
 */
#ifndef FlipFreeNestedParts_h
#define FlipFreeNestedParts_h

#include "Image/DistanceParts.h"

#include <utility>
#include <vector>

namespace FlipFree
{

struct NestedPart
{
  std::vector<std::size_t> Voxels; ///< ascending; empty: there is no part
  double NeckRatio = 0;            ///< necks before it are narrower than this fraction of it
};

class NestedParts
{
public:
  /// Of the shape with these squared distances from its outside (FindDistanceParts()); `seed` are
  /// voxels that no part holds. Necks narrower than `narrowest` of a part divide even the largest.
  NestedParts(std::vector<float> squaredDistances, const ImageGeometry& geometry,
    const std::vector<std::size_t>& seed, double narrowest);

  const std::vector<float>& GetSquaredDistances() const { return this->Squared; }

  /// The largest part around a voxel that holds neither the seed nor one of `others`, and on top of
  /// which the voxel lies: its distance is at least `top` times the part's greatest.
  NestedPart PartAround(std::size_t voxel, const std::vector<std::size_t>& others,
    double top) const;

private:
  const std::vector<float> Squared;
  std::vector<std::pair<double, DistanceParts>> Levels; // by neck ratio, ascending
};

} // namespace FlipFree

#endif
