#include "LabelSurface/WallRelaxation.h"

#include <Eigen/Geometry>

#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Array4f;
using Eigen::Vector3d;

// Vertices on edges stay this part of the edge away from its ends, and so do those in means.
constexpr float EdgeMargin = 0.1F;

constexpr int VolumeIterations = 4;

// A sparse matrix of zeros and ones.
struct Graph
{
  std::vector<int> Begin;
  std::vector<int> Ends;

  int NumberOfRows() const { return static_cast<int>(this->Begin.size()) - 1; }
  int Size(int row) const { return this->Begin[row + 1] - this->Begin[row]; }
};

template <typename Visit>
void VisitSides(const LabelWalls& walls, const Visit& visit)
{
  const auto visitAll = [&](const auto& faces)
  {
    for (const auto& face : faces)
    {
      for (std::size_t i = 0; i < face.size(); ++i)
      {
        visit(face[i], face[(i + 1) % face.size()]);
      }
    }
  };
  visitAll(walls.Quads);
  visitAll(walls.Triangles);
}

// The neighbors of each vertex. Of a vertex where three walls meet, those along their curve.
Graph NeighborsOf(const LabelWalls& walls, const ParallelFor& parallelFor)
{
  const int count = walls.NumberOfVertices();
  std::vector<int> begin(count + 1, 0);
  VisitSides(walls,
    [&](int one, int two)
    {
      ++begin[one + 1];
      ++begin[two + 1];
    });
  for (int vertex = 0; vertex < count; ++vertex)
  {
    begin[vertex + 1] += begin[vertex];
  }
  std::vector<int> ends(begin.back());
  std::vector<int> next(begin.begin(), begin.end() - 1);
  VisitSides(walls,
    [&](int one, int two)
    {
      ends[next[one]++] = two;
      ends[next[two]++] = one;
    });
  // In place: neighbors come to the front of each row, and `next` becomes their number.
  parallelFor(0, count,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<int> curve;
      for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
      {
        int* const row = ends.data() + begin[vertex];
        int* const end = ends.data() + begin[vertex + 1];
        std::sort(row, end);
        curve.clear();
        int* kept = row;
        for (const int* run = row; run < end;)
        {
          const int neighbor = *run;
          const int* const start = run;
          while (run < end && *run == neighbor)
          {
            ++run;
          }
          if (run - start > 2)
          {
            curve.push_back(neighbor);
          }
          *kept++ = neighbor;
        }
        if (!curve.empty())
        {
          kept = std::copy(curve.begin(), curve.end(), row);
        }
        next[vertex] = static_cast<int>(kept - row);
      }
    });
  Graph graph;
  graph.Begin.assign(count + 1, 0);
  for (int vertex = 0; vertex < count; ++vertex)
  {
    graph.Begin[vertex + 1] = graph.Begin[vertex] + next[vertex];
    // Rows move forward only.
    std::copy(ends.begin() + begin[vertex], ends.begin() + begin[vertex] + next[vertex],
      ends.begin() + graph.Begin[vertex]);
  }
  ends.resize(graph.Begin.back());
  graph.Ends = std::move(ends);
  return graph;
}

Graph Transposed(const Graph& graph)
{
  Graph transposed;
  transposed.Begin.assign(graph.Begin.size(), 0);
  transposed.Ends.resize(graph.Ends.size());
  for (const int end : graph.Ends)
  {
    ++transposed.Begin[end + 1];
  }
  for (int row = 0; row < graph.NumberOfRows(); ++row)
  {
    transposed.Begin[row + 1] += transposed.Begin[row];
  }
  std::vector<int> next(transposed.Begin.begin(), transposed.Begin.end() - 1);
  for (int row = 0; row < graph.NumberOfRows(); ++row)
  {
    for (int place = graph.Begin[row]; place < graph.Begin[row + 1]; ++place)
    {
      transposed.Ends[next[graph.Ends[place]]++] = row;
    }
  }
  return transposed;
}

