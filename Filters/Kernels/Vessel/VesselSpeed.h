/**
 * Where a vessel may run: a speed per voxel for the search of its path. The path decides the
 * result, so speed falls off not only with the distance of a gray value from those at the clicked
 * points, but also at edges, near the rim of the like voxels, and within wide bodies, through which
 * shortcuts would lead; of a thin vessel also where there is nothing like a tube.
 */
#ifndef FlipFreeVesselSpeed_h
#define FlipFreeVesselSpeed_h

#include "Image/SeedRegion.h"

#include <vector>

namespace FlipFree
{

/// Gray values of a vessel: a range, along which contrast medium mixes, and how they scatter.
struct VesselIntensities
{
  double Low = 0;
  double High = 0;
  double Deviation = 1;

  /// The distance of a gray value from the range, in two standard deviations.
  double Distance(double value) const
  {
    return std::max({ 0.0, this->Low - value, value - this->High }) / (2 * this->Deviation);
  }
};

struct VesselSpeedSettings
{
  double MinimumBall = 2.2; ///< radius of the balls around the points, mm
  double MaximumBall = 4;
  bool Bright = false; ///< the vessel is brighter than what surrounds it
  double HighAllowance = 0;
  double MinimumDeviation = 10;
  double MaximumDeviation = 25;
  double EdgeStrength = 25; ///< gray values per mm

  double MinimumCap = 3; ///< mm
  double MaximumCap = 7;
  double BodyScale = 1.5; ///< of depth
  double MinimumBody = 12;

  double TopHat = 0; ///< 0: none
  double Tube = 0;   ///< tubeness at which speed is half of what it is in a vessel; 0: not asked
  double TubeDeviation = 3; ///< mm
  double Floor = 0.002;
};

/// From balls around the points. `depth`: radius of the vessel, about.
VesselIntensities IntensitiesAtPoints(const ImageView<float>& image, const PointList& points,
  double radius, const VesselSpeedSettings& settings);

/// Distance of the voxels like the vessel to the nearest that is not, in mm.
std::vector<float> DepthOf(const ImageView<float>& image, const VesselIntensities& intensities,
  const ParallelFor& parallelFor);

/// What the speed needs of an image whatever the points are: empty where the settings do not ask.
struct SpeedScales
{
  FloatImage Background; ///< averages over the window of the top hat
  FloatImage Tubes;      ///< smoothed by the deviation for tubes
};

SpeedScales MakeSpeedScales(const FloatImage& image, const VesselSpeedSettings& settings,
  const ParallelFor& parallelFor);

FloatImage MakeVesselSpeed(const FloatImage& image, const SpeedScales& scales,
  const VesselIntensities& intensities, const std::vector<float>& depth, double radius,
  const VesselSpeedSettings& settings, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
