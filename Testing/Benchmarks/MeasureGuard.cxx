// What the guard costs: a step of an ordinary size and an expansion from 26 mm to 52 mm, for n = 8
// to 128, with the exponent by which the time grows with the number of vertices; and the same
// expansion of one large mesh.
#include "Guard/EmbeddingGuard.h"
#include "RandomMotions.h"
#include "Statistics.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

using namespace FlipFree;

namespace
{

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// The least of several runs.
template <typename Call>
double SecondsOf(const Call& call, int runs)
{
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run)
  {
    const double begin = Now();
    call();
    least = std::min(least, Now() - begin);
  }
  return least;
}

struct Expansion
{
  explicit Expansion(int n)
    : Sphere(MakeQuadSphere(n, Eigen::Vector3d::Zero(), 26.0, QuadSphereSpacing::Equiangular))
    , Mesh(BuildContourMesh(static_cast<int>(this->Sphere.Points.rows()), this->Sphere.Faces))
  {
  }
  const PointList& Points() const { return this->Sphere.Points; }
  const PointList& Motion() const { return this->Sphere.Points; } // 26 mm outward

  QuadSphere Sphere;
  ContourMesh Mesh;
};

void MeasureGrowth(int greatest)
{
  std::puts(
    "| n | vertices | step of noise, 0.05 edges, ms | expansion by 26 mm, ms |\n|---|---|---|---|");
  std::vector<double> sizes;
  std::vector<double> times;
  for (int n = 8; n <= greatest; n *= 2)
  {
    const Expansion expansion(n);
    EmbeddingGuard guard(expansion.Mesh);
    const double edge = 26.0 * 1.57 / n;
    std::mt19937 random(1);
    const PointList noise = WhiteNoise(expansion.Points().rows(), 0.05 * edge, random);
    const auto limit = [&](const PointList& motion)
    {
      return SecondsOf(
        [&]
        {
          PointList displacements = motion;
          guard.Limit(expansion.Points(), displacements, SerialFor, NeverStop);
        },
        5);
    };
    const double step = limit(noise);
    const double grow = limit(expansion.Motion());
    std::printf("| %d | %td | %.2f | %.2f |\n", n,
      static_cast<std::ptrdiff_t>(expansion.Points().rows()), 1e3 * step, 1e3 * grow);
    sizes.push_back(static_cast<double>(expansion.Points().rows()));
    times.push_back(step);
  }
  std::printf("the step's time grows with the number of vertices to the power of %.2f\n",
    FittedExponent(sizes, times));
}

void MeasureExpansion(int n)
{
  const Expansion expansion(n);
  EmbeddingGuard guard(expansion.Mesh);
  GuardReport report;
  const double seconds = SecondsOf(
    [&]
    {
      PointList displacements = expansion.Motion();
      report = guard.Limit(expansion.Points(), displacements, SerialFor, NeverStop);
    },
    3);
  std::printf("expansion of %td vertices by 26 mm: %.3f s, %d guarded\n",
    static_cast<std::ptrdiff_t>(expansion.Points().rows()), seconds, report.Guarded);
}

} // namespace

int main(int argc, char* argv[])
{
  int greatest = 128;
  int n = 129;
  CLI::App app("Measures what the guard costs.");
  app.add_option("--greatest", greatest, "n of the greatest mesh of the series")
    ->capture_default_str();
  app.add_option("--expansion", n, "n of the large mesh that is expanded")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  MeasureGrowth(greatest);
  MeasureExpansion(n);
  return 0;
}
