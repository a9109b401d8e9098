/**
 * A volume in the module's memory: copied once, and used by as many runs as are wanted. Doubles are
 * kept as floats, as which the kernels take all voxels.
 */
#ifndef FlipFreeVolume_h
#define FlipFreeVolume_h

#include "KernelTypes.h"

#include <emscripten/val.h>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace FlipFree
{

class Volume
{
public:
  using Storage = std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>,
    std::vector<std::int16_t>, std::vector<std::uint16_t>, std::vector<std::int32_t>,
    std::vector<std::uint32_t>, std::vector<float>, std::vector<double>>;

  Volume(Storage voxels, const ImageGeometry& geometry)
    : Voxels(std::move(voxels))
    , Geometry(geometry)
  {
  }

  const ImageGeometry& GetGeometry() const { return this->Geometry; }

  /// Returns visit(view) for voxels in their own type.
  template <typename Visit>
  auto VisitVoxels(const Visit& visit) const
  {
    return std::visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::value_type;
        return visit(ImageView<T>{ voxels.data(), this->Geometry });
      },
      this->Voxels);
  }

private:
  Storage Voxels;
  ImageGeometry Geometry;
};

/// Of { size, spacing, origin, direction }.
ImageGeometry GeometryOf(const emscripten::val& image);

} // namespace FlipFree

#endif
