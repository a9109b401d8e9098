// The whole method: a volume and a seed in; surface, voxels and convergence out.
#include "Bindings.h"
#include "Volume.h"

#include "Deformation/ConvergenceColumns.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/VolumeSegmentation.h"
#include "Image/GridCheck.h"

#include <emscripten/bind.h>

#include <stdexcept>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

const char* const ImageName = "the image";

val ObjectOf(const OrganSurface& organ)
{
  val surface = val::object();
  surface.set("points", ArrayOf(organ.Points));
  surface.set("corners", ArrayOf(organ.Mesh.Faces.Connectivity));
  surface.set("offsets", ArrayOf(organ.Mesh.Faces.Offsets));
  return surface;
}

val ColumnsOf(const std::vector<IterationRecord>& records)
{
  val columns = val::object();
  for (const ConvergenceColumn& column : ConvergenceColumns())
  {
    std::vector<double> values;
    for (const IterationRecord& record : records)
    {
      values.push_back(column.Read(record));
    }
    columns.set(column.Name, ArrayOf(values));
  }
  return columns;
}

// Four numbers each: j, k, first i, one past the last i.
val RunsOf(const std::vector<VoxelRun>& runs)
{
  std::vector<int> numbers;
  numbers.reserve(4 * runs.size());
  for (const VoxelRun& run : runs)
  {
    numbers.insert(numbers.end(), { run.J, run.K, run.Begin, run.End });
  }
  return ArrayOf(numbers);
}

void RequireVoxels(const ImageGeometry& geometry)
{
  if (geometry.NumberOfVoxels() == 0)
  {
    throw std::invalid_argument("the image has no voxels; give one that has");
  }
  RequireProperGrid(geometry, ImageName);
}

Settings SettingsOf(const std::string& preset)
{
  Settings settings;
  settings.Method = preset == "published" ? PublishedSettings()
    : preset == "naive"                   ? NaiveSettings()
                                          : OrganSegmentationSettings();
  return settings;
}

val ObjectOf(const VolumeSegmentation& result)
{
  const OrganSurface& organ = result.Organ;
  val answer = val::object();
  answer.set("stopReason", std::string(ToString(organ.Reason)));
  answer.set("aborted", organ.Reason == StopReason::Aborted);
  answer.set("selfIntersections", static_cast<double>(organ.SelfIntersections));
  answer.set("surface", ObjectOf(organ));
  answer.set("runs", RunsOf(result.Voxels));
  answer.set("iterations", ColumnsOf(organ.Iterations));
  answer.set("warnings", val::array(result.Warnings));
  return answer;
}

// Nobody watches iterations.
void IgnoreIteration(const ContourMesh&, const PointList&, const CorrespondenceField&,
  const IterationRecord&)
{
}

// `seed` is [x, y, z, radius].
val Segment(const Volume& image, const val& seed, const std::string& preset, const val& parameters,
  const val& report)
{
  return Guarded(
    [&]
    {
      Settings settings = SettingsOf(preset);
      SetParameters(SegmentationParameters(), parameters, settings);
      const std::vector<double> numbers = emscripten::vecFromJSArray<double>(seed);
      const SeedSphere sphere{ Eigen::Vector3d(numbers.data()), numbers[3] };
      RequireNumbers(settings);
      RequireVoxels(image.GetGeometry());
      RequireSeed(image.GetGeometry(), sphere, ImageName);
      const GrayVolume volume = image.VisitVoxels(
        [](const auto& view) { return GrayVolumeOf(view, ImageName, Threading()); });
      return ObjectOf(SegmentVolume(volume, ImageName, sphere, nullptr, settings, Threading(),
        MonitorOf(report), IgnoreIteration));
    });
}

val DefaultParameters(const std::string& preset)
{
  return ParametersOf(SegmentationParameters(), SettingsOf(preset));
}

} // namespace

void BindSegmentation()
{
  emscripten::function("segmentationParameters", &DefaultParameters);
  emscripten::function("segment", &Segment);
}

} // namespace FlipFree
