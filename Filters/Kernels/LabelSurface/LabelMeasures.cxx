#include "LabelSurface/LabelMeasures.h"

#include <Eigen/Geometry>

#include <functional>
#include <mutex>
#include <numeric>

namespace FlipFree
{
namespace
{

// A vertex is on the walls of no more labels than a cell has corners.
constexpr int MaximumLabelsOfVertex = 8;

// The number of the walls' vertices on the surface of each of the grid's labels.
std::vector<int> CountVertices(const SharedWalls& walls, const LabelGrid& grid)
{
  std::vector<std::array<int, MaximumLabelsOfVertex>> labelsOf(walls.Points.rows());
  for (auto& labels : labelsOf)
  {
    labels.fill(0);
  }
  std::vector<int> counts(grid.Values.size(), 0);
  for (Eigen::Index triangle = 0; triangle < walls.Triangles.rows(); ++triangle)
  {
    for (const int label : walls.Labels[triangle])
    {
      for (int corner = 0; label != 0 && corner < 3; ++corner)
      {
        auto& labels = labelsOf[walls.Triangles(triangle, corner)];
        auto place = labels.begin();
        while (place != labels.end() && *place != 0 && *place != label)
        {
          ++place;
        }
        if (place != labels.end() && *place == 0)
        {
          *place = label;
          ++counts[label];
        }
      }
    }
  }
  return counts;
}

// Points whose numbers span no more than so many times their triangles are looked up in a table.
constexpr std::size_t GreatestSpan = 16;

// Replaces the corners of triangles by their places in the list of all points there, ascending,
// which it returns.
std::vector<int> NumberCorners(TriangleList& triangles)
{
  int* const begin = triangles.data();
  int* const end = begin + triangles.size();
  if (begin == end)
  {
    return {};
  }
  const auto [least, greatest] = std::minmax_element(begin, end);
  const int first = *least;
  const std::size_t span = static_cast<std::size_t>(*greatest - first) + 1;
  std::vector<int> points;
  if (span > GreatestSpan * static_cast<std::size_t>(triangles.rows()))
  {
    points.assign(begin, end);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::transform(begin, end, begin,
      [&points](int corner)
      {
        return static_cast<int>(
          std::lower_bound(points.begin(), points.end(), corner) - points.begin());
      });
    return points;
  }
  std::vector<int> places(span, 0);
  std::for_each(begin, end, [&](int corner) { places[corner - first] = 1; });
  for (std::size_t place = 0; place < span; ++place)
  {
    if (places[place] != 0)
    {
      places[place] = static_cast<int>(points.size());
      points.push_back(first + static_cast<int>(place));
    }
  }
  std::transform(begin, end, begin, [&](int corner) { return places[corner - first]; });
  return points;
}

} // namespace

TrianglesByLabel::TrianglesByLabel(const SharedWalls& walls, std::size_t numberOfLabels)
  : Walls(walls)
  , Begin(numberOfLabels + 1, 0)
  , Triangles(2 * walls.Labels.size())
{
  for (const auto& labels : walls.Labels)
  {
    ++this->Begin[labels[0] + 1];
    ++this->Begin[labels[1] + 1];
  }
  std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (std::size_t triangle = 0; triangle < walls.Labels.size(); ++triangle)
  {
    for (const int label : walls.Labels[triangle])
    {
      this->Triangles[next[label]++] = static_cast<int>(triangle);
    }
  }
}

LabelBoundary TrianglesByLabel::BoundaryOf(int label) const
{
  const SharedWalls& walls = this->Walls;
  const std::size_t begin = this->Begin[label];
  const auto count = static_cast<Eigen::Index>(this->Begin[label + 1] - begin);
  LabelBoundary boundary;
  boundary.Triangles.resize(count, 3);
  for (Eigen::Index row = 0; row < count; ++row)
  {
    const int triangle = this->Triangles[begin + row];
    const bool isFirst = walls.Labels[triangle][0] == label;
    for (int corner = 0; corner < 3; ++corner)
    {
      boundary.Triangles(row, corner) = walls.Triangles(triangle, isFirst ? corner : 2 - corner);
    }
  }
  const std::vector<int> points = NumberCorners(boundary.Triangles);
  boundary.Points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    boundary.Points.row(static_cast<Eigen::Index>(point)) = walls.Points.row(points[point]);
  }
  return boundary;
}

