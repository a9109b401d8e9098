#include "Vessel/VesselStyle.h"

namespace FlipFree
{

VesselStyle ThinVessel()
{
  VesselStyle style;
  style.SnapDistance = 5;
  style.Margin = 38;
  style.Speed.Bright = true;
  style.Speed.HighAllowance = 40;
  // These two tell only where users give a radius.
  style.Speed.MaximumCap = 3;
  style.Speed.BodyScale = 2.2;
  style.Speed.TopHat = 7.5;
  style.Speed.Tube = 10;
  style.Sections.EdgeWeight = 15;
  style.Sections.PriorWeight = 0.1;
  style.Sections.PriorFollow = 0.5;
  style.Sections.AlongWeight = 0.08;
  return style;
}

VesselStyle FarVessel()
{
  VesselStyle style;
  style.Margin = 120;
  style.GridSpacing = 2.5;
  return style;
}

} // namespace FlipFree
