/**
 * What it is worth to change the side of what lies around a point that is on the wrong side of a
 * mask: much where the gray values look like the point's, or like the organ's around an inside
 * point, and less with distance. A point in the depth of the wrong side stands for something large;
 * one near the right side may lie in a bump.
 */
#ifndef FlipFreePointWorth_h
#define FlipFreePointWorth_h

#include "Evidence/PointCorrection.h"
#include "Image/ImagePart.h"
#include "Intensity/GrayValueSimilarity.h"

namespace FlipFree
{

/// Gray values that the point's surroundings are compared with.
struct OrganGrayValues
{
  RobustStatistics OfSeed;  ///< in the seed
  RobustStatistics OfOrgan; ///< of the mask around the seed, farther from the point than its side
};

class PointWorth
{
public:
  /// Reads the image, on the grid `voxels`, within the point's distance from its side; it and the
  /// correction must outlive the object.
  PointWorth(const ImagePart& image, const ImageGeometry& voxels, const PointCorrection& correction,
    const GrayValueSimilarity& similarity, const OrganGrayValues& organ);

  /// Whether a place changes in any case.
  bool IsCertain(const Eigen::Vector3d& place) const;
  /// Per mm3, of a gray value at a place.
  double Of(double value, const Eigen::Vector3d& place) const;
  /// The same of an outside point, however far away it is, by the gray value alone.
  double OutsideOf(double value) const;

private:
  double ReachOfOrgan(const ImagePart& image, const ImageGeometry& voxels) const;

  const PointCorrection& Wanted;
  const GrayValueSimilarity& Similarity;
  const OrganGrayValues Organ;
  RobustStatistics AsVaried;  // the point's surroundings, as varied as the seed
  RobustStatistics NotVaried; // hardly more varied than it
  double Reach = 0;           // how far around the point the image looks like it
  double OrganReach = 0;      // or like the organ; of an inside point
  double Decay = 0;
};

} // namespace FlipFree

#endif
