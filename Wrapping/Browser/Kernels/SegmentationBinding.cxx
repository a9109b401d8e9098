// The whole method: a volume, a seed or a label map, and corrections in; surface, its confidence,
// voxels and convergence out.
#include "Answers.h"
#include "Volume.h"

#include "Deformation/SegmentationParameters.h"
#include "Deformation/StartMask.h"
#include "Image/GridCheck.h"

#include <emscripten/bind.h>

#include <optional>
#include <stdexcept>
#include <utility>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

constexpr const char* LabelsName = "the start labels";

Settings SettingsOf(const std::string& preset)
{
  Settings settings;
  settings.Method = SettingsOfPreset(preset);
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

// The voxels of a label; 0 stands for all that are not 0.
struct StartMaskOfView
{
  int Label;

  template <typename T>
  BitMask operator()(const ImageView<T>& view) const
  {
    const int sought = this->Label == 0 ? -1 : this->Label;
    BitMask mask = MaskOfLabel(view, sought, LabelsName, Threading());
    RequireStartLabel(mask, this->Label, LabelsOfView<T>{ view }, LabelsName);
    return mask;
  }
};

BitMask StartMaskOf(const Volume& labels, int label, const ImageGeometry& image)
{
  if (labels.GetGeometry().NumberOfVoxels() == 0)
  {
    throw std::invalid_argument(std::string(LabelsName) + " have no voxels; give a label map");
  }
  RequireProperGrid(labels.GetGeometry(), LabelsName);
  RequireSameGeometry(labels.GetGeometry(), image, LabelsName, ImageName);
  return labels.VisitVoxels(StartMaskOfView{ label });
}

val ObjectOf(const SeedSphere& seed)
{
  val object = val::object();
  object.set("center", ArrayOf(seed.Center));
  object.set("radius", seed.Radius);
  return object;
}

// Nobody watches iterations.
void IgnoreIteration(const ContourMesh&, const PointList&, const CorrespondenceField&,
  const IterationRecord&)
{
}

// Runs on one volume. What corrections do not change is kept until a run has another start or other
// parameters, so that a correction is fast.
class OrganRuns
{
public:
  explicit OrganRuns(std::shared_ptr<Volume> image)
    : Image(std::move(image))
  {
  }

  // Takes the label that runs without a seed fill.
  val SetStart(const Volume& labels, int label)
  {
    return Guarded(
      [&]
      {
        this->Kept.reset(); // its memory is needed
        this->Key.clear();
        this->Mask = BitMask();
        RequireVoxels(this->Image->GetGeometry());
        BitMask mask = StartMaskOf(labels, label, this->Image->GetGeometry());
        this->Ball = LargestBallIn(mask, LabelsName, SerialFor);
        this->Mask = std::move(mask);
        return ObjectOf(this->Ball);
      });
  }

  // `seed` is [x, y, z, radius], or [] to fill the label.
  val Segment(const val& seed, const std::string& preset, const val& parameters,
    const val& corrections, const val& report)
  {
    return Guarded(
      [&]
      {
        Settings settings = SettingsOf(preset);
        SetParameters(SegmentationParameters(), parameters, settings);
        const std::vector<double> numbers = emscripten::vecFromJSArray<double>(seed);
        const bool fills = numbers.empty();
        ConstraintList constraints = ConstraintsOf(corrections);
        SeedSphere sphere = this->Ball;
        if (!fills)
        {
          sphere = { Eigen::Vector3d(numbers.data()), numbers[3] };
          TakeLargestSeed(sphere, constraints);
        }
        try
        {
          this->Prepare(sphere, fills, preset, settings);
          const VolumeSegmentation result =
            this->Kept->Segment(constraints, MonitorOf(report), IgnoreIteration);
          val answer = AnswerOf(result.Organ, result.Voxels, result.Warnings);
          answer.set("seed", ObjectOf(sphere));
          answer.set("confidence", result.Confidence.OfSurface);
          answer.set("vertexConfidence", ArrayOf(result.Confidence.OfVertices));
          return answer;
        }
        catch (const std::bad_alloc&)
        {
          this->Kept.reset();
          throw;
        }
      });
  }

private:
  void Prepare(const SeedSphere& seed, bool fills, const std::string& preset,
    const Settings& settings)
  {
    std::vector<double> key(seed.Center.begin(), seed.Center.end());
    key.push_back(seed.Radius);
    key.push_back(fills ? 1 : 0);
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
    if (fills)
    {
      this->Kept->SetForeground(this->Mask, LabelsName);
    }
    this->Key = std::move(key);
    this->Preset = preset;
  }

  std::shared_ptr<Volume> Image;
  BitMask Mask;    // of the label to be filled
  SeedSphere Ball; // the largest in it
  std::optional<VolumeSegmenter> Kept;
  std::vector<double> Key; // the seed, whether a label is filled, and all parameters
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
    .function("setStart", &OrganRuns::SetStart)
    .function("segment", &OrganRuns::Segment);
}

} // namespace FlipFree
