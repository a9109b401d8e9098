/**
 * Private to the module: constraints from a data set of points.
 */
#ifndef FlipFreeConstraintPoints_h
#define FlipFreeConstraintPoints_h

#include "Image/PointConstraint.h"

#include <string>

class vtkPointSet;

namespace FlipFree
{

/// The points as constraints: point arrays `Constraint` (0 outside, 1 inside, 2 boundary, 3 seed)
/// and, where there is a seed, `Radius` (mm). `name` is the data set's, for messages. Throws
/// std::invalid_argument, naming array and point.
ConstraintList ConstraintsOf(vtkPointSet* points, const std::string& name);

} // namespace FlipFree

#endif
