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
  std::vector<std::size_t> Offsets;
  std::vector<int> Divisions;
  std::vector<double> PatchAreas; // per triangle

  Samples(const PointList& points, const TriangleList& triangles, double spacing,
    const std::string& name, const ParallelFor& parallelFor)
    : Offsets(triangles.rows() + 1, 0)
    , Divisions(triangles.rows())
    , PatchAreas(triangles.rows())
  {
    parallelFor(0, triangles.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t triangle = first; triangle < last; ++triangle)
        {
          const Eigen::RowVector3d a = points.row(triangles(triangle, 0));
          const Eigen::RowVector3d b = points.row(triangles(triangle, 1));
          const Eigen::RowVector3d c = points.row(triangles(triangle, 2));
          // From the centroid of a patch to its neighbour's it is two thirds of a median.
          const double step = std::sqrt(std::max({ (b + c - 2 * a).squaredNorm(),
                                (c + a - 2 * b).squaredNorm(), (a + b - 2 * c).squaredNorm() })) /
            3;
          const double divisions = std::max(1.0, std::ceil(step / spacing));
          this->Divisions[triangle] =
            static_cast<int>(std::min(divisions, std::sqrt(2 * MaximumNumberOfSamples)));
          this->PatchAreas[triangle] = (b - a).cross(c - a).norm() / 2 / (divisions * divisions);
        }
      });
    double area = 0;
    for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
    {
      const std::size_t divisions = this->Divisions[triangle];
      const std::size_t patches = divisions * divisions;
      this->Offsets[triangle + 1] = this->Offsets[triangle] + patches;
      area += this->PatchAreas[triangle] * static_cast<double>(patches);
      if (this->Offsets[triangle + 1] > MaximumNumberOfSamples)
      {
        throw std::invalid_argument(name +
          " would need more than a hundred million samples; "
          "choose a greater sample spacing");
      }
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

  // The sample of the patch in a corner of a triangle, which Visit visits first, last, or as the
  // last one of the first row.
  std::size_t AtCorner(Eigen::Index triangle, int corner) const
  {
    const std::size_t n = this->Divisions[triangle];
    return this->Offsets[triangle] + (corner == 0 ? 0 : corner == 1 ? n * n - 1 : 2 * (n - 1));
  }
};

// Collects points, each with the place for its distance, and measures them a packet at a time.
class PacketOfSamples
{
public:
  explicit PacketOfSamples(const ClosestTriangleFinder& finder)
    : Finder(finder)
  {
  }
  void Add(const Eigen::Vector3d& point, double& distance)
  {
    this->Points.Set(this->Size, point);
    this->Distances[this->Size] = &distance;
    if (++this->Size == PointPacket::Size)
    {
      this->Measure();
    }
  }
  void Measure()
  {
    if (this->Size == 0)
    {
      return;
    }
    for (int lane = this->Size; lane < PointPacket::Size; ++lane)
    {
      this->Points.Copy(0, lane);
    }
    PointPacket::Values squaredDistances;
    this->Finder.FindSquaredDistances(this->Points, this->Hint, squaredDistances);
    for (int lane = 0; lane < this->Size; ++lane)
    {
      *this->Distances[lane] = std::sqrt(squaredDistances[lane]);
    }
    this->Size = 0;
  }

private:
  const ClosestTriangleFinder& Finder;
  PointPacket Points;
  std::array<double*, PointPacket::Size> Distances;
  int Size = 0;
  int Hint = 0;
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

struct Surface
{
  const PointList& Points;
  const TriangleList& Triangles;
  Samples Patches;
  std::vector<double> Distances; // of the samples to the other surface
};

// False when stopped. In the finder's order, those that make a packet lie close together.
bool MeasureSamples(Surface& surface, const std::vector<int>& order,
  const ClosestTriangleFinder& other, const ParallelFor& parallelFor, const Monitor& monitor)
{
  surface.Distances.resize(surface.Patches.Offsets.back());
  const auto measureTriangles = [&](std::ptrdiff_t first, std::ptrdiff_t last)
  {
    PacketOfSamples packet(other);
    for (std::ptrdiff_t place = first; place < last; ++place)
    {
      const int triangle = order[place];
      const int* const corners = surface.Triangles.row(triangle).data();
      const Eigen::Vector3d a = surface.Points.row(corners[0]);
      const Eigen::Vector3d ab = surface.Points.row(corners[1]).transpose() - a;
      const Eigen::Vector3d ac = surface.Points.row(corners[2]).transpose() - a;
      double* distance = surface.Distances.data() + surface.Patches.Offsets[triangle];
      surface.Patches.Visit(triangle,
        [&](double b, double c) { packet.Add(a + b * ab + c * ac, *distance++); });
    }
    packet.Measure();
  };
  const std::size_t samplesPerTriangle = surface.Distances.size() / order.size();
  const std::size_t trianglesPerBlock = std::max<std::size_t>(1, BlockSize / samplesPerTriangle);
  return ForInBlocks(order.size(), trianglesPerBlock, parallelFor, monitor, measureTriangles);
}

// The greatest distance of a vertex, if it is greater than `greatest`, that of the samples. A
// vertex cannot be farther than a sample by more than it lies from that sample, which leaves few to
// measure.
double GreatestWithVertices(const Surface& surface, const ClosestTriangleFinder& other,
  double greatest)
{
  enum : char
  {
    Unused,
    Candidate,
    TooNear
  };
  const TriangleList& triangles = surface.Triangles;
  std::vector<char> states(surface.Points.rows(), Unused);
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto point = [&](int which)
      { return surface.Points.row(triangles(triangle, (corner + which) % 3)); };
      const double toSample = ((point(1) - point(0)) + (point(2) - point(0))).squaredNorm() /
        (9.0 * surface.Patches.Divisions[triangle] * surface.Patches.Divisions[triangle]);
      const double lacking =
        (1 - 1e-9) * greatest - surface.Distances[surface.Patches.AtCorner(triangle, corner)];
      char& state = states[triangles(triangle, corner)];
      state =
        state == TooNear || (lacking > 0 && lacking * lacking > toSample) ? TooNear : Candidate;
    }
  }
  std::vector<double> distances;
  distances.reserve(states.size()); // the packet refers to them
  PacketOfSamples packet(other);
  for (std::size_t vertex = 0; vertex < states.size(); ++vertex)
  {
    if (states[vertex] == Candidate)
    {
      packet.Add(surface.Points.row(static_cast<Eigen::Index>(vertex)), distances.emplace_back(0));
    }
  }
  packet.Measure();
  for (const double distance : distances)
  {
    greatest = std::max(greatest, distance);
  }
  return greatest;
}

