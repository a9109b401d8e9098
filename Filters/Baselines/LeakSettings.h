/**
 * Private to the module: how leaks of a mask are closed and cut, as vtkFlipFreeSegmentation does
 * it.
 */
#ifndef FlipFreeLeakSettings_h
#define FlipFreeLeakSettings_h

#include "BaselineTask.h"
#include "Intensity/LeakControl.h"

#include <algorithm>

namespace FlipFree
{

/// The radius of the opening follows that of the seed, between 2.5 and 6 mm and up to two voxels;
/// the radius of the closing also is two voxels at most. An opening scale of 0 means none.
inline LeakControlSettings LeakSettingsOf(const BaselineTask& task, double closingRadius,
  double openingScale)
{
  constexpr double least = 2.5;
  constexpr double greatest = 6;
  const double most = 2 * task.Region.Geometry.Spacing.maxCoeff();
  LeakControlSettings settings;
  settings.ClosingRadius = std::min(closingRadius, most);
  settings.OpeningRadius = openingScale > 0
    ? std::min(std::max(least, std::min(greatest, openingScale * task.Seed.Radius)), most)
    : 0;
  return settings;
}

} // namespace FlipFree

#endif
