/**
 * The surfaces of the labels of a label map: closed, 2-manifold and embedded each, with one wall
 * between two labels.
 *
 *   LabelGrid        the labels as small numbers, in the box where they are,
 *   LabelParts       which parts of them get surfaces,
 *   LabelTunnels     which tunnels through them are closed,
 *   LabelCells       the cells between voxel centers, and the rule where labels touch by an edge,
 *   LabelWalls       the walls' connectivity,
 *   WallRelaxation   where their vertices should lie,
 *   WallTriangles    how walls are cut, and the proof that they do not intersect,
 *   SmoothLabels     the labels of surfaces that are smoother than the voxels allow,
 *   WallCollapse     and their edges collapsed, for fewer triangles.
 *
 * Vertices never leave their cells, so that walls do not intersect, and each voxel center is on the
 * side of its own label. Exact surfaces are those of the label map. Smooth ones are the same of
 * another map, that of the voxels inside of walls that were allowed to leave their cells. All steps
 * are linear in the number of voxels and walls, and none compares pairs of faces.
 */
#ifndef FlipFreeLabelSurfaces_h
#define FlipFreeLabelSurfaces_h

#include "LabelSurface/LabelGrid.h"
#include "LabelSurface/LabelMeasures.h"

namespace FlipFree
{

/// The ranges of settings.
constexpr double MinimumWallDistance = 0.5;
constexpr double MaximumWallDistance = 1;
constexpr int MaximumWallIterations = 10000;
constexpr double MaximumWallEdge = 1e6;     // mm
constexpr double MaximumWallTolerance = 10; // voxels
constexpr double MaximumSmallestPart = 1e9; // mm3, a thousand liters
constexpr double MaximumTunnel = 1e6;       // mm

struct LabelSurfaceSettings
{
  /// Every voxel center stays on its label's side: the voxels of the surfaces are the label map.
  bool Exact = false;

  /// Otherwise, how far walls may go from the corners where voxels of different labels meet, along
  /// each axis, to be smooth: voxels, 0.5 to 1. A voxel whose center they pass changes sides.
  double Distance = 0.9;

  /// Of the smoothing: 0 to 10,000. Without any, walls are those of the voxels' corners.
  int Iterations = 50;

  /// Parts of labels that are smaller get no surface, cubic millimeters; 0 keeps all.
  double SmallestPart = 0;

  /// Nor do parts of the background that do not reach its outside (LabelParts.h).
  bool FillCavities = false;

  /// Tunnels through labels are closed if no ball of this diameter passes (LabelTunnels.h),
  /// millimeters; 0 leaves all open.
  double FillTunnels = 0;

  /// Fewer triangles: edges are collapsed while none becomes longer than this, in millimeters, and
  /// while there are more triangles than that. 0 sets no limit; both 0, the default, collapse none.
  double EdgeLength = 0;
  int Triangles = 0;

  /// How far they may move the walls, in voxels of the smallest spacing. Exact ones also keep every
  /// voxel on its side.
  double Tolerance = 0.5;
};

struct LabelSurfaces
{
  SharedWalls Walls;       ///< in millimeters, in numbers that single precision holds
  std::vector<int> Values; ///< of the labels that the walls name: background, and then ascending
  std::vector<LabelMeasures> Measures; ///< of each label, ascending; without triangles, it has no
                                       ///< surface
  /// Centers of voxels of any label that are not where this label is, also where parts got no
  /// surface.
  std::size_t WrongVoxels = 0;
  /// Of a vertex from the corner of voxels of different labels, in millimeters.
  double GreatestDistance = 0;
  /// Of walls from where they were before edges were collapsed, in millimeters
  /// (FlipFree::CollapseDistance()).
  double CollapseDistance = 0;
  /// False if the monitor stopped it; the rest is then meaningless.
  bool Complete = false;
};

/// `image` is where the grid is from. Throws Error for settings out of their range, where single
/// precision cannot hold the surfaces, and where no part of any label is large enough.
LabelSurfaces MakeLabelSurfaces(const LabelGrid& grid, const ImageGeometry& image,
  const LabelSurfaceSettings& settings, const ParallelFor& parallelFor = SerialFor,
  const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif
