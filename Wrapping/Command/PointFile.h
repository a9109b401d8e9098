/**
 * Points that correct a segmentation, as files: tables (.csv) with the columns kind, x, y, z and
 * radius in LPS millimeters, and 3D Slicer's markups (.mrk.json), LPS or RAS and in the unit that
 * the file says, where the kind is the first word of a control point's label, and a seed's radius
 * (mm) the second one; and strokes, whose points are all of one kind.
 * The package without VTK reads them, too (_point_files.py); a test holds the two together.
 */
#ifndef FlipFreeCommandPointFile_h
#define FlipFreeCommandPointFile_h

#include "Image/PointConstraint.h"

#include <array>
#include <string>
#include <vector>

class vtkFlipFreeSegmentation;
class vtkFlipFreeVesselSegmentation;

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

/// Throws Failure, naming the file, the line or the control point, and what is wrong. Warns of a
/// file of no points.
std::vector<CorrectionPoint> ReadPoints(const std::string& name);

/// A stroke: a table of x, y, z, or markups such as a curve, whose labels do not matter. Points
/// closer than a micrometer are one. Throws Failure as ReadPoints(), and for a file of no points.
std::vector<CorrectionPoint> ReadStroke(const std::string& name, FlipFree::ConstraintKind kind);

void WritePoints(const std::string& name, const std::vector<CorrectionPoint>& points);

/// Adds the points to the filter's.
void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeSegmentation* filter);

/// Throws Failure for a seed, of which a vessel has none.
void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeVesselSegmentation* filter);

} // namespace Command

#endif