// One thread sums, in a fixed order: the bits do not depend on the number of threads.
DirectedDistances Summarise(const Surface& surface, const ClosestTriangleFinder& other)
{
  DirectedDistances result;
  std::vector<std::pair<double, double>> distancesAndAreas;
  distancesAndAreas.reserve(surface.Distances.size());
  for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
  {
    const double area = surface.Patches.PatchAreas[triangle];
    for (std::size_t sample = surface.Patches.Offsets[triangle];
         sample < surface.Patches.Offsets[triangle + 1]; ++sample)
    {
      const double distance = surface.Distances[sample];
      distancesAndAreas.emplace_back(distance, area);
      result.Area += area;
      result.Sum += area * distance;
      result.SumOfSquares += area * distance * distance;
      result.Greatest = std::max(result.Greatest, distance);
    }
  }
  result.Percentile95 = WeightedPercentile(distancesAndAreas, 0.95, result.Area);
  result.Greatest = GreatestWithVertices(surface, other, result.Greatest);
  return result;
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
  std::array<Surface, 2> surfaces{ {
    { firstPoints, firstTriangles,
      Samples(firstPoints, firstTriangles, sampleSpacing, "the first surface", parallelFor), {} },
    { secondPoints, secondTriangles,
      Samples(secondPoints, secondTriangles, sampleSpacing, "the second surface", parallelFor),
      {} },
  } };
  const auto forBoth = [&parallelFor](const std::function<void(std::ptrdiff_t)>& body)
  {
    parallelFor(0, 2,
      [&body](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t surface = begin; surface < end; ++surface)
        {
          body(surface);
        }
      });
  };
  std::array<std::optional<ClosestTriangleFinder>, 2> finders;
  forBoth([&](std::ptrdiff_t surface)
    { finders[surface].emplace(surfaces[surface].Points, surfaces[surface].Triangles); });

  SurfaceDistance result;
  result.Complete = MeasureSamples(surfaces[0], finders[0]->GetOrder(), *finders[1], parallelFor,
                      PartOf(monitor, 0, 0.5)) &&
    MeasureSamples(surfaces[1], finders[1]->GetOrder(), *finders[0], parallelFor,
      PartOf(monitor, 0.5, 1));
  if (result.Complete)
  {
    std::array<DirectedDistances, 2> directed;
    forBoth([&](std::ptrdiff_t surface)
      { directed[surface] = Summarise(surfaces[surface], *finders[1 - surface]); });
    const auto& [there, back] = directed;
    const double area = there.Area + back.Area;
    result.Average = (there.Sum + back.Sum) / area;
    result.RootMeanSquare = std::sqrt((there.SumOfSquares + back.SumOfSquares) / area);
    result.Hausdorff95 = std::max(there.Percentile95, back.Percentile95);
    result.Hausdorff = std::max(there.Greatest, back.Greatest);
  }
  return result;
}

} // namespace FlipFree
