/**
 * Tables of points in LPS millimeters, as TableText.h reads them. The first line may name the
 * columns, which then may come in any order.
 */
#ifndef FlipFreePointTable_h
#define FlipFreePointTable_h

#include "Image/PointConstraint.h"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace FlipFree
{

/// Points that correct a segmentation: columns kind (outside, inside, boundary, seed), x, y, z and,
/// for seeds, radius. Throws FileProblem, naming the file by `name`, the line, and for a table of
/// x, y and z alone what takes it, if anything.
ConstraintList ReadConstraintTable(const std::string& name, const std::string& text,
  const std::string& whatTakesPlaces = {});

/// Points of one kind: columns x, y, z. Throws FileProblem likewise.
std::vector<Eigen::Vector3d> ReadPlaceTable(const std::string& name, const std::string& text);

} // namespace FlipFree

#endif
