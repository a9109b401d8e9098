#include "Evidence/SurfaceConfidence.h"

#include "Evidence/SurfaceDepth.h"
#include "Image/BoxReading.h"
#include "Image/ImageInterpolation.h"
#include "Intensity/RobustStatistics.h"
#include "Mesh/SurfaceNormals.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Where gray values are taken on either side, in millimeters.
constexpr int FirstStep = 2;
constexpr int LastStep = 6;

constexpr int NormalSmoothing = 2;
constexpr int Pooling = 2; // rings of neighbors

// Of a vertex, half the confidence is left at this pooled contrast, in spreads, and at this shift,
// in radii of a ball of the organ's volume.
constexpr double HalfContrast = 2;
constexpr double HalfShiftOfVertex = 0.1;

// Of the surface: the weights of the four evidences in a logistic function, those of depth and seed
// for the logarithms of the ratio and of the radius in millimeters.
constexpr double Bias = -2.9;
constexpr double WeightOfSupport = 3;
constexpr double WeightOfDepth = -1.4;
constexpr double WeightOfSeed = 0.7;
constexpr double WeightOfUnanimity = 1;

// The edge of the cubes by which depths are measured, in radii of a ball of the organ's volume.
constexpr double DepthStep = 1.0 / 12;

// The mean over a vertex and its four neighbors, again and again.
void Pool(const ContourMesh& mesh, Eigen::VectorXd& values)
{
  for (int ring = 0; ring < Pooling; ++ring)
  {
    Eigen::VectorXd sums = values;
    for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
    {
      for (const int neighbor : mesh.Neighbors[vertex])
      {
        sums[vertex] += values[neighbor];
      }
    }
    values = sums / 5;
  }
}

// 1 at zero, 1/2 at `half`.
double FallOff(double value, double half)
{
  return 1 / (1 + value * value / (half * half));
}

class Judgment
{
public:
  Judgment(const ContourMesh& mesh, const PointList& points)
    : Mesh(mesh)
    , Points(points)
    , Contrast(Eigen::VectorXd::Zero(points.rows()))
    , Areas(Eigen::VectorXd::Zero(points.rows()))
  {
  }

  void MeasureContrast(const ImageView<float>& image, const ParallelFor& parallelFor)
  {
    constexpr int steps = LastStep - FirstStep + 1;
    const PointList normals = VertexNormals(this->Mesh, this->Points, NormalSmoothing);
    std::vector<float> inside(steps * this->Points.rows());
    parallelFor(0, this->Points.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
        {
          const auto sample = [&](double millimeters)
          {
            const Eigen::Vector3d point =
              this->Points.row(vertex) + millimeters * normals.row(vertex);
            return InterpolateClamped(image, image.Geometry.ToIndex(point));
          };
          for (int step = 0; step < steps; ++step)
          {
            const double own = sample(-FirstStep - step);
            inside[steps * vertex + step] = static_cast<float>(own);
            const double contrast = sample(FirstStep + step) - own;
            // Where there is no data, there is no contrast, as at the image's end.
            this->Contrast[vertex] += std::isfinite(contrast) ? contrast / steps : 0;
          }
        }
      });
    this->Spread = RobustStatisticsOf(inside).StandardDeviation;
    Pool(this->Mesh, this->Contrast);
  }

  void MeasureSize()
  {
    double sixVolumes = 0;
    const Eigen::RowVector3d origin = this->Points.row(0);
    for (Eigen::Index triangle = 0; triangle < this->Mesh.Triangles.rows(); ++triangle)
    {
      const auto corners = this->Mesh.Triangles.row(triangle);
      const Eigen::RowVector3d a = this->Points.row(corners[0]) - origin;
      const Eigen::RowVector3d b = this->Points.row(corners[1]) - origin;
      const Eigen::RowVector3d c = this->Points.row(corners[2]) - origin;
      sixVolumes += a.dot(b.cross(c));
      for (const int corner : corners)
      {
        this->Areas[corner] += (b - a).cross(c - a).norm();
      }
    }
    this->Radius = std::cbrt(std::abs(sixVolumes) / (8 * EIGEN_PI));
  }

  // Of a vertex: how far its neighborhood stands out.
  double SupportOf(Eigen::Index vertex) const
  {
    const double contrast = std::abs(this->Contrast[vertex]);
    return contrast > 0 ? FallOff(HalfContrast * this->Spread, contrast) : 0;
  }

  // Of a vertex: 1 where both runs have found it at the same place.
  double AgreementOf(Eigen::Index vertex, const Eigen::VectorXd& shifts) const
  {
    return shifts.size() == 0 || shifts[vertex] == 0
      ? 1
      : FallOff(shifts[vertex], HalfShiftOfVertex * this->Radius);
  }

  double OfSurface(const SeedSphere& seed, double unanimity, const ParallelFor& parallelFor) const
  {
    const double area = this->Areas.sum();
    if (!(area > 0 && this->Radius > 0))
    {
      return 0;
    }
    const double sum = Bias + WeightOfSupport * this->WholeSupport() / area +
      WeightOfDepth * std::log(this->DepthRatio(seed, parallelFor)) +
      WeightOfSeed * std::log(seed.Radius) + WeightOfUnanimity * unanimity;
    return 1 / (1 + std::exp(-sum));
  }

private:
  // Of the parts that are all brighter, or all darker, than their surroundings, whichever are
  // supported better; times their areas.
  double WholeSupport() const
  {
    double darker = 0;
    double brighter = 0;
    for (Eigen::Index vertex = 0; vertex < this->Points.rows(); ++vertex)
    {
      (this->Contrast[vertex] > 0 ? darker : brighter) +=
        this->Areas[vertex] * this->SupportOf(vertex);
    }
    return std::max(darker, brighter);
  }

  // The greatest depth in comparison with that of the seed's center.
  double DepthRatio(const SeedSphere& seed, const ParallelFor& parallelFor) const
  {
    const SurfaceDepths depths = FindDepths(this->Points, this->Mesh.Triangles, seed.Center,
      DepthStep * this->Radius, parallelFor);
    const double ofSeed = std::max(depths.OfPoint, seed.Radius);
    return std::max(depths.Greatest, ofSeed) / ofSeed;
  }

  const ContourMesh& Mesh;
  const PointList& Points;
  Eigen::VectorXd Contrast; // outside minus inside, pooled
  double Spread = 0;        // of the gray values inside
  Eigen::VectorXd Areas;    // up to a factor
  double Radius = 0;        // of a ball of the same volume
};

} // namespace

SurfaceConfidence JudgeSurface(const VoxelReader& read, const ImageGeometry& geometry,
  const ContourMesh& mesh, const PointList& points, const SeedSphere& seed,
  const Eigen::VectorXd& shifts, double unanimity, const ParallelFor& parallelFor)
{
  SurfaceConfidence confidence;
  const FloatImage image =
    ReadBox(read, geometry, BoxAroundPoints(geometry, points, LastStep + 1), parallelFor);
  Judgment judgment(mesh, points);
  judgment.MeasureContrast(image.View(), parallelFor);
  judgment.MeasureSize();
  confidence.OfVertices.resize(points.rows());
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    confidence.OfVertices[vertex] =
      static_cast<float>(judgment.SupportOf(vertex) * judgment.AgreementOf(vertex, shifts));
  }
  confidence.OfSurface = judgment.OfSurface(seed, unanimity, parallelFor);
  return confidence;
}

} // namespace FlipFree
