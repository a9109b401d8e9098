/**
 * Private to the module: constraints from a data set of points.
 */
#ifndef FlipFreeConstraintPoints_h
#define FlipFreeConstraintPoints_h

#include "Image/PointConstraint.h"

#include <string>
#include <utility>
#include <vector>

class vtkPointSet;

namespace FlipFree
{

/// The points as constraints: point arrays `Constraint` (0 outside, 1 inside, 2 boundary, 3 seed)
/// and, where there is a seed, `Radius` (mm). `name` is the data set's, for messages. Throws
/// std::invalid_argument, naming array and point.
ConstraintList ConstraintsOf(vtkPointSet* points, const std::string& name);

/// Organs by name, each with its points and seeds.
using NamedConstraints = std::vector<std::pair<std::string, ConstraintList>>;

/// Adds the points to the organs that the point array `Organ` names, or numbers from 1; new organs
/// come last. Throws std::invalid_argument as ConstraintsOf(), and for a number that skips one.
void AddConstraintsOf(vtkPointSet* points, const std::string& name, NamedConstraints& organs);

/// Takes the largest seed of an organ from its constraints. Throws std::invalid_argument, naming
/// the organ, where there is none.
void TakeSeed(const std::string& name, SeedSphere& seed, ConstraintList& constraints);

} // namespace FlipFree

#endif
