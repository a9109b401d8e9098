#include "Vessel/VesselConfidence.h"

#include "Vessel/Polyline.h"

#include <algorithm>

namespace FlipFree
{

VesselConfidence ConfidenceOf(const VesselTree& tree, const VesselConfidenceSettings& settings)
{
  VesselConfidence least;
  least.Value = 2;
  for (const VesselBranch& branch : tree.Branches)
  {
    const PointList centers = branch.Sections.Centers();
    const Eigen::VectorXd lengths = ArcLengths(centers);
    const double step = lengths[lengths.size() - 1] / static_cast<double>(lengths.size() - 1);
    const Eigen::VectorXd support = MeanAlong(branch.Support, step, settings.Length);
    const Eigen::VectorXd slowness =
      MeanAlong(branch.Speed.cwiseInverse(), step, settings.Length).array().log() *
      settings.SlownessWeight;
    Eigen::Index section = 0;
    const double value = (support - slowness).minCoeff(&section);
    if (value < least.Value)
    {
      least = { value, centers.row(section), support[section] < settings.FaintSupport };
    }
  }
  least.Value = std::clamp(least.Value, 0.0, 1.0);
  return least;
}

} // namespace FlipFree
