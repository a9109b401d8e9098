// Scores of a surface or a label map against a reference; self-intersections of a surface.
#include "Answers.h"

#include "Geometry/SelfIntersection.h"
#include "Measures/ScoreColumns.h"
#include "Measures/ScoreParameters.h"
#include "Measures/SegmentationScores.h"
#include "Mesh/ContourMesh.h"
#include "TextWords.h"

#include <emscripten/bind.h>

#include <algorithm>
#include <cctype>

namespace FlipFree
{
namespace
{

// A column's name as a field of JavaScript: segmentationVolume, and of abbreviations asd and hd95.
std::string FieldName(const std::string& name)
{
  const bool isAbbreviation = std::none_of(name.begin(), name.end(),
    [](unsigned char letter) { return std::islower(letter) != 0; });
  return isAbbreviation ? InSmallLetters(name) : WithSmallFirst(name);
}

val ObjectOf(const SegmentationScores& scores)
{
  val answer = val::object();
  ForEachScore(scores,
    [&answer](const char* name, const auto& value) { answer.set(FieldName(name), value); });
  answer.set("warnings", val::array(scores.Warnings));
  return answer;
}

ScoreSettings SettingsOf(const val& parameters)
{
  ScoreSettings settings;
  SetParameters(ScoreParameters(), parameters, settings);
  return settings;
}

LabelMask ReferenceOf(const Volume& reference, const ScoreSettings& settings)
{
  return LabelMaskOf(LabelVolumeOf(reference, "the reference"), settings.ReferenceLabel,
    "ReferenceLabel");
}

val ScoreOfLabels(const Volume& segmentation, const Volume& reference, const val& parameters,
  const val& report)
{
  return Guarded(
    [&]
    {
      const ScoreSettings settings = SettingsOf(parameters);
      const LabelMask wanted = ReferenceOf(reference, settings);
      const LabelMask mask = LabelMaskOf(LabelVolumeOf(segmentation, "the segmentation"),
        settings.SegmentationLabel, "SegmentationLabel");
      return ObjectOf(ScoreLabels(mask, wanted, settings, SerialFor, MonitorOf(report)));
    });
}

val ScoreOfSurface(const val& surface, const Volume& reference, const val& parameters,
  const val& report)
{
  return Guarded(
    [&]
    {
      const ScoreSettings settings = SettingsOf(parameters);
      const LabelMask wanted = ReferenceOf(reference, settings);
      const PolygonSurface copy = SurfaceOf(surface, "the segmentation");
      return ObjectOf(ScoreSurface(copy.Points, Triangulate(copy.Faces), wanted, settings,
        SerialFor, MonitorOf(report)));
    });
}

val SelfIntersectionsOf(const val& surface)
{
  return Guarded(
    [&surface]
    {
      const PolygonSurface copy = SurfaceOf(surface, "the surface");
      val answer = val::object();
      answer.set("count", static_cast<double>(CountSelfIntersections(copy.Points, copy.Faces)));
      return answer;
    });
}

val DefaultScoreParameters()
{
  return ParametersOf(ScoreParameters(), ScoreSettings());
}

} // namespace

void BindEvaluation()
{
  emscripten::function("scoreParameters", &DefaultScoreParameters);
  emscripten::function("scoreLabels", &ScoreOfLabels);
  emscripten::function("scoreSurface", &ScoreOfSurface);
  emscripten::function("selfIntersections", &SelfIntersectionsOf);
}

} // namespace FlipFree
