// Voxel grids: where one lies on another.
#include "Bindings.h"
#include "Numpy.h"

#include "Image/LatticePlacement.h"

#include <nanobind/stl/array.h>

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

} // namespace

void BindGrids(nb::module_& module)
{
  module.def("have_same_places", &AreSamePlaces);
}

} // namespace FlipFree
