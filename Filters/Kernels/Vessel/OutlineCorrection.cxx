#include "Vessel/OutlineCorrection.h"

#include "Error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

constexpr double Margin = 1;         // between a point inside or outside and the outline, mm
constexpr double LeastRadius = 0.5;  // mm
constexpr double LeastDeviation = 2; // of what a point moves, mm

// A point that moves the outline outward lies within this of a section's center.
constexpr double RadiiAway = 3; // of the section's mean radius
constexpr double AlsoAway = 10; // mm

struct SectionPlace
{
  VesselSections* Sections = nullptr;
  Eigen::Index Section = 0;
  double Distance = 0; ///< across the path
  double Angle = 0;
};

// A tree has a branch at least, and a branch a section.
SectionPlace NearestPlace(const Eigen::Vector3d& point, VesselTree& tree)
{
  SectionPlace place;
  place.Sections = &tree.Branches.front().Sections;
  double nearest = std::numeric_limits<double>::infinity();
  for (VesselBranch& branch : tree.Branches)
  {
    const auto& frames = branch.Sections.Frames;
    for (std::size_t section = 0; section < frames.size(); ++section)
    {
      const double square = (point - frames[section].Origin).squaredNorm();
      if (square < nearest)
      {
        nearest = square;
        place.Sections = &branch.Sections;
        place.Section = static_cast<Eigen::Index>(section);
      }
    }
  }
  const SectionFrame& frame = place.Sections->Frames[place.Section];
  const Eigen::Vector3d offset = point - frame.Origin;
  const Eigen::Vector3d across = offset - offset.dot(frame.Tangent) * frame.Tangent;
  place.Distance = across.norm();
  place.Angle = std::atan2(across.dot(frame.Second), across.dot(frame.First));
  return place;
}

// How the radius has to change at a point.
double ChangeFor(const PointConstraint& constraint, double distance, double radius)
{
  switch (constraint.Kind)
  {
    case ConstraintKind::Inside:
      return std::max(0.0, distance + Margin - radius);
    case ConstraintKind::Outside:
      return std::min(0.0, distance - Margin - radius);
    default:
      return distance - radius;
  }
}

bool IsNear(const Eigen::Vector3d& point, const VesselTree& tree)
{
  for (const VesselBranch& branch : tree.Branches)
  {
    const Eigen::VectorXd radii = branch.Sections.MeanRadii();
    for (Eigen::Index section = 0; section < radii.size(); ++section)
    {
      const double distance = (point - branch.Sections.Frames[section].Origin).norm();
      if (distance <= RadiiAway * radii[section] + AlsoAway)
      {
        return true;
      }
    }
  }
  return false;
}

void RequireNear(const ConstraintList& constraints, const VesselTree& tree)
{
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind != ConstraintKind::Outside && !IsNear(constraint.Point, tree))
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf(constraint) +
          " lies too far from the vessel's path to correct its outline; give a point along the "
          "vessel");
    }
  }
}

void MoveOutline(const PointConstraint& constraint, VesselTree& tree)
{
  const SectionPlace place = NearestPlace(constraint.Point, tree);
  Eigen::MatrixXd& radii = place.Sections->Radii;
  const double turn = 2 * EIGEN_PI / static_cast<double>(radii.cols());
  const auto ray = (std::lround(place.Angle / turn) + radii.cols()) % radii.cols();
  const double change = ChangeFor(constraint, place.Distance, radii(place.Section, ray));
  const double radius = radii.row(place.Section).mean();
  const double deviation = std::max(LeastDeviation, radius);
  const Eigen::Vector3d center = place.Sections->Frames[place.Section].Origin;
  for (Eigen::Index section = 0; section < radii.rows(); ++section)
  {
    const double along = (place.Sections->Frames[section].Origin - center).norm() / deviation;
    for (Eigen::Index other = 0; other < radii.cols(); ++other)
    {
      const double angle = std::remainder(static_cast<double>(other - ray) * turn, 2 * EIGEN_PI);
      const double around = angle * radius / deviation;
      const double weight = std::exp(-0.5 * (along * along + around * around));
      radii(section, other) = std::max(LeastRadius, radii(section, other) + weight * change);
    }
  }
}

} // namespace

void CorrectOutline(const ConstraintList& constraints, VesselTree& tree)
{
  RequireNear(SortedConstraints(constraints), tree);
  for (const PointConstraint& constraint : SortedConstraints(constraints))
  {
    MoveOutline(constraint, tree);
  }
}

} // namespace FlipFree
