// Synthetic volumes with their true labels and seeds.
#include "Bindings.h"

#include "Phantom/PhantomVolume.h"

#include <emscripten/bind.h>

namespace FlipFree
{
namespace
{

val SeedOf(const ImageGeometry& grid, int shape, const PhantomSeed& organ)
{
  val seed = val::object();
  seed.set("name", std::string(NameOfPhantomLabel(shape, organ.Label)));
  seed.set("label", static_cast<int>(organ.Label));
  seed.set("center", ArrayOf(GridToPhysical(grid, organ.Start.Center)));
  seed.set("radius", organ.Start.Radius);
  return seed;
}

val MakePhantom(const val& parameters, const val& report)
{
  return Guarded(
    [&]
    {
      PhantomSettings settings;
      SetParameters(PhantomParameters(), parameters, settings);
      const ImageGeometry grid = GridOf(settings);
      const Phantom phantom = PhantomOf(settings, grid);
      std::vector<std::int16_t> intensities(grid.NumberOfVoxels());
      std::vector<std::uint8_t> labels(grid.NumberOfVoxels());
      SampleTissues(phantom.Tissues, grid, SamplingOf(settings), intensities.data(), labels.data(),
        SerialFor, MonitorOf(report));
      val seeds = val::array();
      for (const PhantomSeed& organ : phantom.Seeds)
      {
        seeds.call<void>("push", SeedOf(grid, settings.Shape, organ));
      }
      val answer = val::object();
      answer.set("voxels", ArrayOf(intensities));
      answer.set("labels", ArrayOf(labels));
      answer.set("size", ArrayOf(grid.Dimensions));
      answer.set("spacing", ArrayOf(grid.Spacing));
      answer.set("origin", ArrayOf(grid.Origin));
      answer.set("direction", ArrayOf(settings.Direction));
      answer.set("seeds", seeds);
      return answer;
    });
}

val DefaultPhantomParameters()
{
  return ParametersOf(PhantomParameters(), PhantomSettings());
}

} // namespace

void BindPhantoms()
{
  emscripten::function("phantomParameters", &DefaultPhantomParameters);
  emscripten::function("makePhantom", &MakePhantom);
}

} // namespace FlipFree
