/**
 * A vessel between points: the path, its center and its outline.
 */
#ifndef FlipFreeVesselPath_h
#define FlipFreeVesselPath_h

#include "Vessel/CrossSections.h"
#include "Vessel/VesselSpeed.h"
#include "Image/SliceParts.h"
#include "Vessel/VesselImage.h"

namespace FlipFree
{

struct VesselPathSettings
{
  double Radius = 0; ///< of the vessel, about, mm; 0: from the image
  double Margin = 50;
  double SnapDistance = 0;
  double SmoothingDeviation = 0.8;
  double GridSpacing = 1.5;
  VesselSpeedSettings Speed;
  CrossSectionSettings Sections;
  double Wall = 0;
  double Isotropy = 0;
};

struct VesselBranch
{
  VesselSections Sections;
  int Parent = -1;
};

struct VesselTree
{
  std::vector<VesselBranch> Branches;
  double Radius = 0;
};

VesselTree TraceVessel(const VoxelReader& read, const ImageGeometry& geometry,
  const PointList& points, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor);

} // namespace FlipFree

#endif
