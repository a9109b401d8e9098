// The whole method: a volume, a seed or a label map, and corrections in; surface, its confidence,
// voxels and convergence out.
#include "Answers.h"

#include "Deformation/SegmentationParameters.h"
#include "Deformation/SegmentationRequest.h"

#include <emscripten/bind.h>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

Settings SettingsOf(const std::string& preset)
{
  return { SettingsOfPreset(preset) };
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

val ObjectOf(const SeedSphere& seed)
{
  val object = val::object();
  object.set("center", ArrayOf(seed.Center));
  object.set("radius", seed.Radius);
  return object;
}

val ListOf(const std::vector<DoubtfulPart>& questions)
{
  std::vector<val> list;
  for (const DoubtfulPart& part : questions)
  {
    val question = val::object();
    question.set("place", ArrayOf(part.Place));
    question.set("volume", part.Volume / 1000);
    question.set("included", part.IsIncluded);
    question.set("margin", part.Margin);
    list.push_back(question);
  }
  return val::array(list);
}

// Segments one organ of a volume, which it reads, again and again.
class VolumeSession
{
public:
  explicit VolumeSession(const std::shared_ptr<Volume>& image)
    : Image(image)
    , Organ(GrayVolumeOf(*image), ImageName, Threading())
  {
  }

  // Takes the label that runs without a seed fill.
  val SetStart(const Volume& labels, int label)
  {
    return Guarded(
      [&]
      {
        const LabelVolume volume = LabelVolumeOf(labels, "the start labels");
        const SeedSphere ball = this->Organ.FillLabel(volume, label);
        this->StartWarning = WarningOfNoLabels(volume.Values(), label, volume.Name, "is filled");
        return ObjectOf(ball);
      });
  }

  // `seed` is [x, y, z, radius], or [] to fill the label.
  val Segment(const val& seed, const std::string& preset, const val& parameters,
    const val& corrections, const val& report)
  {
    return Guarded(
      [&]
      {
        OrganRequest request;
        const std::vector<double> numbers = emscripten::vecFromJSArray<double>(seed);
        if (!numbers.empty())
        {
          request.Seed = SeedSphere{ Eigen::Vector3d(numbers.data()), numbers[3] };
        }
        request.Constraints = ConstraintsOf(corrections);
        request.Settings = SettingsOf(preset);
        SetParameters(SegmentationParameters(), parameters, request.Settings);
        try
        {
          OrganAnswer found = this->Organ.Segment(request, MonitorOf(report), nullptr);
          VolumeSegmentation& result = found.Result;
          if (numbers.empty() && !this->StartWarning.empty())
          {
            result.Warnings.push_back(this->StartWarning);
          }
          val answer =
            AnswerOf(result.Organ, { found.Provenance, request.Settings.Method.Step.Guard },
              result.Voxels, result.Warnings);
          answer.set("seed", ObjectOf(found.Seed));
          answer.set("questions", ListOf(result.Questions));
          answer.set("confidence", result.Confidence.OfSurface);
          answer.set("vertexConfidence", ArrayOf(result.Confidence.OfVertices));
          return answer;
        }
        catch (const std::bad_alloc&)
        {
          this->Organ.Release();
          throw;
        }
      });
  }

  // Of one more correction, in the same five numbers.
  val Preview(const val& correction)
  {
    return Guarded(
      [&]
      {
        val answer = val::object();
        const std::optional<std::vector<VoxelRun>> changed =
          this->Organ.Preview(ConstraintsOf(correction).at(0), NeverStop);
        answer.set("isKnown", changed.has_value());
        if (changed)
        {
          answer.set("runs", ArrayOf(*changed));
          answer.set("volume",
            static_cast<double>(CountVoxels(*changed)) * this->Organ.GetGeometry().VoxelVolume() /
              1000);
        }
        return answer;
      });
  }

private:
  const std::shared_ptr<Volume> Image;
  OrganSession Organ;
  std::string StartWarning; // of the label that runs without a seed fill
};

val DefaultParameters(const std::string& preset)
{
  return ParametersOf(SegmentationParameters(), SettingsOf(preset));
}

} // namespace

void BindSegmentation()
{
  emscripten::function("segmentationParameters", &DefaultParameters);
  emscripten::class_<VolumeSession>("OrganSession")
    .constructor<std::shared_ptr<Volume>>()
    .function("setStart", &VolumeSession::SetStart)
    .function("segment", &VolumeSession::Segment)
    .function("preview", &VolumeSession::Preview);
}

} // namespace FlipFree
