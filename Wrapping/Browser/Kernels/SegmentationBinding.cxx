// The whole method: a volume, a seed and corrections in; surface, voxels and convergence out.
#include "Answers.h"
#include "Volume.h"

#include "Deformation/SegmentationParameters.h"

#include <emscripten/bind.h>

#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

Settings SettingsOf(const std::string& preset)
{
  Settings settings;
  settings.Method = preset == "published" ? PublishedSettings()
    : preset == "naive"                   ? NaiveSettings()
                                          : OrganSegmentationSettings();
  return settings;
}

// Five numbers each: kind, x, y, z, radius.
ConstraintList ConstraintsOf(const val& numbers)
{
  const std::vector<double> values = emscripten::vecFromJSArray<double>(numbers);
  ConstraintList constraints;
  for (std::size_t first = 0; first + 4 < values.size(); first += 5)
  {
    const double* const one = values.data() + first;
    constraints.push_back(
      { static_cast<ConstraintKind>(one[0]), Eigen::Vector3d(one + 1), one[4] });
  }
  return constraints;
}

// Nobody watches iterations.
void IgnoreIteration(const ContourMesh&, const PointList&, const CorrespondenceField&,
  const IterationRecord&)
{
}

// Runs on one volume. What corrections do not change is kept until a run has another seed or other
// parameters, so that a correction is fast.
class OrganRuns
{
public:
  explicit OrganRuns(std::shared_ptr<Volume> image)
    : Image(std::move(image))
  {
  }

  // `seed` is [x, y, z, radius].
  val Segment(const val& seed, const std::string& preset, const val& parameters,
    const val& corrections, const val& report)
  {
    return Guarded(
      [&]
      {
        Settings settings = SettingsOf(preset);
        SetParameters(SegmentationParameters(), parameters, settings);
        const std::vector<double> numbers = emscripten::vecFromJSArray<double>(seed);
        SeedSphere sphere{ Eigen::Vector3d(numbers.data()), numbers[3] };
        ConstraintList constraints = ConstraintsOf(corrections);
        TakeLargestSeed(sphere, constraints);
        try
        {
          this->Prepare(sphere, preset, settings);
          const VolumeSegmentation result =
            this->Kept->Segment(constraints, MonitorOf(report), IgnoreIteration);
          return AnswerOf(result.Organ, result.Voxels, result.Warnings);
        }
        catch (const std::bad_alloc&)
        {
          this->Kept.reset();
          throw;
        }
      });
  }

private:
  void Prepare(const SeedSphere& seed, const std::string& preset, const Settings& settings)
  {
    std::vector<double> key(seed.Center.begin(), seed.Center.end());
    key.push_back(seed.Radius);
    for (const Parameter<Settings>& parameter : SegmentationParameters())
    {
      const std::vector<double> values = parameter.Get(settings);
      key.insert(key.end(), values.begin(), values.end());
    }
    if (this->Kept && key == this->Key && preset == this->Preset)
    {
      return;
    }
    this->Kept.reset(); // before another one takes memory
    RequireNumbers(settings);
    RequireVoxels(this->Image->GetGeometry());
    RequireSeed(this->Image->GetGeometry(), seed, ImageName);
    const GrayVolume volume = this->Image->VisitVoxels(
      [](const auto& view) { return GrayVolumeOf(view, ImageName, Threading()); });
    this->Kept.emplace(volume, ImageName, seed, nullptr, settings, Threading());
    this->Key = std::move(key);
    this->Preset = preset;
  }

  std::shared_ptr<Volume> Image;
  std::optional<VolumeSegmenter> Kept;
  std::vector<double> Key; // the seed and all parameters
  std::string Preset;
};

val DefaultParameters(const std::string& preset)
{
  return ParametersOf(SegmentationParameters(), SettingsOf(preset));
}

} // namespace

void BindSegmentation()
{
  emscripten::function("segmentationParameters", &DefaultParameters);
  emscripten::class_<OrganRuns>("OrganRuns")
    .constructor<std::shared_ptr<Volume>>()
    .function("segment", &OrganRuns::Segment);
}

} // namespace FlipFree
