#include "Measures/SurfaceDistance.h"

#include "Error.h"
#include "Geometry/DistanceQuery.h"
#include "Measures/SurfaceSamples.h"
#include "Mesh/SurfaceTopology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{
namespace
{

// Between blocks of this many samples, a few hundredths of a second, the monitor is called.
constexpr std::size_t BlockSize = 1 << 14;

// The distances from one surface to the other.
struct DirectedDistances
{
  double Area = 0;
  double Sum = 0;
  double SumOfSquares = 0;
  double Percentile95 = 0;
  double Maximum = 0;
};

struct SampledDistance
{
  double Distance;
  double Area;

  bool operator<(const SampledDistance& other) const
  {
    return this->Distance != other.Distance ? this->Distance < other.Distance
                                            : this->Area < other.Area;
  }
};

// Runs body over [0, size) block by block and calls the monitor in between; false when stopped.
bool ForInBlocks(std::size_t size, const ParallelFor& parallelFor, const Monitor& monitor,
  const RangeBody& body)
{
  for (std::size_t begin = 0; begin < size; begin += BlockSize)
  {
    if (!monitor(static_cast<double>(begin) / static_cast<double>(size)))
    {
      return false;
    }
    parallelFor(static_cast<std::ptrdiff_t>(begin),
      static_cast<std::ptrdiff_t>(std::min(size, begin + BlockSize)), body);
  }
  return true;
}

// The distance of each sample; false when stopped.
bool MeasureSamples(const SurfaceSamples& samples, const DistanceQuery& other,
  const ParallelFor& parallelFor, const Monitor& monitor, std::vector<SampledDistance>& result)
{
  result.resize(samples.Size());
  return ForInBlocks(samples.Size(), parallelFor, monitor,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      PointList positions(last - first, 3);
      samples.ForEach(first, last,
        [&](std::size_t sample, Eigen::Index triangle)
        {
          positions.row(static_cast<std::ptrdiff_t>(sample) - first) =
            samples.PositionOf(sample, triangle);
          result[sample].Area = samples.PatchAreaOf(triangle);
        });
      const Eigen::VectorXd distances = other.DistancesOf(positions);
      for (std::ptrdiff_t sample = first; sample < last; ++sample)
      {
        result[sample].Distance = distances[sample - first];
      }
    });
}

// In one thread and a fixed order, so that the bits do not depend on the number of threads. False
// when stopped.
bool SumUp(const std::vector<SampledDistance>& samples, const Monitor& monitor,
  DirectedDistances& result)
{
  return ForInBlocks(samples.size(), SerialFor, monitor,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const auto& [distance, area] = samples[index];
        result.Area += area;
        result.Sum += area * distance;
        result.SumOfSquares += area * distance * distance;
        result.Maximum = std::max(result.Maximum, distance);
      }
    });
}

// The least distance that at least `fraction` of the total area does not exceed, by quickselect;
// false when stopped. Reorders the samples.
bool FindPercentile(std::vector<SampledDistance>& samples, double fraction, double total,
  const Monitor& monitor, double& percentile)
{
  // The samples before `first` are no farther, and have the area `before`.
  auto first = samples.begin();
  auto last = samples.end();
  double before = 0;
  while (last - first > 1)
  {
    // Each pass halves what is left.
    if (!monitor(1 - static_cast<double>(last - first) / static_cast<double>(samples.size())))
    {
      return false;
    }
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last);
    double area = before;
    for (auto sample = first; sample != middle; ++sample)
    {
      area += sample->Area;
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
  percentile = first->Distance;
  return true;
}

// The vertices that may be farther than all samples: a vertex is at most as far as a sample plus
// its distance to this sample. There are few, unless the surfaces coincide.
PointList CandidateVertices(const SurfaceSamples& samples,
  const std::vector<SampledDistance>& distances, double maximum)
{
  const PointList& points = samples.GetPoints();
  const TriangleList& triangles = samples.GetTriangles();
  constexpr double unused = std::numeric_limits<double>::infinity();
  std::vector<double> bounds(points.rows(), unused);
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      double& bound = bounds[triangles(triangle, corner)];
      bound = std::min(bound,
        distances[samples.SampleAt(triangle, corner)].Distance +
          samples.DistanceToSampleAt(triangle, corner));
    }
  }
  PointList candidates(points.rows(), 3);
  Eigen::Index size = 0;
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    // Distances are rounded: vertices that come close are measured.
    if (bounds[vertex] != unused && bounds[vertex] >= (1 - 1e-9) * maximum)
    {
      candidates.row(size++) = points.row(vertex);
    }
  }
  candidates.conservativeResize(size, 3);
  return candidates;
}

