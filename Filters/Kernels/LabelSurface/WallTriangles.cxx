#include "LabelSurface/WallTriangles.h"

#include <Eigen/Geometry>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Six times the volume between a corner of a wall and a voxel center, in voxels. Far above the
// rounding error of the test, whose lengths are below 2.
constexpr double MinimumSeparation = 1e-9;

// Vertices that cut the edge between two voxels keep this part of it away from both.
constexpr double PairMargin = 0.1;

// How a wall of four corners is cut.
enum class Cut : char
{
  First,  // from its first to its third corner
  Second, // from its second to its fourth
  Fan     // from a vertex of its own
};

bool Separates(const Vector3d& a, const Vector3d& b, const Vector3d& c,
  const std::array<Vector3d, 2>& centers)
{
  const Vector3d normal = (b - a).cross(c - a);
  return normal.dot(centers[0] - a) < -MinimumSeparation &&
    normal.dot(centers[1] - a) > MinimumSeparation;
}

class WallCutter
{
public:
  WallCutter(const LabelWalls& walls, const LabelCells& cells, const GridFrame* frame,
    PointList points)
    : Walls(walls)
    , Cells(cells)
    , Frame(frame)
    , Points(std::move(points))
    , Cuts(walls.Quads.size(), Cut::First)
  {
  }

  void Choose(const ParallelFor& parallelFor)
  {
    parallelFor(0, static_cast<std::ptrdiff_t>(this->Cuts.size()),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t quad = first; quad < last; ++quad)
        {
          this->Cuts[quad] = this->CutOf(quad);
        }
      });
  }

  SharedWalls Make()
  {
    SharedWalls result;
    const auto fans = std::count(this->Cuts.begin(), this->Cuts.end(), Cut::Fan);
    const Eigen::Index count =
      static_cast<Eigen::Index>(2 * this->Cuts.size() + 2 * fans + this->Walls.Triangles.size());
    result.Triangles.resize(count, 3);
    result.Labels.reserve(count);
    Eigen::Index center = this->Points.rows();
    this->Points.conservativeResize(center + fans, 3);
    const auto add = [&](int a, int b, int c, const std::array<int, 2>& labels)
    {
      result.Triangles.row(static_cast<Eigen::Index>(result.Labels.size())) << a, b, c;
      result.Labels.push_back(labels);
    };
    for (std::size_t quad = 0; quad < this->Cuts.size(); ++quad)
    {
      const auto& q = this->Walls.Quads[quad];
      const auto& labels = this->Walls.QuadLabels[quad];
      if (this->Cuts[quad] == Cut::Fan)
      {
        this->Points.row(center) = this->CenterOf(quad);
        for (int i = 0; i < 4; ++i)
        {
          add(static_cast<int>(center), q[i], q[(i + 1) % 4], labels);
        }
        ++center;
        continue;
      }
      const int first = this->Cuts[quad] == Cut::First ? 0 : 1;
      add(q[first], q[first + 1], q[first + 2], labels);
      add(q[first], q[first + 2], q[(first + 3) % 4], labels);
    }
    for (std::size_t i = 0; i < this->Walls.Triangles.size(); ++i)
    {
      const auto& triangle = this->Walls.Triangles[i];
      add(triangle[0], triangle[1], triangle[2], this->Walls.TriangleLabels[i]);
    }
    result.Points = std::move(this->Points);
    return result;
  }

private:
  std::array<Vector3d, 2> CentersOf(std::size_t quad) const
  {
    const auto nodes = this->Walls.NodesOf(this->Walls.QuadVoxels[quad], this->Cells);
    return { { nodes[0].AtRest(), nodes[1].AtRest() } };
  }

  // The shorter of the diagonals that will do.
  Cut CutOf(std::size_t quad) const
  {
    const auto centers = this->CentersOf(quad);
    const auto& q = this->Walls.Quads[quad];
    const auto at = [&](int corner) -> Vector3d
    { return this->Points.row(q[corner % 4]).transpose(); };
    const bool isFirstShorter =
      this->Frame->LengthOf(at(2) - at(0)) <= this->Frame->LengthOf(at(3) - at(1));
    for (const int first : { isFirstShorter ? 0 : 1, isFirstShorter ? 1 : 0 })
    {
      if (Separates(at(first), at(first + 1), at(first + 2), centers) &&
        Separates(at(first + 2), at(first + 3), at(first), centers))
      {
        return first == 0 ? Cut::First : Cut::Second;
      }
    }
    return Cut::Fan;
  }

  // On the edge between the two voxels, as near to the corners as can be.
  Vector3d CenterOf(std::size_t quad) const
  {
    const auto centers = this->CentersOf(quad);
    const Vector3d along = centers[1] - centers[0];
    double part = 0;
    for (const int corner : this->Walls.Quads[quad])
    {
      part += (this->Points.row(corner).transpose() - centers[0]).dot(along) / 4;
    }
    part = std::max(PairMargin, std::min(1 - PairMargin, part));
    return this->Frame->Rounded(centers[0] + part * along);
  }

  const LabelWalls& Walls;
  const LabelCells& Cells;
  const GridFrame* const Frame;
  PointList Points;
  std::vector<Cut> Cuts;
};

} // namespace

SharedWalls CutWalls(const LabelWalls& walls, const LabelCells& cells,
  const Displacements& displacements, const GridFrame* frame, const ParallelFor& parallelFor)
{
  PointList points = VerticesAtRest(walls, cells);
  parallelFor(0, points.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
      {
        const Vector3d point =
          points.row(vertex).transpose() + displacements[vertex].head<3>().matrix().cast<double>();
        points.row(vertex) = frame ? frame->Rounded(point) : point;
      }
    });
  WallCutter cutter(walls, cells, frame, std::move(points));
  if (frame)
  {
    cutter.Choose(parallelFor);
  }
  return cutter.Make();
}

} // namespace FlipFree
