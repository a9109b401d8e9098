#include "Vessel/VesselProvenance.h"

#include "Deformation/Provenance.h"
#include "JsonText.h"
#include "Vessel/VesselParameters.h"

#include <vector>

namespace FlipFree
{

std::string ProvenanceOf(const PointList& points, const ConstraintList& constraints,
  const VesselSegmentationSettings& settings, const ImageGeometry& geometry)
{
  std::vector<std::string> places;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    const Eigen::Vector3d place = points.row(point);
    places.push_back(JsonOf(place.data(), 3));
  }
  ParameterTable<VesselSegmentationSettings> parameters;
  for (const auto& parameter : VesselParameters())
  {
    if (parameter.Name != "LabelValue") // which changes no surface
    {
      parameters.push_back(parameter);
    }
  }
  return SessionOf(geometry,
    { R"({"name":"vessel","kind":"vessel","color":")" + DefaultColor(0) + R"(","points":)" +
      JsonList(places) + ",\"parameters\":" + JsonOf(parameters, settings) +
      (constraints.empty() ? "" : ",\"corrections\":" + JsonOf(constraints)) + "}" });
}

} // namespace FlipFree