Array4f SumOver(const Graph& graph, int row, const Displacements& values)
{
  Array4f sum = Array4f::Zero();
  for (int place = graph.Begin[row]; place < graph.Begin[row + 1]; ++place)
  {
    sum += values[graph.Ends[place]];
  }
  return sum;
}

// The bounds of the vertices.
class WallBounds
{
public:
  WallBounds(const LabelWalls& walls, double bound)
    : Walls(walls)
    , Bound(static_cast<float>(bound))
  {
    for (const auto& edge : walls.Edges)
    {
      this->Directions.push_back(Array4f::Zero());
      this->Directions.back().head<3>() =
        (edge[1].AtRest() - edge[0].AtRest()).cast<float>().array();
    }
  }

  int NumberOfFree() const { return this->Walls.FirstMean(); }

  /// Of a vertex in a cell or on an edge.
  Array4f Nearest(int vertex, const Array4f& displacement) const
  {
    if (vertex < this->Walls.FirstEdge())
    {
      return displacement.max(-this->Bound).min(this->Bound);
    }
    const Array4f& direction = this->Directions[vertex - this->Walls.FirstEdge()];
    const float along = (displacement * direction).sum() / direction.square().sum();
    return std::max(EdgeMargin - 0.5F, std::min(0.5F - EdgeMargin, along)) * direction;
  }

  /// Means follow the vertices that they are of.
  void PlaceMeans(Displacements& displacements) const
  {
    int vertex = this->Walls.FirstMean();
    for (const LabelWalls::Mean& mean : this->Walls.Means)
    {
      Array4f sum = Array4f::Zero();
      for (int i = 0; i < mean.Count; ++i)
      {
        sum += displacements[mean.Of[i]];
      }
      displacements[vertex++] = sum / static_cast<float>(mean.Count);
    }
  }

private:
  const LabelWalls& Walls;
  const float Bound;
  Displacements Directions;
};

