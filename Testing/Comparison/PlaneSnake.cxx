#include "PlaneSnake.h"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double CornerDistance = 1.5; // in pixels
constexpr int MinimumCorners = 8;
constexpr int ResamplingInterval = 5;
constexpr int AreaInterval = 25;

double LengthOf(const Outline& outline)
{
  double length = 0;
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    length += (outline.row((i + 1) % outline.rows()) - outline.row(i)).norm();
  }
  return length;
}

// The same curve with corners at equal distances along it.
Outline Resample(const Outline& outline)
{
  const double length = LengthOf(outline);
  const auto size = std::max<Eigen::Index>(MinimumCorners, std::llround(length / CornerDistance));
  Outline result(size, 2);
  Eigen::Index from = 0;
  double begin = 0; // of the edge, along the curve
  double edge = (outline.row(1) - outline.row(0)).norm();
  for (Eigen::Index i = 0; i < size; ++i)
  {
    const double at = length * static_cast<double>(i) / static_cast<double>(size);
    while (begin + edge < at && from + 1 < outline.rows())
    {
      begin += edge;
      ++from;
      edge = (outline.row((from + 1) % outline.rows()) - outline.row(from)).norm();
    }
    const double part = edge > 0 ? std::min(1.0, (at - begin) / edge) : 0;
    result.row(i) =
      outline.row(from) + part * (outline.row((from + 1) % outline.rows()) - outline.row(from));
  }
  return result;
}

// The implicit part of a step: identity, tension and bending of a closed curve.
using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

void Factorize(Eigen::Index size, const SnakeSettings& settings, Solver& solver)
{
  const double a = settings.Elasticity;
  const double b = settings.Rigidity;
  const double stencil[3] = { 1 + 2 * a + 6 * b, -a - 4 * b, b };
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < size; ++i)
  {
    entries.emplace_back(i, i, stencil[0]);
    for (Eigen::Index step = 1; step < 3; ++step)
    {
      entries.emplace_back(i, (i + step) % size, stencil[step]);
      entries.emplace_back(i, (i + size - step) % size, stencil[step]);
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  solver.compute(matrix);
}

Outline ForcesOn(const Outline& outline, const PlaneField& field, const SnakeSettings& settings)
{
  Outline forces(outline.rows(), 2);
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    const Eigen::Vector2d along = outline.row((i + 1) % outline.rows()) -
      outline.row((i + outline.rows() - 1) % outline.rows());
    const Eigen::Vector2d outward = Eigen::Vector2d(along[1], -along[0]).normalized();
    forces.row(i) =
      settings.Force * field(outline.row(i).transpose()) + settings.Pressure * outward;
  }
  return forces;
}

} // namespace

Eigen::Vector2d PlaneField::operator()(const Eigen::Vector2d& point) const
{
  const double x = std::max(0.0, std::min(point[0], this->Width - 1.0));
  const double y = std::max(0.0, std::min(point[1], this->Height - 1.0));
  const int left = std::min(static_cast<int>(x), std::max(0, this->Width - 2));
  const int low = std::min(static_cast<int>(y), std::max(0, this->Height - 2));
  const auto at = [this](int i, int j)
  {
    return this->Forces[std::min(i, this->Width - 1) +
      static_cast<std::size_t>(this->Width) * std::min(j, this->Height - 1)];
  };
  const double u = x - left;
  const double v = y - low;
  return (1 - v) * ((1 - u) * at(left, low) + u * at(left + 1, low)) +
    v * ((1 - u) * at(left, low + 1) + u * at(left + 1, low + 1));
}

bool MoveSnake(const PlaneField& field, const SnakeSettings& settings, const Monitor& monitor,
  Outline& outline, int& iterations)
{
  double area = 0;
  Solver solver;
  for (iterations = 0; iterations < settings.MaximumIterations; ++iterations)
  {
    if (!monitor(static_cast<double>(iterations) / settings.MaximumIterations))
    {
      return false;
    }
    if (iterations % ResamplingInterval == 0)
    {
      outline = Resample(outline);
      if (solver.rows() != outline.rows())
      {
        Factorize(outline.rows(), settings, solver);
      }
    }
    const Outline moved = outline + ForcesOn(outline, field, settings);
    outline = solver.solve(moved);
    outline.col(0) = outline.col(0).cwiseMax(0).cwiseMin(field.Width - 1);
    outline.col(1) = outline.col(1).cwiseMax(0).cwiseMin(field.Height - 1);
    if ((iterations + 1) % AreaInterval == 0)
    {
      const double now = std::abs(SignedArea(outline));
      if (std::abs(now - area) < settings.AreaTolerance * now)
      {
        ++iterations;
        break;
      }
      area = now;
    }
  }
  return true;
}

double SignedArea(const Outline& outline)
{
  double area = 0;
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    const auto from = outline.row(i);
    const auto to = outline.row((i + 1) % outline.rows());
    area += (from[0] * to[1] - to[0] * from[1]) / 2;
  }
  return area;
}

Outline MakeCircle(const Eigen::Vector2d& center, double radius)
{
  const double turn = 2 * std::acos(-1);
  const auto size =
    std::max<Eigen::Index>(MinimumCorners, std::llround(turn * radius / CornerDistance));
  Outline outline(size, 2);
  for (Eigen::Index i = 0; i < size; ++i)
  {
    const double angle = turn * static_cast<double>(i) / static_cast<double>(size);
    outline.row(i) << center[0] + radius * std::cos(angle), center[1] + radius * std::sin(angle);
  }
  return outline;
}

std::vector<unsigned char> FillOutline(const Outline& outline, int width, int height)
{
  std::vector<unsigned char> mask(static_cast<std::size_t>(width) * height, 0);
  for (int j = 0; j < height; ++j)
  {
    std::vector<std::pair<double, int>> crossings; // of the row's center line, and which way
    for (Eigen::Index i = 0; i < outline.rows(); ++i)
    {
      const auto from = outline.row(i);
      const auto to = outline.row((i + 1) % outline.rows());
      if ((from[1] <= j) != (to[1] <= j))
      {
        const double x = from[0] + (j - from[1]) / (to[1] - from[1]) * (to[0] - from[0]);
        crossings.emplace_back(x, from[1] <= j ? 1 : -1);
      }
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
    {
      winding += crossings[i].second;
      const int first = std::max(0, static_cast<int>(std::ceil(crossings[i].first)));
      const int last = std::min(width - 1, static_cast<int>(std::ceil(crossings[i + 1].first)) - 1);
      for (int column = first; winding != 0 && column <= last; ++column)
      {
        mask[column + static_cast<std::size_t>(width) * j] = 1;
      }
    }
  }
  return mask;
}

} // namespace FlipFree
