// What the guard costs: a step of an ordinary size and an expansion from 26 mm to 52 mm, for n = 8
// to 128, with the exponent by which the time grows with the number of vertices; and the same
// expansion with the boxes that triangles sweep in place of boxes that move, whose time is all in
// pairs that merely move alike.
#include "Geometry/TriangleTree.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/MotionCertificate.h"
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

// The classical test: boxes of all that a triangle passes. Counts the pairs that are left for the
// exact part, and those of them that fail, which for an expansion are none.
std::ptrdiff_t SweptBoxes(const Expansion& expansion, std::ptrdiff_t& failed)
{
  const TriangleList& triangles = expansion.Mesh.Triangles;
  const PointList from = expansion.Points();
  const PointList to = from + expansion.Motion();
  const Motion motion{ from, to };
  const MotionGap gap{ 1e-3, 1e-9 };
  const TriangleTree tree(from, triangles);
  const auto front = tree.PairsOfStrangers(from, triangles);
  std::vector<TriangleBox> boxes;
  tree.Refit(boxes,
    [&](int triangle)
    {
      TriangleBox box;
      for (int corner = 0; corner < 3; ++corner)
      {
        box.Add(from.row(triangles(triangle, corner)).data());
        box.Add(to.row(triangles(triangle, corner)).data());
      }
      return box;
    });
  const auto corners = [&](int triangle)
  {
    return std::array<int, 3>{ { triangles(triangle, 0), triangles(triangle, 1),
      triangles(triangle, 2) } };
  };
  std::ptrdiff_t tested = 0;
  const auto pairs = tree.PairsBelow(
    front, [&](int node, int other) { return boxes[node].Touches(boxes[other]); },
    [&](int one, int two)
    {
      ++tested;
      return ApartUntil(motion, corners(one), corners(two), gap) < 1;
    },
    SerialFor);
  failed = static_cast<std::ptrdiff_t>(pairs.size());
  return tested;
}

void MeasureGrowth(int greatest)
{
  std::puts(
    "| n | vertices | step of noise, 0.05 edges, ms | expansion by 26 mm, ms |\n|---|---|---|---|");
  std::vector<double> sizes;
  std::vector<double> times;
  for (int n = 8; n <= greatest; n *= 2)
  {
    const Expansion expansion(n);
    const EmbeddingGuard guard(expansion.Mesh);
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

void CompareWithSweptBoxes(int n)
{
  const Expansion expansion(n);
  const EmbeddingGuard guard(expansion.Mesh);
  GuardReport report;
  const double ours = SecondsOf(
    [&]
    {
      PointList displacements = expansion.Motion();
      report = guard.Limit(expansion.Points(), displacements, SerialFor, NeverStop);
    },
    3);
  std::printf("expansion of %td vertices by 26 mm: %.2f s, %d held back\n",
    static_cast<std::ptrdiff_t>(expansion.Points().rows()), ours, report.HeldBack);
  std::fflush(stdout);
  std::ptrdiff_t failed = 0;
  std::ptrdiff_t tested = 0;
  const double theirs = SecondsOf([&] { tested = SweptBoxes(expansion, failed); }, 1);
  std::printf(
    "the same with swept boxes: %.2f s, %td pairs tested, %td failed; %.0f times as long\n", theirs,
    tested, failed, theirs / ours);
}

} // namespace

int main(int argc, char* argv[])
{
  int greatest = 128;
  int n = 129;
  CLI::App app("Measures what the guard costs.");
  app.add_option("--greatest", greatest, "n of the greatest mesh of the series")
    ->capture_default_str();
  app.add_option("--expansion", n, "n of the mesh that is compared with swept boxes")
    ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  MeasureGrowth(greatest);
  CompareWithSweptBoxes(n);
  return 0;
}
