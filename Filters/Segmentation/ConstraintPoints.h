/**
 * Private to the module: constraints from data sets of points, as many as a port has.
 */
#ifndef FlipFreeConstraintPoints_h
#define FlipFreeConstraintPoints_h

#include "Deformation/SegmentationRequest.h"

#include <vector>

class vtkInformationVector;

namespace FlipFree
{

/// The points of all data sets of an input port as constraints: point arrays `Constraint` (0
/// outside, 1 inside, 2 boundary, 3 seed) and, where there is a seed, `Radius` (mm). `port` is the
/// port's number, for messages. Throws Error, naming data set, array and point.
ConstraintList ConstraintsOf(vtkInformationVector* inputs, int port);

/// Adds the points to the organs that the point array `Organ` names, or numbers from 1; new organs
/// come last, first those with names, then by number, in whatever order points and data sets are.
/// Throws Error as ConstraintsOf(), and for a number that skips one.
void AddConstraintsOf(vtkInformationVector* inputs, int port, std::vector<NamedOrgan>& organs);

} // namespace FlipFree

#endif
