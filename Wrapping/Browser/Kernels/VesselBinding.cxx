// A vessel, or a tree of vessels: a volume and points in; surface, voxels and centerline out.
#include "Answers.h"

#include "Vessel/VesselParameters.h"
#include "Vessel/VesselProvenance.h"

#include <emscripten/bind.h>

namespace FlipFree
{
namespace
{

val BranchesOf(const VesselTree& tree)
{
  val branches = val::array();
  for (const VesselBranch& branch : tree.Branches)
  {
    val one = val::object();
    one.set("points", ArrayOf(branch.Sections.Centers()));
    one.set("radii", ArrayOf(branch.Sections.MeanRadii()));
    one.set("parent", branch.Parent);
    branches.call<void>("push", one);
  }
  return branches;
}

// `points` are the coordinates of one point after the other.
val Trace(const Volume& image, const val& points, const val& parameters, const val& report)
{
  return Guarded(
    [&]
    {
      VesselSegmentationSettings settings;
      SetParameters(VesselParameters(), parameters, settings);
      const std::vector<double> numbers = emscripten::vecFromJSArray<double>(points);
      const PointList list = Eigen::Map<const PointList>(numbers.data(),
        static_cast<Eigen::Index>(numbers.size() / 3), 3);
      const VesselSegmentation result = SegmentVessel(GrayVolumeOf(image), ImageName, list, {},
        settings, Threading(), MonitorOf(report));
      const std::string provenance = ProvenanceOf(list, {}, settings, image.GetGeometry());
      val answer = AnswerOf(result.Surface, { provenance, settings.Step.Guard }, result.Voxels,
        result.Warnings);
      answer.set("branches", BranchesOf(result.Tree));
      answer.set("radius", result.Tree.Radius);
      answer.set("support", result.Tree.Support);
      answer.set("confidence", result.Confidence.Value);
      return answer;
    });
}

val DefaultVesselParameters()
{
  return ParametersOf(VesselParameters(), VesselSegmentationSettings());
}

} // namespace

void BindVessels()
{
  emscripten::function("vesselParameters", &DefaultVesselParameters);
  emscripten::function("trace", &Trace);
}

} // namespace FlipFree
