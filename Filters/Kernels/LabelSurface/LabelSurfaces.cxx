#include "LabelSurface/LabelSurfaces.h"

#include "LabelSurface/LabelParts.h"
#include "LabelSurface/LabelTunnels.h"
#include "LabelSurface/SmoothLabels.h"
#include "LabelSurface/WallCollapse.h"
#include "LabelSurface/WallTriangles.h"
#include "MessageText.h"

#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

void RequireInRange(const LabelSurfaceSettings& settings)
{
  if (!(settings.Distance >= MinimumWallDistance && settings.Distance <= MaximumWallDistance))
  {
    throw Error(ErrorCode::OutOfRange,
      "{Distance} is " + TextOf(settings.Distance) + " voxels; choose " +
        TextOf(MinimumWallDistance) + " to " + TextOf(MaximumWallDistance) +
        ", or {Exact} surfaces");
  }
  if (settings.Iterations < 0 || settings.Iterations > MaximumWallIterations)
  {
    throw Error(ErrorCode::OutOfRange,
      "{Iterations} is " + std::to_string(settings.Iterations) + "; choose 0 to " +
        std::to_string(MaximumWallIterations));
  }
  if (!(settings.SmallestPart >= 0 && settings.SmallestPart <= MaximumSmallestPart))
  {
    throw Error(ErrorCode::OutOfRange,
      "{SmallestPart} is " + TextOf(settings.SmallestPart) + " mm3; choose 0, to keep all, to " +
        TextOf(MaximumSmallestPart));
  }
  if (!(settings.FillTunnels >= 0 && settings.FillTunnels <= MaximumTunnel))
  {
    throw Error(ErrorCode::OutOfRange,
      "{FillTunnels} is " + TextOf(settings.FillTunnels) + " mm; choose 0, for none, to " +
        TextOf(MaximumTunnel));
  }
  if (!(settings.EdgeLength >= 0 && settings.EdgeLength <= MaximumWallEdge))
  {
    throw Error(ErrorCode::OutOfRange,
      "{EdgeLength} is " + TextOf(settings.EdgeLength) + " mm; choose 0, for no limit, to " +
        TextOf(MaximumWallEdge));
  }
  if (settings.Triangles < 0)
  {
    throw Error(ErrorCode::OutOfRange,
      "{Triangles} is " + std::to_string(settings.Triangles) + "; choose 0, for no limit, or more");
  }
  if (!(settings.Tolerance >= 0 && settings.Tolerance <= MaximumWallTolerance))
  {
    throw Error(ErrorCode::OutOfRange,
      "{Tolerance} is " + TextOf(settings.Tolerance) + " voxels; choose 0 to " +
        TextOf(MaximumWallTolerance));
  }
}

// Collapses edges of walls in space, of which `result` has the same in the grid's indices.
bool Coarsen(const LabelSurfaceSettings& settings, const ImageGeometry& image, bool isLeftHanded,
  const ParallelFor& parallelFor, const Monitor& monitor, SharedWalls& inSpace,
  LabelSurfaces& result)
{
  if (settings.EdgeLength == 0 && settings.Triangles == 0)
  {
    return true;
  }
  const SharedWalls before = inSpace;
  const CollapseSettings collapse{ settings.EdgeLength, settings.Triangles,
    settings.Tolerance * image.Spacing.minCoeff(), settings.Exact };
  if (!CollapseWalls(collapse, monitor, inSpace, result.Walls.Points))
  {
    return false;
  }
  result.Walls.Triangles = inSpace.Triangles;
  result.Walls.Labels = inSpace.Labels;
  if (isLeftHanded)
  {
    result.Walls.Triangles.col(1).swap(result.Walls.Triangles.col(2));
  }
  result.CollapseDistance = FlipFree::CollapseDistance(before, inSpace, parallelFor);
  return true;
}

// The labels that get surfaces: the grid itself, or `changed`. None if the monitor stopped it.
const LabelGrid* KeptOf(const LabelGrid& grid, const ImageGeometry& image,
  const LabelSurfaceSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  LabelGrid& changed)
{
  LabelPartSettings parts;
  parts.SmallestPart =
    static_cast<std::size_t>(std::ceil(settings.SmallestPart / image.VoxelVolume()));
  parts.FillCavities = settings.FillCavities;
  if (parts.KeepsAll() && settings.FillTunnels == 0)
  {
    return &grid;
  }
  changed = grid;
  if (!CloseTunnels(changed, image.Spacing, settings.FillTunnels, parallelFor, monitor))
  {
    return nullptr;
  }
  changed = KeepParts(std::move(changed), parts, parallelFor); // a closed tunnel may be a cavity
  if (std::all_of(changed.Labels.begin(), changed.Labels.end(),
        [](int label) { return label == 0; }))
  {
    throw Error(ErrorCode::EmptyMask,
      "no part of any label has " + TextOf(settings.SmallestPart) + " mm3; lower {SmallestPart}");
  }
  return &changed;
}

// The walls of a grid, relaxed within bounds.
struct RelaxedWalls
{
  RelaxedWalls(const LabelGrid& grid, const ParallelFor& parallelFor)
    : Cells(grid, parallelFor)
    , Walls(grid, this->Cells, parallelFor)
  {
  }

