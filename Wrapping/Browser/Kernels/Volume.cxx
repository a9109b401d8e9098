#include "Volume.h"

#include "Answers.h"
#include "Bindings.h"

#include "Error.h"
#include "Image/LatticePlacement.h"
#include "QuantityNames.h"

#include <emscripten/bind.h>

#include <stdexcept>

namespace FlipFree
{
namespace
{

template <typename T>
Volume::Storage CopyOf(const val& voxels)
{
  std::vector<T> copy(voxels["length"].as<std::size_t>());
  val(emscripten::typed_memory_view(copy.size(), copy.data())).call<void>("set", voxels);
  return copy;
}

Volume::Storage StorageOf(const val& voxels)
{
  using Copy = Volume::Storage (*)(const val&);
  const std::pair<const char*, Copy> types[] = {
    { "Int8Array", CopyOf<std::int8_t> },
    { "Uint8Array", CopyOf<std::uint8_t> },
    { "Int16Array", CopyOf<std::int16_t> },
    { "Uint16Array", CopyOf<std::uint16_t> },
    { "Int32Array", CopyOf<std::int32_t> },
    { "Uint32Array", CopyOf<std::uint32_t> },
    { "Float32Array", CopyOf<float> },
    { "Float64Array", CopyOf<float> },
  };
  const auto name = voxels["constructor"]["name"].as<std::string>();
  for (const auto& [type, copy] : types)
  {
    if (name == type)
    {
      return copy(voxels);
    }
  }
  throw std::invalid_argument("the voxels are a " + name +
    ", which is none of the typed arrays of up to 32 "
    "bits, nor a Float64Array");
}

// { volume: Volume } of { voxels, size, spacing, origin, direction }.
val MakeVolume(const val& image)
{
  return Guarded(
    [&image]
    {
      val answer = val::object();
      answer.set("volume", std::make_shared<Volume>(StorageOf(image["voxels"]), GeometryOf(image)));
      return answer;
    });
}

// { samePlaces, difference }: whether two grids have the same voxels, in whichever order, and how
// the second is off the lattice of the first.
val CompareGrids(const val& lattice, const val& part, const std::string& nameOfPart)
{
  return Guarded(
    [&]
    {
      const ImageGeometry one = GeometryOf(lattice);
      const ImageGeometry other = GeometryOf(part);
      val answer = val::object();
      answer.set("samePlaces", HaveSamePlaces(one, other));
      answer.set("difference", std::string());
      try
      {
        PlacementOn(one, other, ImageName, Escaped(nameOfPart));
      }
      catch (const Error& error)
      {
        answer.set("difference", error.GetText());
      }
      return answer;
    });
}

} // namespace

ImageGeometry GeometryOf(const val& image)
{
  const auto numbers = [&image](const char* name)
  { return emscripten::vecFromJSArray<double>(image[name]); };
  const std::vector<double> size = numbers("size");
  ImageGeometry geometry;
  for (int axis = 0; axis < 3; ++axis)
  {
    geometry.Dimensions[axis] = static_cast<int>(size[axis]);
  }
  geometry.Spacing = Eigen::Vector3d(numbers("spacing").data());
  geometry.Origin = Eigen::Vector3d(numbers("origin").data());
  geometry.Direction = Eigen::Map<const RowMajorMatrix>(numbers("direction").data());
  return geometry;
}

void BindVolumes()
{
  emscripten::class_<Volume>("Volume").smart_ptr<std::shared_ptr<Volume>>("Volume");
  emscripten::function("makeVolume", &MakeVolume);
  emscripten::function("compareGrids", &CompareGrids);
}

} // namespace FlipFree