std::vector<std::size_t> CountLabels(const LabelGrid& grid, const ParallelFor& parallelFor)
{
  std::vector<std::size_t> counts(grid.Values.size(), 0);
  std::mutex mutex;
  parallelFor(0, static_cast<std::ptrdiff_t>(grid.Labels.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<std::size_t> found(counts.size(), 0);
      for (std::ptrdiff_t begin = first; begin < last;)
      {
        const int label = grid.Labels[begin];
        const std::ptrdiff_t start = begin;
        while (begin < last && grid.Labels[begin] == label)
        {
          ++begin;
        }
        found[label] += begin - start;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      std::transform(counts.begin(), counts.end(), found.begin(), counts.begin(),
        std::plus<std::size_t>());
    });
  return counts;
}

std::vector<LabelMeasures> MeasureLabels(const SharedWalls& walls, const LabelGrid& grid,
  const ImageGeometry& image, const std::vector<std::size_t>& voxels)
{
  std::vector<LabelMeasures> all(grid.Values.size());
  const Eigen::RowVector3d origin = walls.Points.colwise().mean();
  for (Eigen::Index triangle = 0; triangle < walls.Triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a = walls.Points.row(walls.Triangles(triangle, 0)) - origin;
    const Eigen::Vector3d b = walls.Points.row(walls.Triangles(triangle, 1)) - origin;
    const Eigen::Vector3d c = walls.Points.row(walls.Triangles(triangle, 2)) - origin;
    const double area = (b - a).cross(c - a).norm() / 2;
    const double volume = a.dot(b.cross(c)) / 6;
    for (int side = 0; side < 2; ++side)
    {
      LabelMeasures& measures = all[walls.Labels[triangle][side]];
      measures.Volume += side == 0 ? volume : -volume;
      measures.Area += area;
      ++measures.Triangles;
    }
  }
  const std::vector<int> vertices = CountVertices(walls, grid);
  for (std::size_t label = 1; label < all.size(); ++label)
  {
    LabelMeasures& measures = all[label];
    measures.Label = grid.Values[label];
    measures.Voxels = voxels[label];
    measures.VoxelVolume = static_cast<double>(voxels[label]) * image.VoxelVolume();
    // A closed surface of triangles has three edges for two of them.
    measures.EulerNumber = vertices[label] - measures.Triangles / 2;
  }
  all.erase(all.begin()); // background
  return all;
}

void VisitVoxelsInside(const SharedWalls& walls, const LabelGrid& grid,
  const ParallelFor& parallelFor, const std::function<void(int label, const VoxelRun& run)>& visit)
{
  const TrianglesByLabel triangles(walls, grid.Values.size());
  for (int label = 1; label < static_cast<int>(grid.Values.size()); ++label)
  {
    LabelBoundary boundary = triangles.BoundaryOf(label);
    if (boundary.Points.rows() == 0)
    {
      continue;
    }
    // The rows of voxels around the label alone.
    const Eigen::RowVector3d low =
      boundary.Points.colwise().minCoeff().array().floor().max(0).matrix();
    const Eigen::RowVector3d high = boundary.Points.colwise().maxCoeff();
    ImageGeometry box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.Dimensions[axis] = std::min(static_cast<int>(high[axis]) + 1, grid.Size[axis] - 1) -
        static_cast<int>(low[axis]) + 1;
    }
    boundary.Points.rowwise() -= low;
    for (VoxelRun run : VoxelizeSurface(boundary.Points, boundary.Triangles, box, parallelFor))
    {
      run.J += static_cast<int>(low[1]);
      run.K += static_cast<int>(low[2]);
      run.Begin += static_cast<int>(low[0]);
      run.End += static_cast<int>(low[0]);
      visit(label, run);
    }
  }
}

std::size_t CountWrongVoxels(const SharedWalls& walls, const LabelGrid& grid,
  const ParallelFor& parallelFor, std::vector<LabelMeasures>& measures)
{
  std::size_t foreign = 0; // inside of a surface, with another label or none
  std::size_t covered = 0; // inside of a surface, with any label
  std::vector<std::size_t> right(measures.size(), 0);
  VisitVoxelsInside(walls, grid, parallelFor,
    [&](int label, const VoxelRun& run)
    {
      const LabelGrid::Index* const row = &grid.Labels[grid.Offset(0, run.J, run.K)];
      const std::size_t inside = run.End - run.Begin;
      const std::size_t same = std::count(row + run.Begin, row + run.End, label);
      measures[label - 1].WrongVoxels += inside - same;
      right[label - 1] += same;
      foreign += inside - same;
      covered += inside - std::count(row + run.Begin, row + run.End, 0);
    });
  std::size_t all = 0;
  for (std::size_t index = 0; index < measures.size(); ++index)
  {
    measures[index].WrongVoxels += measures[index].Voxels - right[index];
    all += measures[index].Voxels;
  }
  return foreign + all - covered;
}

} // namespace FlipFree
