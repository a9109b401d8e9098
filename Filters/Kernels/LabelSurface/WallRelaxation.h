/**
 * Where the vertices of walls should lie: as smooth as their bounds allow.
 *
 * The walls minimize the sum of squared distances of vertices from the mean of their neighbors (the
 * bending energy, up to a factor, of a surface of regular faces) while no vertex leaves a box
 * about the center of its cell. A small weight on the distance from the center keeps vertices apart
 * along the walls. This quadratic problem with bounds is solved as such, by projected
 * gradients with momentum (A. Beck and M. Teboulle, A fast iterative shrinkage-thresholding
 * algorithm, 2009) that restart where the momentum leads uphill (B. O'Donoghue and E. Candes,
 * Adaptive restart for accelerated gradient schemes, 2015). So walls bend smoothly where they touch
 * their bounds, while steps that are clipped at them leave creases. Where three labels or more
 * meet, neighbors are only those along the curve in which they do.
 *
 * Bending walls of small labels shrinks them. At the end, each wall moves by a distance along its
 * normals, the difference of a value for each of the two labels, until labels have the volume of
 * their voxels again, as far as the bounds allow.
 *
 * Everything is in the grid's indices, in which the energy and the bounds do not mix the axes: the
 * result does not depend on spacing, shear and direction.
 */
#ifndef FlipFreeWallRelaxation_h
#define FlipFreeWallRelaxation_h

#include "LabelSurface/LabelWalls.h"

namespace FlipFree
{

struct RelaxationSettings
{
  double Bound = 0.49;  ///< along each axis, voxels
  double Anchor = 0.01; ///< weight of the squared distance from the center
  int Iterations = 50;
};

/// One per vertex, in the grid's indices; the last component is 0.
using Displacements = std::vector<Eigen::Array4f>;

/// Where vertices lie without displacement: in the centers of cells, in the middle of edges, and in
/// means.
PointList VerticesAtRest(const LabelWalls& walls, const LabelCells& cells);

/// The displacements from there, `volumes` being the volume of each label in voxels. None if the
/// monitor stopped it.
Displacements RelaxWalls(const LabelWalls& walls, const LabelCells& cells,
  const std::vector<std::size_t>& volumes, const RelaxationSettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif
