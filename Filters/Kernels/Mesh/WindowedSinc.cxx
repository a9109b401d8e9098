#include "Mesh/WindowedSinc.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

// A sum of the first Chebyshev polynomials, at cos(angle).
double SumAt(const std::vector<double>& coefficients, double angle)
{
  double sum = 0;
  for (std::size_t n = 0; n < coefficients.size(); ++n)
  {
    sum += coefficients[n] * std::cos(static_cast<double>(n) * angle);
  }
  return sum;
}

// Its derivative there.
double SlopeAt(const std::vector<double>& coefficients, double angle)
{
  double slope = 0;
  for (std::size_t n = 1; n < coefficients.size(); ++n)
  {
    const auto degree = static_cast<double>(n);
    slope += coefficients[n] * degree * std::sin(degree * angle) / std::sin(angle);
  }
  return slope;
}

// The coefficients of an ideal low-pass filter up to `angle`, in a Hamming window.
std::vector<double> LowPass(int iterations, double angle)
{
  std::vector<double> coefficients(iterations + 1);
  for (int n = 0; n <= iterations; ++n)
  {
    const double window = 0.54 + 0.46 * std::cos(n * Pi / (iterations + 1));
    coefficients[n] = window * (n == 0 ? angle / Pi : 2 * std::sin(n * angle) / (n * Pi));
  }
  return coefficients;
}

// The filter is widened until it passes the end of the pass band unchanged.
std::vector<double> Coefficients(int iterations, double passBand)
{
  constexpr int mostSteps = 500;
  constexpr double tolerance = 1e-3;
  const double angle = std::acos(1 - 0.5 * passBand);
  double shift = 0;
  std::vector<double> coefficients = LowPass(iterations, angle);
  for (int step = 0; iterations > 1 && step < mostSteps; ++step)
  {
    const double excess = SumAt(coefficients, angle) - 1;
    if (std::abs(excess) < tolerance)
    {
      break;
    }
    shift -= excess / SlopeAt(coefficients, angle);
    coefficients = LowPass(iterations, angle + shift);
  }
  return coefficients;
}

// The neighbors of all vertices, each once, one vertex behind the other.
struct Neighbors
{
  std::vector<int> Begin;
  std::vector<int> Vertices;

  Neighbors(const TriangleList& triangles, Eigen::Index size)
    : Begin(size + 1, 0)
  {
    // In a closed surface each edge occurs in both directions.
    std::vector<std::array<int, 2>> edges;
    edges.reserve(3 * triangles.rows());
    for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        edges.push_back({ { triangles(triangle, corner), triangles(triangle, (corner + 1) % 3) } });
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [from, to] : edges)
    {
      ++this->Begin[from + 1];
      this->Vertices.push_back(to);
    }
    for (Eigen::Index vertex = 0; vertex < size; ++vertex)
    {
      this->Begin[vertex + 1] += this->Begin[vertex];
    }
  }

  // From each vertex to the mean of its neighbors.
  void Subtract(const PointList& points, PointList& laplacian) const
  {
    laplacian.setZero(points.rows(), 3);
    for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
    {
      const int count = this->Begin[vertex + 1] - this->Begin[vertex];
      for (int neighbor = this->Begin[vertex]; neighbor < this->Begin[vertex + 1]; ++neighbor)
      {
        laplacian.row(vertex) +=
          (points.row(this->Vertices[neighbor]) - points.row(vertex)) / count;
      }
    }
  }
};

} // namespace

void SmoothByWindowedSinc(const TriangleList& triangles, int iterations, double passBand,
  PointList& points)
{
  const std::vector<double> coefficients = Coefficients(iterations, passBand);
  const Neighbors neighbors(triangles, points.rows());
  PointList before = points;
  PointList laplacian;
  neighbors.Subtract(before, laplacian);
  PointList now = before + 0.5 * laplacian;
  points = coefficients[0] * before + coefficients[1] * now;
  for (int n = 2; n <= iterations; ++n)
  {
    neighbors.Subtract(now, laplacian);
    before = 2 * now + laplacian - before; // the Chebyshev recurrence
    before.swap(now);
    points += coefficients[n] * now;
  }
}

} // namespace FlipFree
