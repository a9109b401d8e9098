/**
 * The walls between labels as triangles, the surface of one label among them, and measures of both.
 */
#ifndef FlipFreeLabelMeasures_h
#define FlipFreeLabelMeasures_h

#include "LabelSurface/LabelGrid.h"
#include "Mesh/SurfaceVoxelization.h"

#include <functional>

namespace FlipFree
{

struct SharedWalls
{
  PointList Points;
  TriangleList Triangles; ///< counter-clockwise seen from the second label
  /// On both sides of each triangle, as indices into the values of labels. Background, 0, is the
  /// second one, or else the greater one.
  std::vector<std::array<int, 2>> Labels;
};

/// The surface of a label.
struct LabelBoundary
{
  PointList Points;
  TriangleList Triangles; ///< counter-clockwise seen from outside
};

/// Which triangles bear each label.
class TrianglesByLabel
{
public:
  /// Refers to the walls.
  TrianglesByLabel(const SharedWalls& walls, std::size_t numberOfLabels);

  /// The triangles of a label and their points, in their order.
  LabelBoundary BoundaryOf(int label) const;

private:
  const SharedWalls& Walls;
  std::vector<std::size_t> Begin;
  std::vector<int> Triangles;
};

/// What one label's surface is like.
struct LabelMeasures
{
  int Label = 0;
  std::size_t Voxels = 0;      ///< of the label map
  std::size_t WrongVoxels = 0; ///< inside and of another label, or the reverse, by their centers
  double Volume = 0;           ///< cubic millimeters
  double VoxelVolume = 0;      ///< of the label map's voxels, cubic millimeters
  double Area = 0;             ///< square millimeters
  int EulerNumber = 0;         ///< 2 for each piece and each cavity, less 2 for each tunnel
  int Triangles = 0;
};

/// How many voxels have each of the grid's labels.
std::vector<std::size_t> CountLabels(const LabelGrid& grid, const ParallelFor& parallelFor);

/// The measures of each label but for the wrong voxels. `walls` are in millimeters, and `voxels`
/// those of CountLabels().
std::vector<LabelMeasures> MeasureLabels(const SharedWalls& walls, const LabelGrid& grid,
  const ImageGeometry& image, const std::vector<std::size_t>& voxels);

/// Calls visit(label, run) for the voxels in each label's surface. `walls` are in the grid's
/// indices; where they intersect, voxels may be inside of several.
void VisitVoxelsInside(const SharedWalls& walls, const LabelGrid& grid,
  const ParallelFor& parallelFor, const std::function<void(int label, const VoxelRun& run)>& visit);

/// Fills in the wrong voxels of each label. Returns the number of voxels, of any label, that are
/// not where this label is.
std::size_t CountWrongVoxels(const SharedWalls& walls, const LabelGrid& grid,
  const ParallelFor& parallelFor, std::vector<LabelMeasures>& measures);

} // namespace FlipFree

#endif
