#include "Measures/SurfaceDistance.h"

#include "Geometry/ClosestTriangle.h"
#include "Mesh/SurfaceTopology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace FlipFree
{
namespace
{

// The monitor is asked between blocks of this many samples: a few hundredths of a second.
constexpr std::size_t BlockSize = 1 << 14;
constexpr double MaximumNumberOfSamples = 1e8;
// Of the progress of one surface; the rest is for what sums up.
constexpr double ShareOfSamples = 0.9;

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
          // From the centroid of a patch to its neighbor's it is two thirds of a median.
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

  std::size_t Size() const { return this->Offsets.back(); }
  std::size_t SizeOf(Eigen::Index triangle) const
  {
    return this->Offsets[triangle + 1] - this->Offsets[triangle];
  }

  // Calls visit(barycentric b, barycentric c) for the samples first to last - 1 of a triangle.
  template <typename Visitor>
  void Visit(Eigen::Index triangle, std::size_t first, std::size_t last, Visitor&& visit) const
  {
    const int n = this->Divisions[triangle];
    // Row i has 2 (n - i) - 1 samples, which leaves the square of n - i for it and those behind.
    const auto squared = static_cast<double>(this->SizeOf(triangle) - first);
    int i = n - static_cast<int>(std::ceil(std::sqrt(squared)));
    int inRow = static_cast<int>(first) - i * (2 * n - i);
    for (std::size_t sample = first; sample < last; ++sample)
    {
      const int j = inRow / 2;
      const double inPatch = inRow % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      visit((i + inPatch) / n, (j + inPatch) / n);
      if (++inRow == 2 * (n - i) - 1)
      {
        inRow = 0;
        ++i;
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

// Runs body over [0, size) block by block and asks the monitor in between; false when stopped.
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
  const Samples& patches = surface.Patches;
  surface.Distances.resize(patches.Size());
  // How many samples lie before each triangle, in this order.
  std::vector<std::size_t> before(order.size() + 1, 0);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    before[place + 1] = before[place] + patches.SizeOf(order[place]);
  }
  // Cut by samples: a single triangle may have millions.
  const auto measure = [&](std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    PacketOfSamples packet(other);
    auto first = static_cast<std::size_t>(begin);
    const auto last = static_cast<std::size_t>(end);
    std::size_t place = std::upper_bound(before.begin(), before.end(), first) - before.begin() - 1;
    for (; first < last; ++place)
    {
      const int triangle = order[place];
      const int* const corners = surface.Triangles.row(triangle).data();
      const Eigen::Vector3d a = surface.Points.row(corners[0]);
      const Eigen::Vector3d ab = surface.Points.row(corners[1]).transpose() - a;
      const Eigen::Vector3d ac = surface.Points.row(corners[2]).transpose() - a;
      const std::size_t next = std::min(last, before[place + 1]);
      double* distance =
        surface.Distances.data() + patches.Offsets[triangle] + (first - before[place]);
      patches.Visit(triangle, first - before[place], next - before[place],
        [&](double b, double c) { packet.Add(a + b * ab + c * ac, *distance++); });
      first = next;
    }
    packet.Measure();
  };
  return ForInBlocks(patches.Size(), parallelFor, monitor, measure);
}

struct Part
{
  double Distance;
  double Area;

  bool operator<(const Part& other) const
  {
    return this->Distance != other.Distance ? this->Distance < other.Distance
                                            : this->Area < other.Area;
  }
};

// Sums over the samples, and lists them; false when stopped. One thread sums, in a fixed order: the
// bits do not depend on the number of threads.
bool SumUp(const Surface& surface, const Monitor& monitor, DirectedDistances& result,
  std::vector<Part>& parts)
{
  parts.reserve(surface.Distances.size());
  Eigen::Index triangle = 0;
  return ForInBlocks(surface.Distances.size(), SerialFor, monitor,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (auto sample = static_cast<std::size_t>(first); sample < static_cast<std::size_t>(last);
           ++sample)
      {
        while (sample >= surface.Patches.Offsets[triangle + 1])
        {
          ++triangle;
        }
        const double area = surface.Patches.PatchAreas[triangle];
        const double distance = surface.Distances[sample];
        parts.push_back({ distance, area });
        result.Area += area;
        result.Sum += area * distance;
        result.SumOfSquares += area * distance * distance;
        result.Greatest = std::max(result.Greatest, distance);
      }
    });
}

// Finds the least distance up to which lies at least that fraction of the area; false when stopped.
// Leaves the list in another order.
bool FindPercentile(std::vector<Part>& parts, double fraction, double total, const Monitor& monitor,
  double& percentile)
{
  // What lies before `first` is nearer, and has the area `before`.
  auto first = parts.begin();
  auto last = parts.end();
  double before = 0;
  while (last - first > 1)
  {
    // Each pass halves what is left.
    if (!monitor(1 - static_cast<double>(last - first) / static_cast<double>(parts.size())))
    {
      return false;
    }
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last);
    double area = before;
    for (auto part = first; part != middle; ++part)
    {
      area += part->Area;
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

// The vertices that may be farther than `greatest`, the greatest distance of a sample. None can be
// farther than a sample by more than it lies from that sample, which leaves few, unless the
// surfaces coincide.
std::vector<int> CandidateVertices(const Surface& surface, double greatest)
{
  enum : char
  {
    Unused,
    Candidate,
    TooNear
  };
  // A little less, since distances are rounded: what comes close is measured.
  const double within = (1 - 1e-9) * greatest;
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
      const double lacking = within - surface.Distances[surface.Patches.AtCorner(triangle, corner)];
      char& state = states[triangles(triangle, corner)];
      state =
        state == TooNear || (lacking > 0 && lacking * lacking > toSample) ? TooNear : Candidate;
    }
  }
  std::vector<int> candidates;
  for (std::size_t vertex = 0; vertex < states.size(); ++vertex)
  {
    if (states[vertex] == Candidate)
    {
      candidates.push_back(static_cast<int>(vertex));
    }
  }
  return candidates;
}

// Raises the greatest distance to that of a vertex, if there is a greater one; false when stopped.
bool RaiseToVertices(const Surface& surface, const ClosestTriangleFinder& other,
  const ParallelFor& parallelFor, const Monitor& monitor, double& greatest)
{
  const std::vector<int> candidates = CandidateVertices(surface, greatest);
  std::vector<double> distances(candidates.size());
  const bool complete = ForInBlocks(candidates.size(), parallelFor, monitor,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      PacketOfSamples packet(other);
      for (std::ptrdiff_t candidate = first; candidate < last; ++candidate)
      {
        packet.Add(surface.Points.row(candidates[candidate]), distances[candidate]);
      }
      packet.Measure();
    });
  for (const double distance : distances)
  {
    greatest = std::max(greatest, distance);
  }
  return complete;
}

// One surface after the other, each with its lists, which would need much memory at once. False
// when stopped.
bool MeasureDirected(Surface surface, const std::vector<int>& order,
  const ClosestTriangleFinder& other, const ParallelFor& parallelFor, const Monitor& monitor,
  DirectedDistances& result)
{
  const auto share = [&monitor](double first, double last)
  {
    return PartOf(monitor, ShareOfSamples + (1 - ShareOfSamples) * first,
      ShareOfSamples + (1 - ShareOfSamples) * last);
  };
  if (!MeasureSamples(surface, order, other, parallelFor, PartOf(monitor, 0, ShareOfSamples)))
  {
    return false;
  }
  {
    std::vector<Part> parts;
    if (!SumUp(surface, share(0, 0.2), result, parts) ||
      !FindPercentile(parts, 0.95, result.Area, share(0.2, 0.5), result.Percentile95))
    {
      return false;
    }
  }
  return RaiseToVertices(surface, other, parallelFor, share(0.5, 1), result.Greatest);
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
  std::array<DirectedDistances, 2> directed;
  result.Complete = MeasureDirected(std::move(surfaces[0]), finders[0]->GetOrder(), *finders[1],
                      parallelFor, PartOf(monitor, 0, 0.5), directed[0]) &&
    MeasureDirected(std::move(surfaces[1]), finders[1]->GetOrder(), *finders[0], parallelFor,
      PartOf(monitor, 0.5, 1), directed[1]);
  if (result.Complete)
  {
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
