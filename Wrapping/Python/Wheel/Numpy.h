/**
 * Between numpy's arrays and the kernels' types, without copies: views of arrays that come in, and
 * arrays that own what goes out.
 */
#ifndef FlipFreeNumpy_h
#define FlipFreeNumpy_h

#include "KernelTypes.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace FlipFree
{

namespace nb = nanobind;

/// Voxels [k, j, i] of any type, one behind the other. Numpy's array lives as long as this.
using Voxels = nb::ndarray<nb::numpy, nb::ro, nb::ndim<3>, nb::c_contig, nb::device::cpu>;
using Rows3 = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<nb::numpy, const int, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Triple = std::array<double, 3>;
using Nine = std::array<double, 9>;

inline ImageGeometry GeometryOf(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction)
{
  ImageGeometry geometry;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t size = voxels.shape(2 - axis);
    if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    {
      throw std::invalid_argument("the image has more than 2^31 - 1 voxels along an axis");
    }
    geometry.Dimensions[axis] = static_cast<int>(size);
  }
  geometry.Spacing = Eigen::Vector3d(spacing.data());
  geometry.Origin = Eigen::Vector3d(origin.data());
  geometry.Direction = Eigen::Map<const RowMajorMatrix>(direction.data());
  return geometry;
}

/// Returns visit(view) for voxels in their own type.
template <typename Visit>
auto VisitVoxels(const Voxels& voxels, const ImageGeometry& geometry, const Visit& visit)
{
  const auto as = [&](auto zero)
  {
    using T = decltype(zero);
    return visit(ImageView<T>{ static_cast<const T*>(voxels.data()), geometry });
  };
  const nb::dlpack::dtype type = voxels.dtype();
  if (type == nb::dtype<std::int8_t>())
  {
    return as(std::int8_t());
  }
  if (type == nb::dtype<std::uint8_t>())
  {
    return as(std::uint8_t());
  }
  if (type == nb::dtype<std::int16_t>())
  {
    return as(std::int16_t());
  }
  if (type == nb::dtype<std::uint16_t>())
  {
    return as(std::uint16_t());
  }
  if (type == nb::dtype<std::int32_t>())
  {
    return as(std::int32_t());
  }
  if (type == nb::dtype<std::uint32_t>())
  {
    return as(std::uint32_t());
  }
  if (type == nb::dtype<std::int64_t>())
  {
    return as(std::int64_t());
  }
  if (type == nb::dtype<std::uint64_t>())
  {
    return as(std::uint64_t());
  }
  if (type == nb::dtype<float>())
  {
    return as(float());
  }
  if (type == nb::dtype<double>())
  {
    return as(double());
  }
  throw std::invalid_argument(
    "the voxels are of a type that is none of numpy's integers or floats of up to 64 bits");
}

/// An array that owns a container with data(), such as a std::vector or an Eigen matrix.
template <typename T, typename Container>
nb::object ArrayOf(Container&& container, std::initializer_list<std::size_t> shape)
{
  auto* const kept = new std::decay_t<Container>(std::forward<Container>(container));
  const nb::capsule owner(kept,
    [](void* p) noexcept { delete static_cast<std::decay_t<Container>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(kept->data(), shape, owner));
}

} // namespace FlipFree

#endif
