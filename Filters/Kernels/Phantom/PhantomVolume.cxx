#include "Phantom/PhantomVolume.h"

#include "Error.h"
#include "Phantom/AbdomenPhantom.h"

#include <limits>
#include <string>

namespace FlipFree
{
namespace
{

ParameterTable<PhantomSettings> MakeTable()
{
  constexpr double any = std::numeric_limits<double>::infinity();
  constexpr double least = std::numeric_limits<int>::min();
  constexpr double most = std::numeric_limits<int>::max();
  return {
    NumberParameter<int, PhantomSettings>(
      "Shape", [](auto& settings) -> auto& { return settings.Shape; }, 0, AbdomenShape),
    VectorParameter<int, PhantomSettings>(
      "Dimensions", [](auto& settings) { return settings.Dimensions.data(); }, 3),
    VectorParameter<double, PhantomSettings>(
      "Spacing", [](auto& settings) { return settings.Spacing.data(); }, 3),
    VectorParameter<double, PhantomSettings>(
      "Origin", [](auto& settings) { return settings.Origin.data(); }, 3),
    VectorParameter<double, PhantomSettings>(
      "Direction", [](auto& settings) { return settings.Direction.data(); }, 9),
    NumberParameter<double, PhantomSettings>(
      "Foreground", [](auto& settings) -> auto& { return settings.Foreground; }, -any, any),
    NumberParameter<double, PhantomSettings>(
      "Background", [](auto& settings) -> auto& { return settings.Background; }, -any, any),
    NumberParameter<double, PhantomSettings>(
      "NoiseStandardDeviation",
      [](auto& settings) -> auto& { return settings.NoiseStandardDeviation; }, -any, any),
    NumberParameter<double, PhantomSettings>(
      "NoiseCorrelation", [](auto& settings) -> auto& { return settings.NoiseCorrelation; }, -any,
      any),
    NumberParameter<int, PhantomSettings>(
      "RandomSeed", [](auto& settings) -> auto& { return settings.RandomSeed; }, least, most),
    NumberParameter<int, PhantomSettings>(
      "NumberOfLesions", [](auto& settings) -> auto& { return settings.NumberOfLesions; }, 0, 20),
    NumberParameter<bool, PhantomSettings>(
      "PartialVolume", [](auto& settings) -> auto& { return settings.PartialVolume; }, 0, 1),
  };
}

} // namespace

const char* NameOfPhantomLabel(int shape, int label)
{
  return shape == AbdomenShape ? NameOf(static_cast<AbdomenLabel>(label)) : "object";
}

const ParameterTable<PhantomSettings>& PhantomParameters()
{
  static const ParameterTable<PhantomSettings> table = MakeTable();
  return table;
}

ImageGeometry GridOf(const PhantomSettings& settings)
{
  const bool isAbdomen = settings.Shape == AbdomenShape;
  ImageGeometry grid;
  grid.Dimensions = settings.Dimensions;
  if (grid.Dimensions == std::array<int, 3>{ { 0, 0, 0 } })
  {
    grid.Dimensions =
      isAbdomen ? std::array<int, 3>{ { 220, 170, 90 } } : std::array<int, 3>{ { 96, 96, 96 } };
  }
  grid.Spacing = settings.Spacing;
  if (grid.Spacing.isZero(0))
  {
    grid.Spacing = isAbdomen ? Eigen::Vector3d(1.5, 1.5, 3) : Eigen::Vector3d(1, 1, 1);
  }
  grid.Origin = settings.Origin;
  grid.Direction = settings.Direction;
  RequireGrid(grid);
  return grid;
}

Phantom PhantomOf(const PhantomSettings& settings, const ImageGeometry& grid)
{
  const Eigen::Vector3d extent = GridExtent(grid);
  if (settings.Shape == AbdomenShape)
  {
    return MakeAbdomenPhantom(extent,
      { settings.NumberOfLesions, static_cast<std::uint64_t>(settings.RandomSeed) });
  }
  for (const double intensity : { settings.Foreground, settings.Background })
  {
    if (!(intensity >= std::numeric_limits<std::int16_t>::min() &&
          intensity <= std::numeric_limits<std::int16_t>::max()))
    {
      throw Error(ErrorCode::OutOfRange,
        "{Foreground} and {Background} must lie within -32768 to 32767, not " +
          std::to_string(intensity));
    }
  }
  return MakePlainPhantom(static_cast<PlainShape>(settings.Shape), extent, settings.Foreground,
    settings.Background);
}

SamplingOptions SamplingOf(const PhantomSettings& settings)
{
  return { settings.PartialVolume, settings.NoiseStandardDeviation, settings.NoiseCorrelation,
    static_cast<std::uint64_t>(settings.RandomSeed) };
}

} // namespace FlipFree
