/**
 * What is found of a vessel or of a tree of vessels: branches in cross-sections, each as wide as
 * the image shows it, and means over all of them.
 */
#ifndef FlipFreeVesselTree_h
#define FlipFreeVesselTree_h

#include "Vessel/CrossSections.h"

namespace FlipFree
{

struct VesselBranch
{
  VesselSections Sections;
  int Parent = -1;         ///< the earlier branch on which it begins; none for the first
  Eigen::VectorXd Support; ///< SectionSupport of each section
  Eigen::VectorXd Speed;   ///< VesselSpeed at each section, up to 1; above 0
};

struct VesselTree
{
  std::vector<VesselBranch> Branches; ///< none where the monitor stopped it
  double Radius = 0;                  ///< mean, mm
  double Support = 0;                 ///< mean SectionSupport
  std::vector<int> Unlike;            ///< points that do not look like the vessel; PointsUnlike()
};

/// Of all sections.
double MeanRadius(const VesselTree& tree);

/// Of all sections.
double MeanSupport(const VesselTree& tree);

/// Mean of all sections, by how well the image supports them; zero where nothing is supported.
double SupportedRadius(const VesselTree& tree);

} // namespace FlipFree

#endif