class BendingMinimizer
{
public:
  BendingMinimizer(const LabelWalls& walls, const LabelCells& cells, const WallBounds& bounds,
    const RelaxationSettings& settings, const ParallelFor& parallelFor)
    : Bounds(bounds)
    , Anchor(static_cast<float>(settings.Anchor))
    , For(parallelFor)
    , Neighbors(NeighborsOf(walls, parallelFor))
    , Users(Transposed(this->Neighbors))
    , Inverse(walls.NumberOfVertices())
    , AtRest(walls.NumberOfVertices())
    , Residuals(walls.NumberOfVertices())
    , Now(walls.NumberOfVertices(), Array4f::Zero())
    , Ahead(this->Now)
  {
    const int count = walls.NumberOfVertices();
    const PointList points = VerticesAtRest(walls, cells);
    parallelFor(0, count,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (int vertex = static_cast<int>(first); vertex < last; ++vertex)
        {
          const int size = this->Neighbors.Size(vertex);
          this->Inverse[vertex] = 1.0F / static_cast<float>(size);
          Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
          for (int place = 0; place < size; ++place)
          {
            sum += points.row(this->Neighbors.Ends[this->Neighbors.Begin[vertex] + place]) -
              points.row(vertex);
          }
          this->AtRest[vertex] = Array4f::Zero();
          this->AtRest[vertex].head<3>() = (-sum / size).cast<float>().transpose().array();
        }
      });
    // The square of the matrix's norm is at most the product of its norms by rows and by columns.
    float columns = 0;
    for (int vertex = 0; vertex < count; ++vertex)
    {
      float sum = 1;
      for (int place = this->Users.Begin[vertex]; place < this->Users.Begin[vertex + 1]; ++place)
      {
        sum += this->Inverse[this->Users.Ends[place]];
      }
      columns = std::max(columns, sum);
    }
    this->Step = 1 / (2 * columns + this->Anchor);
  }

  void Iterate()
  {
    const int count = static_cast<int>(this->Now.size());
    // Residuals, each divided by the number of neighbors: how far a vertex is from their mean.
    this->For(0, count,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (int vertex = static_cast<int>(first); vertex < last; ++vertex)
        {
          const float inverse = this->Inverse[vertex];
          this->Residuals[vertex] = inverse *
            (this->AtRest[vertex] + this->Ahead[vertex] -
              inverse * SumOver(this->Neighbors, vertex, this->Ahead));
        }
      });
    const float nextMomentum = (1 + std::sqrt(1 + 4 * this->Momentum * this->Momentum)) / 2;
    const float factor = (this->Momentum - 1) / nextMomentum;
    // Sums of chunks, whose order does not depend on the threads.
    constexpr int Chunk = 4096;
    const int free = this->Bounds.NumberOfFree();
    std::vector<float> uphill((free + Chunk - 1) / Chunk, 0);
    this->For(0, static_cast<std::ptrdiff_t>(uphill.size()),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (int chunk = static_cast<int>(first); chunk < last; ++chunk)
        {
          for (int vertex = chunk * Chunk; vertex < std::min(free, (chunk + 1) * Chunk); ++vertex)
          {
            const Array4f gradient = this->Residuals[vertex] / this->Inverse[vertex] -
              SumOver(this->Users, vertex, this->Residuals) + this->Anchor * this->Ahead[vertex];
            const Array4f next =
              this->Bounds.Nearest(vertex, this->Ahead[vertex] - this->Step * gradient);
            const Array4f change = next - this->Now[vertex];
            uphill[chunk] += ((this->Ahead[vertex] - next) * change).sum();
            this->Ahead[vertex] = next + factor * change;
            this->Now[vertex] = next;
          }
        }
      });
    this->Momentum = nextMomentum;
    float sum = 0;
    for (const float part : uphill)
    {
      sum += part;
    }
    if (sum > 0)
    {
      this->Momentum = 1;
    }
    this->Bounds.PlaceMeans(this->Now);
    this->Bounds.PlaceMeans(this->Ahead);
  }

  Displacements& Get() { return this->Now; }

private:
  const WallBounds& Bounds;
  const float Anchor;
  const ParallelFor& For;
  const Graph Neighbors;
  const Graph Users;          // vertices whose neighbor a vertex is
  std::vector<float> Inverse; // of the number of neighbors
  Displacements AtRest;       // residuals without displacements
  Displacements Residuals;
  Displacements Now;
  Displacements Ahead; // by the momentum
  float Step = 0;
  float Momentum = 1;
};

// Moves walls along their normals until labels have their volumes.
class VolumeCorrection
{
public:
  VolumeCorrection(const LabelWalls& walls, const PointList& atRest, const WallBounds& bounds,
    const std::vector<std::size_t>& volumes)
    : Walls(walls)
    , AtRest(atRest)
    , Bounds(bounds)
    , Wanted(volumes)
  {
  }

  void Step(Displacements& displacements)
  {
    std::vector<double> volumes(this->Wanted.size(), 0);
    std::vector<double> areas(this->Wanted.size(), 0);
    this->VisitWalls(displacements,
      [&](const std::array<int, 2>& labels, const Vector3d& normal, double volume, const auto&)
      {
        const double area = normal.norm();
        volumes[labels[0]] += volume;
        volumes[labels[1]] -= volume;
        areas[labels[0]] += area;
        areas[labels[1]] += area;
      });
    std::vector<double> outward(this->Wanted.size(), 0); // background stays
    for (std::size_t label = 1; label < outward.size(); ++label)
    {
      const double missing = static_cast<double>(this->Wanted[label]) - volumes[label];
      const double distance = areas[label] > 0 ? missing / areas[label] : 0;
      outward[label] = std::max(-MaximumShift, std::min(MaximumShift, distance));
    }
    Displacements shifts(displacements.size(), Array4f::Zero());
    std::vector<float> weights(displacements.size(), 0);
    this->VisitWalls(displacements,
      [&](const std::array<int, 2>& labels, const Vector3d& normal, double, const auto& face)
      {
        Array4f shift = Array4f::Zero();
        shift.head<3>() =
          ((outward[labels[0]] - outward[labels[1]]) * normal).template cast<float>().array();
        for (const int vertex : face)
        {
          shifts[vertex] += shift;
          weights[vertex] += static_cast<float>(normal.norm());
        }
      });
    for (int vertex = 0; vertex < this->Bounds.NumberOfFree(); ++vertex)
    {
      if (weights[vertex] > 0)
      {
        displacements[vertex] =
          this->Bounds.Nearest(vertex, displacements[vertex] + shifts[vertex] / weights[vertex]);
      }
    }
    this->Bounds.PlaceMeans(displacements);
  }

private:
  static constexpr double MaximumShift = 0.2; // voxels

