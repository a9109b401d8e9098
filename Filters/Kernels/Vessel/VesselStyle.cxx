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
  style.Speed.MaximumCap = 3;
  style.Speed.TopHat = 7.5;
  style.Speed.Tube = 10;
  style.Sections.EdgeWeight = 15;
  style.Sections.PriorWeight = 0.1;
  style.Sections.PriorFollow = 0.5;
  style.Sections.AlongWeight = 0.08;
  style.Sections.AroundWeight = 0.15;
  style.Sections.IntensityWindow = 8;
  return style;
}

VesselStyle WideVessel()
{
  VesselStyle style;
  style.Speed.BodyScale = 1.5;
  style.Sections.DarkLimit = 60;
  style.Sections.BrightLimit = 22;
  style.Sections.EdgeWeight = 12;
  style.Sections.PriorWeight = 0.03;
  style.Sections.PriorFollow = 0.25;
  style.Sections.AlongWeight = 0.16;
  style.Sections.AroundWeight = 0.15;
  return style;
}

VesselStyle FarVessel()
{
  VesselStyle style = WideVessel();
  style.Margin = 120;
  style.GridSpacing = 2.5;
  return style;
}

} // namespace FlipFree
