// Synthetic volumes with their true labels and seeds.
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Phantom/PhantomVolume.h"

#include <nanobind/stl/array.h>

namespace FlipFree
{
namespace
{

std::array<double, 4> BallOf(const ImageGeometry& grid, const Ball& ball)
{
  const Eigen::Vector3d center = GridToPhysical(grid, ball.Center);
  return { { center.x(), center.y(), center.z(), ball.Radius } };
}

nb::dict MakeVolume(const PhantomSettings& settings, const nb::callable& report)
{
  const ImageGeometry grid = GridOf(settings);
  const Phantom phantom = PhantomOf(settings, grid);
  std::vector<std::int16_t> intensities(grid.NumberOfVoxels());
  std::vector<std::uint8_t> labels(grid.NumberOfVoxels());
  {
    const nb::gil_scoped_release unlocked;
    SampleTissues(phantom.Tissues, grid, SamplingOf(settings), intensities.data(), labels.data(),
      PoolFor, MonitorOf(report));
  }
  const auto size = [&grid](int axis) { return static_cast<std::size_t>(grid.Dimensions[axis]); };
  nb::dict seeds;
  for (const PhantomSeed& organ : phantom.Seeds)
  {
    seeds[nb::int_(static_cast<int>(organ.Label))] = BallOf(grid, organ.Start);
  }
  nb::dict answer;
  answer["intensities"] =
    ArrayOf<std::int16_t>(std::move(intensities), { size(2), size(1), size(0) });
  answer["labels"] = ArrayOf<std::uint8_t>(std::move(labels), { size(2), size(1), size(0) });
  answer["spacing"] = Triple{ { grid.Spacing[0], grid.Spacing[1], grid.Spacing[2] } };
  answer["origin"] = Triple{ { grid.Origin[0], grid.Origin[1], grid.Origin[2] } };
  Nine direction;
  std::copy_n(settings.Direction.data(), 9, direction.begin());
  answer["direction"] = direction;
  answer["seeds"] = seeds;
  nb::list ends;
  if (phantom.Ends)
  {
    for (const Eigen::Vector3d& end : *phantom.Ends)
    {
      const Eigen::Vector3d place = GridToPhysical(grid, end);
      ends.append(nb::make_tuple(place.x(), place.y(), place.z()));
    }
  }
  answer["ends"] = ends;
  return answer;
}

} // namespace

void BindPhantoms(nb::module_& module)
{
  BindSettings<PhantomSettings>(module, "PhantomSettings", &PhantomParameters).def(nb::init<>());
  module.def("make_phantom", &MakeVolume);
}

} // namespace FlipFree
