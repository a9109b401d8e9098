#include "Vessel/VesselTree.h"

#include <algorithm>

namespace FlipFree
{

double MeanRadius(const VesselTree& tree)
{
  double sum = 0;
  Eigen::Index sections = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    sum += branch.Sections.MeanRadii().sum();
    sections += branch.Sections.Radii.rows();
  }
  return sum / static_cast<double>(std::max<Eigen::Index>(1, sections));
}

double MeanSupport(const VesselTree& tree)
{
  double sum = 0;
  Eigen::Index sections = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    sum += branch.Support.sum();
    sections += branch.Support.size();
  }
  return sum / static_cast<double>(std::max<Eigen::Index>(1, sections));
}

double SupportedRadius(const VesselTree& tree)
{
  double sum = 0;
  double weights = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    const Eigen::VectorXd weight = branch.Support.cwiseAbs2();
    sum += weight.dot(branch.Sections.MeanRadii());
    weights += weight.sum();
  }
  return weights > 0 ? sum / weights : 0;
}

} // namespace FlipFree
