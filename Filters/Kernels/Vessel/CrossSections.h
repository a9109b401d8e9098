/**
 * The outline of a vessel in cross-sections along its path: rays from the center, on each of which
 * the boundary is where gray values change from those of the vessel to those of its surroundings,
 * both measured locally. All rays of all sections are decided together, so that the outline is
 * smooth around and along.
 */
#ifndef FlipFreeCrossSections_h
#define FlipFreeCrossSections_h

#include "Vessel/SectionFrames.h"

namespace FlipFree
{

struct CrossSectionSettings
{
  int Rays = 32;
  double RayStep = 0.5;
  double SectionStep = 1.5;
  int Rounds = 3;
  double DarkLimit = 60;
  double BrightLimit = 22;
  double MinimumDeviation = 8;
  double MaximumDeviation = 25;
  int IntensityWindow = 3; ///< sections to either side
  double EdgeWeight = 12;
  double PriorWeight = 0.03;
  double PriorFollow = 0.25;
  double AlongWeight = 0.16;
  double AroundWeight = 0.15;
  double LineDeviation = 2; ///< sections
  /// Of the vessel elsewhere, mm: what sections have for which no section nearby, that the image
  /// supports, has one. Zero: not known.
  double LentRadius = 0;
};

/// Sections of a vessel at even distances.
struct VesselSections
{
  std::vector<SectionFrame> Frames;
  Eigen::MatrixXd Radii; ///< a row per section, a column per ray; mm

  PointList Centers() const;
  Eigen::VectorXd MeanRadii() const; ///< of a disk of the same area
};

/// `radii`: first guesses at the line's points.
VesselSections FitSections(const ImageView<float>& image, const PointList& line,
  const Eigen::VectorXd& radii, const CrossSectionSettings& settings,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