  // False if the monitor stopped it.
  bool Relax(const std::vector<std::size_t>& volumes, double bound, int iterations,
    const ParallelFor& parallelFor, const Monitor& monitor)
  {
    RelaxationSettings settings;
    settings.Bound = bound;
    settings.Iterations = iterations;
    this->Shifts = RelaxWalls(this->Walls, this->Cells, volumes, settings, parallelFor, monitor);
    return !this->Shifts.empty();
  }

  SharedWalls Cut(const GridFrame& frame, const ParallelFor& parallelFor) const
  {
    return CutWalls(this->Walls, this->Cells, this->Shifts, &frame, parallelFor);
  }

  // In the grid's indices. Leaves the cells alone.
  SharedWalls TakeCut(const ParallelFor& parallelFor)
  {
    const LabelWalls walls = std::move(this->Walls);
    const Displacements shifts = std::move(this->Shifts);
    return CutWalls(walls, this->Cells, shifts, nullptr, parallelFor);
  }

  const LabelCells Cells;
  LabelWalls Walls;
  Displacements Shifts;
};

// Of a vertex from the center of a cell of the label map, in which different labels meet: its own,
// or the nearest of those around.
double GreatestDistanceOf(const RelaxedWalls& walls, const LabelCells& original,
  const PointList& points, const GridFrame& frame)
{
  double greatest = 0;
  for (std::size_t vertex = 0; vertex < walls.Walls.Cells.size(); ++vertex)
  {
    const auto place = walls.Cells.Grid.PlaceOf(walls.Walls.Cells[vertex]);
    const auto distanceTo = [&](const std::array<int, 3>& cell)
    {
      return frame.LengthOf(points.row(static_cast<Eigen::Index>(vertex)).transpose() -
        LatticeNode{ cell, true }.AtRest());
    };
    if (original.Grid.Find(place[0], place[1], place[2]) >= 0)
    {
      greatest = std::max(greatest, distanceTo(place));
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (int code = 0; code < 27; ++code)
    {
      const std::array<int, 3> cell{ { place[0] + code % 3 - 1, place[1] + code / 3 % 3 - 1,
        place[2] + code / 9 - 1 } };
      if (original.Grid.Find(cell[0], cell[1], cell[2]) >= 0)
      {
        nearest = std::min(nearest, distanceTo(cell));
      }
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

// From the grid's indices to millimeters.
void ToSpace(SharedWalls& walls, const GridFrame& frame, const ParallelFor& parallelFor)
{
  parallelFor(0, walls.Points.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t point = first; point < last; ++point)
      {
        walls.Points.row(point) = frame.RoundedPoint(walls.Points.row(point));
      }
    });
  if (frame.IsLeftHanded())
  {
    walls.Triangles.col(1).swap(walls.Triangles.col(2));
  }
}

} // namespace

LabelSurfaces MakeLabelSurfaces(const LabelGrid& grid, const ImageGeometry& image,
  const LabelSurfaceSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor)
{
  RequireInRange(settings);
  LabelSurfaces result;
  const GridFrame frame(image, grid.First);
  LabelGrid changed;
  const LabelGrid* const kept =
    KeptOf(grid, image, settings, parallelFor, PartOf(monitor, 0, 0.1), changed);
  if (!kept)
  {
    return result;
  }
  const std::vector<std::size_t> voxels = CountLabels(*kept, parallelFor);
  RelaxedWalls walls(*kept, parallelFor);
  if (!walls.Relax(voxels, settings.Exact ? CellBound : std::max(CellBound, settings.Distance),
        settings.Iterations, parallelFor, PartOf(monitor, 0.1, settings.Exact ? 0.8 : 0.4)))
  {
    return result;
  }
  if (settings.Exact)
  {
    result.Walls = walls.Cut(frame, parallelFor);
    result.GreatestDistance = GreatestDistanceOf(walls, walls.Cells, result.Walls.Points, frame);
  }
  else
  {
    RelaxedWalls smooth(SmoothLabels(*kept, walls.TakeCut(parallelFor), parallelFor), parallelFor);
    if (!smooth.Relax(voxels, CellBound, settings.Iterations, parallelFor,
          PartOf(monitor, 0.5, 0.8)))
    {
      return result;
    }
    result.Walls = smooth.Cut(frame, parallelFor);
    result.GreatestDistance = GreatestDistanceOf(smooth, walls.Cells, result.Walls.Points, frame);
  }
  SharedWalls inSpace = result.Walls;
  ToSpace(inSpace, frame, parallelFor);
  if (!Coarsen(settings, image, frame.IsLeftHanded(), parallelFor, PartOf(monitor, 0.8, 0.9),
        inSpace, result))
  {
    return result;
  }
  result.Measures = MeasureLabels(inSpace, grid, image, CountLabels(grid, parallelFor));
  if (!monitor(0.9))
  {
    return result;
  }
  result.WrongVoxels = CountWrongVoxels(result.Walls, grid, parallelFor, result.Measures);
  result.Walls = std::move(inSpace);
  result.Values = grid.Values;
  result.Complete = monitor(1);
  return result;
}

} // namespace FlipFree
