/**
 * Points that correct a segmentation, as files: tables (.csv) with the columns kind, x, y, z and
 * radius in LPS millimeters, and 3D Slicer's markups (.mrk.json), LPS or RAS and in the unit that
 * the file says, where the kind is the first word of a control point's label, and a seed's radius
 * (mm) the second one; and strokes, whose points are all of one kind.
 */
#ifndef FlipFreeCommandPointFile_h
#define FlipFreeCommandPointFile_h

#include "Image/PointConstraint.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Command
{

struct CorrectionPoint
{
  FlipFree::ConstraintKind Kind = FlipFree::ConstraintKind::Inside;
  std::array<double, 3> Place{ { 0, 0, 0 } };
  double Radius = 0; ///< of a seed
};

/// The kind of that name. Throws Failure if there is none.
FlipFree::ConstraintKind KindOf(const std::string& name);

/// Throws Failure for a seed without radius.
void RequireRadius(const CorrectionPoint& point);

/// Throws Failure, naming the file, the line or the control point, and what is wrong; of a table of
/// x, y and z alone, what takes it, if anything. Warns of a file of no points.
std::vector<CorrectionPoint> ReadPoints(const std::string& name,
  const std::string& whatTakesPlaces = {});

/// Of control points that are in no file: their labels and places in LPS millimeters, by the name
/// of the list that they stand in. Throws Failure, naming the list and the control point.
std::vector<CorrectionPoint> PointsOfControls(const std::string& name,
  const std::vector<std::pair<std::string, std::array<double, 3>>>& controls);

/// Points of one kind: a table of x, y, z, or markups such as a curve, whose labels do not matter.
/// Throws Failure as ReadPoints().
std::vector<std::array<double, 3>> ReadPlaces(const std::string& name);

/// A stroke. Points closer than a micrometer are one. Throws Failure as ReadPlaces(), and for a
/// file of no points.
std::vector<CorrectionPoint> ReadStroke(const std::string& name, FlipFree::ConstraintKind kind);

/// What a file of that name says of the points: a table, or markups.
std::string TextOfPoints(const std::string& name, const std::vector<CorrectionPoint>& points);

/// Throws Failure for a seed, of which a vessel has none.
void RequireNoSeeds(const std::vector<CorrectionPoint>& points);

} // namespace Command

#endif
