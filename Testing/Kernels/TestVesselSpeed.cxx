// How fast a path may run, by the depth of the body that it runs through.
#include "ExampleSurfaces.h"
#include "Vessel/VesselStyle.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// Within a body of the vessel's gray value that is so deep, in millimeters; `radius` is the
// vessel's.
double SpeedAtDepth(VesselSpeedSettings settings, double depth, double radius)
{
  settings.TopHat = 0;
  settings.Tube = 0;
  FloatImage image;
  image.Geometry = Grid({ { 3, 3, 3 } }, { 1.5, 1.5, 1.5 });
  image.Voxels.assign(image.Geometry.NumberOfVoxels(), 100);
  VesselIntensities intensities;
  intensities.Low = intensities.High = 100;
  const std::vector<float> depths(image.Voxels.size(), static_cast<float>(depth));
  const FloatImage speed =
    MakeVesselSpeed(image, {}, intensities, depths, radius, settings, SerialFor);
  return speed.Voxels[image.Geometry.Offset(1, 1, 1)] - settings.Floor;
}

} // namespace

// Else a path would leave a branch near its end for something wider.
TEST(VesselSpeed, OfAThinVesselIsFullInABranchThinnerThanTheGivenRadius)
{
  for (const double radius : { 3.0, 5.0, 6.9 })
  {
    SCOPED_TRACE(radius);
    EXPECT_NEAR(SpeedAtDepth(ThinVessel().Speed, 3, radius), 1, 1e-6);
    EXPECT_NEAR(SpeedAtDepth(ThinVessel().Speed, 1.5, radius), 0.5, 1e-6);
  }
}

TEST(VesselSpeed, OfAWideVesselIsFullOnlyInItsMiddle)
{
  const VesselSpeedSettings wide = VesselStyle().Speed;
  EXPECT_NEAR(SpeedAtDepth(wide, 3, 6), 0.5, 1e-6);
  EXPECT_NEAR(SpeedAtDepth(wide, 6, 6), 1, 1e-6);
  EXPECT_NEAR(SpeedAtDepth(wide, 7, 20), 1, 1e-6);
}

TEST(VesselSpeed, FallsInBodiesThatAreNoVessels)
{
  const VesselSpeedSettings thin = ThinVessel().Speed;
  EXPECT_NEAR(SpeedAtDepth(thin, 12, 3), 1, 1e-6);
  EXPECT_NEAR(SpeedAtDepth(thin, 24, 3), 0.125, 1e-6); // the cube of 12 of 24 mm
  EXPECT_NEAR(SpeedAtDepth(thin, 14, 6.5), 1, 1e-6);   // of a given radius, up to 2.2 of it
  EXPECT_LT(SpeedAtDepth(VesselStyle().Speed, 14, 6.5), 0.7);
}