  // Calls visit(labels, area vector, part of the volume of the first label, face).
  template <typename Visit>
  void VisitWalls(const Displacements& displacements, const Visit& visit) const
  {
    const auto at = [&](int vertex) -> Vector3d
    {
      return this->AtRest.row(vertex).transpose() +
        displacements[vertex].head<3>().matrix().cast<double>();
    };
    const auto visitAll = [&](const auto& faces, const auto& labels)
    {
      for (std::size_t face = 0; face < faces.size(); ++face)
      {
        const auto& corners = faces[face];
        const Vector3d origin = at(corners[0]);
        Vector3d normal = Vector3d::Zero();
        Vector3d before = at(corners[1]);
        for (std::size_t i = 2; i < corners.size(); ++i)
        {
          const Vector3d now = at(corners[i]);
          normal += (before - origin).cross(now - origin) / 2;
          before = now;
        }
        visit(labels[face], normal, origin.dot(normal) / 3, corners);
      }
    };
    visitAll(this->Walls.Quads, this->Walls.QuadLabels);
    visitAll(this->Walls.Triangles, this->Walls.TriangleLabels);
  }

  const LabelWalls& Walls;
  const PointList& AtRest;
  const WallBounds& Bounds;
  const std::vector<std::size_t>& Wanted;
};

} // namespace

PointList VerticesAtRest(const LabelWalls& walls, const LabelCells& cells)
{
  PointList points(walls.NumberOfVertices(), 3);
  Eigen::Index vertex = 0;
  for (const int cell : walls.Cells)
  {
    points.row(vertex++) = LatticeNode{ cells.Grid.PlaceOf(cell), true }.AtRest();
  }
  for (const auto& edge : walls.Edges)
  {
    points.row(vertex++) = (edge[0].AtRest() + edge[1].AtRest()) / 2;
  }
  for (const LabelWalls::Mean& mean : walls.Means)
  {
    points.row(vertex).setZero();
    for (int i = 0; i < mean.Count; ++i)
    {
      points.row(vertex) += points.row(mean.Of[i]) / mean.Count;
    }
    ++vertex;
  }
  return points;
}

Displacements RelaxWalls(const LabelWalls& walls, const LabelCells& cells,
  const std::vector<std::size_t>& volumes, const RelaxationSettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  const WallBounds bounds(walls, settings.Bound);
  BendingMinimizer minimizer(walls, cells, bounds, settings, parallelFor);
  for (int iteration = 0; iteration < settings.Iterations; ++iteration)
  {
    if (!monitor(static_cast<double>(iteration) / settings.Iterations))
    {
      return {};
    }
    minimizer.Iterate();
  }
  if (settings.Iterations > 0)
  {
    const PointList atRest = VerticesAtRest(walls, cells);
    VolumeCorrection correction(walls, atRest, bounds, volumes);
    for (int iteration = 0; iteration < VolumeIterations; ++iteration)
    {
      correction.Step(minimizer.Get());
    }
  }
  return std::move(minimizer.Get());
}

} // namespace FlipFree
