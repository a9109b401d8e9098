/**
 * The radii of seed spheres, which options and sessions give: one check and one text for all.
 */
#ifndef FlipFreeCommandSeedRadius_h
#define FlipFreeCommandSeedRadius_h

#include "Image/SeedRegion.h"
#include "MessageText.h"

#include <string>

namespace Command
{

/// False for NaN, too.
inline bool IsSeedRadius(double radius)
{
  return radius >= FlipFree::MinimumSeedRadius && radius <= FlipFree::MaximumSeedRadius;
}

/// What a message says of any other radius, after its name.
inline std::string SeedRadiusRule(double radius)
{
  return "must be a positive number of millimeters, 1e-6 to 1e6, not " + FlipFree::TextOf(radius) +
    ". The sphere should lie within the organ";
}

} // namespace Command

#endif