// Raises the maximum to the distance of the farthest vertex; false when stopped.
bool IncludeVertices(const PointList& vertices, const DistanceQuery& other,
  const ParallelFor& parallelFor, const Monitor& monitor, double& maximum)
{
  Eigen::VectorXd distances = Eigen::VectorXd::Zero(vertices.rows() + 1);
  const bool complete = ForInBlocks(static_cast<std::size_t>(vertices.rows()), parallelFor, monitor,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      distances.segment(first, last - first) =
        other.DistancesOf(vertices.middleRows(first, last - first));
    });
  maximum = std::max(maximum, distances.maxCoeff());
  return complete;
}

// False when stopped.
bool MeasureDirected(const SurfaceSamples& samples, const DistanceQuery& other,
  const ParallelFor& parallelFor, const Monitor& monitor, DirectedDistances& result)
{
  std::vector<SampledDistance> distances;
  if (!MeasureSamples(samples, other, parallelFor, PartOf(monitor, 0, 0.9), distances) ||
    !SumUp(distances, PartOf(monitor, 0.9, 0.92), result))
  {
    return false;
  }
  const PointList vertices = CandidateVertices(samples, distances, result.Maximum);
  return FindPercentile(distances, 0.95, result.Area, PartOf(monitor, 0.92, 0.95),
           result.Percentile95) &&
    IncludeVertices(vertices, other, parallelFor, PartOf(monitor, 0.95, 1), result.Maximum);
}

} // namespace

SurfaceDistance MeasureSurfaceDistance(const PointList& firstPoints,
  const TriangleList& firstTriangles, const PointList& secondPoints,
  const TriangleList& secondTriangles, double sampleSpacing, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  if (!(sampleSpacing > 0))
  {
    throw Error(ErrorCode::OutOfRange,
      "the sample spacing is " + std::to_string(sampleSpacing) + " mm; it must be positive");
  }
  RequireValidFaces(firstPoints, FacesOf(firstTriangles), "the first surface");
  RequireValidFaces(secondPoints, FacesOf(secondTriangles), "the second surface");
  std::array<std::optional<DistanceQuery>, 2> queries;
  parallelFor(0, 2,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t surface = begin; surface < end; ++surface)
      {
        queries[surface].emplace(surface == 0 ? firstPoints : secondPoints,
          surface == 0 ? firstTriangles : secondTriangles);
      }
    });
  const auto& [toFirst, toSecond] = queries;
  const SurfaceSamples first(firstPoints, toFirst->GetSortedTriangles(), sampleSpacing,
    "the first surface");
  const SurfaceSamples second(secondPoints, toSecond->GetSortedTriangles(), sampleSpacing,
    "the second surface");

  SurfaceDistance result;
  DirectedDistances there;
  DirectedDistances back;
  result.Complete =
    MeasureDirected(first, *toSecond, parallelFor, PartOf(monitor, 0, 0.5), there) &&
    MeasureDirected(second, *toFirst, parallelFor, PartOf(monitor, 0.5, 1), back);
  if (result.Complete)
  {
    const double area = there.Area + back.Area;
    result.Average = (there.Sum + back.Sum) / area;
    result.RootMeanSquare = std::sqrt((there.SumOfSquares + back.SumOfSquares) / area);
    result.Hausdorff95 = std::max(there.Percentile95, back.Percentile95);
    result.Hausdorff = std::max(there.Maximum, back.Maximum);
  }
  return result;
}

} // namespace FlipFree
