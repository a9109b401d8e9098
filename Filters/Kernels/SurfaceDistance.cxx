#include "SurfaceDistance.h"

#include "ClosestTriangle.h"
#include "SurfaceTopology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace FlipFree
{
namespace
{

// The monitor is asked between blocks of about this many samples: a few hundredths of a second.
constexpr std::size_t BlockSize = 1 << 14;
constexpr double MaximumNumberOfSamples = 1e8;

struct DirectedDistances
{
  double Area = 0;
  double Sum = 0;
  double SumOfSquares = 0;
  double Percentile95 = 0;
  double Greatest = 0;
};

// A surface cut into patches: each triangle into the n^2 congruent ones that n divisions of its
// sides make, each patch sampled at its centroid.
struct Samples
{
  std::vector<std::size_t> Offsets{ 0 };
  std::vector<int> Divisions;
  std::vector<double> PatchAreas; // per triangle

  Samples(const PointList& points, const TriangleList& triangles, double spacing,
    const std::string& name)
  {
    double total = 0;
    double area = 0;
    for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
    {
      const Eigen::RowVector3d a = points.row(triangles(triangle, 0));
      const Eigen::RowVector3d b = points.row(triangles(triangle, 1));
      const Eigen::RowVector3d c = points.row(triangles(triangle, 2));
      // From the centroid of a patch to its neighbour's it is two thirds of a median.
      const double step =
        std::max({ (b + c - 2 * a).norm(), (c + a - 2 * b).norm(), (a + b - 2 * c).norm() }) / 3;
      const double divisions = std::max(1.0, std::ceil(step / spacing));
      total += divisions * divisions;
      if (!(total <= MaximumNumberOfSamples))
      {
        throw std::invalid_argument(name +
          " would need more than a hundred million samples; "
          "choose a greater sample spacing");
      }
      const double patch = (b - a).cross(c - a).norm() / 2 / (divisions * divisions);
      area += patch * divisions * divisions;
      this->Divisions.push_back(static_cast<int>(divisions));
      this->PatchAreas.push_back(patch);
      this->Offsets.push_back(static_cast<std::size_t>(total));
    }
    if (!(area > 0))
    {
      throw std::invalid_argument(name + " has no area: all its triangles are degenerate");
    }
  }

  // Calls visit(barycentric b, barycentric c) for each sample of a triangle.
  template <typename Visitor>
  void Visit(Eigen::Index triangle, Visitor&& visit) const
  {
    const int n = this->Divisions[triangle];
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; i + j < n; ++j)
      {
        visit((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
        if (i + j + 1 < n)
        {
          visit((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
        }
      }
    }
  }
};

// The least distance up to which lies at least that part of the area. Leaves the list in another
// order.
double WeightedPercentile(std::vector<std::pair<double, double>>& distancesAndAreas,
  double fraction, double total)
{
  // What lies before `first` is nearer, and has the area `before`.
  auto first = distancesAndAreas.begin();
  auto last = distancesAndAreas.end();
  double before = 0;
  while (last - first > 1)
  {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last);
    double area = before;
    for (auto part = first; part != middle; ++part)
    {
      area += part->second;
    }
    if (area >= fraction * total)
    {
      last = middle;
    }
    else
    {
      first = middle;
      before = area;
    }
  }
  return first->first;
}

// Runs body over [0, size) block by block and asks the monitor in between.
bool ForInBlocks(std::size_t size, std::size_t blockSize, const ParallelFor& parallelFor,
  const Monitor& monitor, const RangeBody& body)
{
  for (std::size_t begin = 0; begin < size; begin += blockSize)
  {
    if (!monitor(static_cast<double>(begin) / size))
    {
      return false;
    }
    parallelFor(static_cast<std::ptrdiff_t>(begin),
      static_cast<std::ptrdiff_t>(std::min(size, begin + blockSize)), body);
  }
  return true;
}

// The vertices of a surface that its triangles use.
std::vector<int> UsedVertices(const TriangleList& triangles)
{
  std::vector<int> vertices(triangles.data(), triangles.data() + triangles.size());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

bool MeasureDirected(const PointList& points, const TriangleList& triangles, const Samples& samples,
  const ClosestTriangleFinder& finder, const ParallelFor& parallelFor, const Monitor& monitor,
  DirectedDistances& result)
{
  std::vector<std::pair<double, double>> distancesAndAreas(samples.Offsets.back());
  const auto measureTriangles = [&](std::ptrdiff_t first, std::ptrdiff_t last)
  {
    int likely = -1;
    for (std::ptrdiff_t triangle = first; triangle < last; ++triangle)
    {
      const Eigen::Vector3d a = points.row(triangles(triangle, 0));
      const Eigen::Vector3d ab = points.row(triangles(triangle, 1)).transpose() - a;
      const Eigen::Vector3d ac = points.row(triangles(triangle, 2)).transpose() - a;
      std::size_t sample = samples.Offsets[triangle];
      samples.Visit(triangle,
        [&](double b, double c)
        {
          const ClosestTriangle closest = finder.Find(a + b * ab + c * ac, likely);
          likely = closest.Triangle;
          distancesAndAreas[sample++] = { std::sqrt(closest.SquaredDistance),
            samples.PatchAreas[triangle] };
        });
    }
  };
  // The distance can be greatest at a vertex; being points, vertices have no area.
  const std::vector<int> vertices = UsedVertices(triangles);
  std::vector<double> vertexDistances(vertices.size());
  const auto measureVertices = [&](std::ptrdiff_t first, std::ptrdiff_t last)
  {
    int likely = -1;
    for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
    {
      const ClosestTriangle closest = finder.Find(points.row(vertices[vertex]), likely);
      likely = closest.Triangle;
      vertexDistances[vertex] = std::sqrt(closest.SquaredDistance);
    }
  };
  const std::size_t numberOfTriangles = triangles.rows();
  const std::size_t samplesPerTriangle = samples.Offsets.back() / numberOfTriangles;
  const std::size_t trianglesPerBlock = std::max<std::size_t>(1, BlockSize / samplesPerTriangle);
  if (!ForInBlocks(numberOfTriangles, trianglesPerBlock, parallelFor, PartOf(monitor, 0, 0.8),
        measureTriangles) ||
    !ForInBlocks(vertices.size(), BlockSize, parallelFor, PartOf(monitor, 0.8, 1), measureVertices))
  {
    return false;
  }
  // One thread sums, in a fixed order: the bits do not depend on the number of threads.
  for (const auto& [distance, area] : distancesAndAreas)
  {
    result.Area += area;
    result.Sum += area * distance;
    result.SumOfSquares += area * distance * distance;
    result.Greatest = std::max(result.Greatest, distance);
  }
  result.Percentile95 = WeightedPercentile(distancesAndAreas, 0.95, result.Area);
  result.Greatest =
    std::max(result.Greatest, *std::max_element(vertexDistances.begin(), vertexDistances.end()));
  return true;
}

} // namespace

SurfaceDistance MeasureSurfaceDistance(const PointList& firstPoints,
  const TriangleList& firstTriangles, const PointList& secondPoints,
  const TriangleList& secondTriangles, double sampleSpacing, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  if (!(sampleSpacing > 0))
  {
    throw std::invalid_argument(
      "the sample spacing is " + std::to_string(sampleSpacing) + " mm; it must be positive");
  }
  RequireValidFaces(firstPoints, FacesOf(firstTriangles), "the first surface");
  RequireValidFaces(secondPoints, FacesOf(secondTriangles), "the second surface");
  const Samples firstSamples(firstPoints, firstTriangles, sampleSpacing, "the first surface");
  const Samples secondSamples(secondPoints, secondTriangles, sampleSpacing, "the second surface");
  std::array<std::optional<ClosestTriangleFinder>, 2> finders;
  parallelFor(0, 2,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t surface = begin; surface < end; ++surface)
      {
        finders[surface].emplace(surface == 0 ? firstPoints : secondPoints,
          surface == 0 ? firstTriangles : secondTriangles);
      }
    });

  SurfaceDistance result;
  DirectedDistances there;
  DirectedDistances back;
  result.Complete = MeasureDirected(firstPoints, firstTriangles, firstSamples, *finders[1],
                      parallelFor, PartOf(monitor, 0, 0.5), there) &&
    MeasureDirected(secondPoints, secondTriangles, secondSamples, *finders[0], parallelFor,
      PartOf(monitor, 0.5, 1), back);
  if (result.Complete)
  {
    const double area = there.Area + back.Area;
    result.Average = (there.Sum + back.Sum) / area;
    result.RootMeanSquare = std::sqrt((there.SumOfSquares + back.SumOfSquares) / area);
    result.Hausdorff95 = std::max(there.Percentile95, back.Percentile95);
    result.Hausdorff = std::max(there.Greatest, back.Greatest);
  }
  return result;
}

} // namespace FlipFree
