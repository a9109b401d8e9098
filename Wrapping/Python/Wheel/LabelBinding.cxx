// Label maps: where their grids lie, and which label of a file is meant.
#include "Bindings.h"
#include "Numpy.h"

#include "Exchange/SegmentationLayers.h"
#include "Image/LatticePlacement.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>

namespace FlipFree
{
namespace
{

// Size, spacing, origin and direction.
using GridRow = std::tuple<std::array<int, 3>, Triple, Triple, Nine>;

ImageGeometry GridOf(const GridRow& row)
{
  const auto& [size, spacing, origin, direction] = row;
  ImageGeometry geometry;
  geometry.Dimensions = size;
  geometry.Spacing = Eigen::Vector3d(spacing.data());
  geometry.Origin = Eigen::Vector3d(origin.data());
  geometry.Direction = Eigen::Map<const RowMajorMatrix>(direction.data());
  return geometry;
}

bool AreSamePlaces(const GridRow& one, const GridRow& other)
{
  return HaveSamePlaces(GridOf(one), GridOf(other));
}

// The layer, and the value of the label if one was chosen.
std::pair<int, std::optional<int>> ChooseLabelOf(const std::map<std::string, std::string>& pairs,
  int numberOfLayers, const std::string& choice, const std::string& file)
{
  const LabelChoice chosen = ChooseLabel(SegmentsOf(pairs, file), numberOfLayers, choice, file);
  return { chosen.Layer, chosen.Label };
}

} // namespace

void BindLabels(nb::module_& module)
{
  module.def("choose_label", &ChooseLabelOf);
  module.def("have_same_places", &AreSamePlaces);
}

} // namespace FlipFree
