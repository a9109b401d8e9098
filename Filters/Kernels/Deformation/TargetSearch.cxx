#include "Deformation/TargetSearch.h"

#include "Mesh/SurfaceNormals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace FlipFree
{
namespace
{

// With fewer matched neighbors, nothing is rejected.
constexpr int MinimumRing = 4;

// What a two-ring of distinct vertices holds.
constexpr int UsualRing = 16;

struct Exchange
{
  std::uint8_t Low = 0;
  std::uint8_t High = 0;
};

// Batcher's odd-even merge sort: no branches, which no processor could predict here.
constexpr std::array<Exchange, 63> MakeSortingNetwork()
{
  std::array<Exchange, 63> network{};
  int count = 0;
  for (int p = 1; p < UsualRing; p *= 2)
  {
    for (int k = p; k >= 1; k /= 2)
    {
      for (int j = k % p; j + k < UsualRing; j += 2 * k)
      {
        for (int low = j; low < j + k && low + k < UsualRing; ++low)
        {
          if (low / (2 * p) == (low + k) / (2 * p))
          {
            network[count].Low = static_cast<std::uint8_t>(low);
            network[count].High = static_cast<std::uint8_t>(low + k);
            ++count;
          }
        }
      }
    }
  }
  return network;
}

// The distances of the matched vertices in the two-ring of a vertex. A vertex that several paths
// reach counts several times.
class Ring
{
public:
  void Clear() { this->Size = 0; }
  void Add(double distance) { this->Distances[this->Size++] = distance; }
  int GetSize() const { return this->Size; }

  void Sort()
  {
    if (this->Size > UsualRing)
    {
      std::sort(this->Distances.data(), this->Distances.data() + this->Size);
      return;
    }
    std::fill(this->Distances.data() + this->Size, this->Distances.data() + UsualRing, Beyond);
    for (const Exchange& exchange : SortingNetwork)
    {
      const double a = this->Distances[exchange.Low];
      const double b = this->Distances[exchange.High];
      this->Distances[exchange.Low] = std::min(a, b);
      this->Distances[exchange.High] = std::max(a, b);
    }
  }

  // Both of sorted distances; of an even number the upper one.
  double Median() const { return this->Distances[this->Size / 2]; }
  double MedianAbsoluteDeviation() const
  {
    const double median = this->Median();
    int below = this->Size / 2;
    int above = below + 1;
    double deviation = 0;
    for (int rank = 0; rank <= this->Size / 2; ++rank)
    {
      const double down = below >= 0 ? median - this->Distances[below] : Beyond;
      const double up = above < this->Size ? this->Distances[above] - median : Beyond;
      deviation = std::min(down, up);
      below -= down <= up ? 1 : 0;
      above += down <= up ? 0 : 1;
    }
    return deviation;
  }

private:
  static constexpr std::array<Exchange, 63> SortingNetwork = MakeSortingNetwork();
  static constexpr double Beyond = std::numeric_limits<double>::infinity();

  std::array<double, 20> Distances{}; // four neighbors, and at most four of each
  int Size = 0;
};

TargetReport Describe(const CorrespondenceField& field)
{
  TargetReport report;
  for (std::size_t vertex = 0; vertex < field.States.size(); ++vertex)
  {
    if (field.States[vertex] == VertexState::Solitary)
    {
      ++report.Solitary;
    }
    else
    {
      ++report.Matched;
      report.MeanDistance += field.Displacements.row(static_cast<Eigen::Index>(vertex)).norm();
    }
  }
  report.MeanDistance /= std::max(1, report.Matched);
  return report;
}

} // namespace

void RejectOutliers(const ContourMesh& mesh, const PointList& normals, double deviations,
  double allowance, const ParallelFor& parallelFor, CorrespondenceField& field)
{
  const Eigen::VectorXd distances = field.Displacements.cwiseProduct(normals).rowwise().sum();
  const std::vector<VertexState> states = field.States;
  const auto isOutlier = [&](int vertex, Ring& ring)
  {
    const auto add = [&](int member)
    {
      if (states[member] != VertexState::Solitary)
      {
        ring.Add(distances[member]);
      }
    };
    ring.Clear();
    for (int neighbor : mesh.Neighbors[vertex])
    {
      add(neighbor);
      for (int next : mesh.Neighbors[neighbor])
      {
        if (next != vertex)
        {
          add(next);
        }
      }
    }
    if (ring.GetSize() < MinimumRing)
    {
      return false;
    }
    ring.Sort();
    const double spread = 1.4826 * ring.MedianAbsoluteDeviation();
    return std::abs(distances[vertex] - ring.Median()) > deviations * spread + allowance;
  };
  parallelFor(0, mesh.NumberOfPoints(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      Ring ring;
      for (int vertex = static_cast<int>(first); vertex < last; ++vertex)
      {
        if (states[vertex] != VertexState::Solitary && isOutlier(vertex, ring))
        {
          field.States[vertex] = VertexState::Solitary;
          field.Displacements.row(vertex).setZero();
        }
      }
    });
}

void LimitDisplacements(double limit, CorrespondenceField& field)
{
  for (Eigen::Index vertex = 0; vertex < field.Displacements.rows(); ++vertex)
  {
    const double length = field.Displacements.row(vertex).norm();
    if (length > limit)
    {
      field.Displacements.row(vertex) *= limit / length;
    }
  }
}

double SearchDistanceOf(const TargetSettings& settings, double organRadius)
{
  constexpr double minimum = 15;
  constexpr double maximum = 60;
  const double given = settings.Correspondence.SearchDistance;
  return given > 0 ? given
                   : std::max(minimum, std::min(maximum, settings.SearchScale * organRadius));
}

double EdgeWindowOf(const TargetSettings& settings, const ImageGeometry& geometry)
{
  constexpr double maximumInVoxels = 1.5;
  return std::min(settings.Correspondence.EdgeWindow,
    maximumInVoxels * geometry.Spacing.maxCoeff());
}

CorrespondenceField FindTargets(const ContourMesh& mesh, const Eigen::Ref<const PointList>& points,
  const BitMask& foreground, const BitMask& noData, const ImageView<float>& edges,
  double organRadius, const TargetSettings& settings, const ParallelFor& parallelFor,
  TargetReport& report)
{
  const ImageGeometry& geometry = foreground.GetGeometry();
  const double voxel = geometry.Spacing.maxCoeff();
  CorrespondenceSettings search = settings.Correspondence;
  search.SearchDistance = SearchDistanceOf(settings, organRadius);
  search.EdgeWindow = edges.Data ? EdgeWindowOf(settings, geometry) : 0;
  const PointList normals = VertexNormals(mesh, points, settings.NormalSmoothingIterations);
  CorrespondenceField field =
    FindCorrespondences(points, normals, foreground, noData, edges, search, parallelFor);
  const auto withoutBoundary =
    std::count(field.States.begin(), field.States.end(), VertexState::Solitary);
  if (settings.OutlierStandardDeviations > 0)
  {
    RejectOutliers(mesh, normals, settings.OutlierStandardDeviations, voxel, parallelFor, field);
  }
  report = Describe(field);
  report.WithoutBoundary = static_cast<int>(withoutBoundary);
  if (settings.MaximumDisplacement > 0)
  {
    LimitDisplacements(voxel * settings.MaximumDisplacement, field);
  }
  return field;
}

} // namespace FlipFree
