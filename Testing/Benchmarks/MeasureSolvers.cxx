// Compares the solvers that the deformation step could use, on its real systems: our conjugate
// gradients, Eigen's sparse Cholesky factorizations, and CHOLMOD's where it is installed (with
// whatever BLAS the machine gives it). One thread, three right-hand sides; medians. Factorizations
// get their matrix assembled and its pattern analyzed for nothing.
//
//   MeasureSolvers [--greatest N] [--runs N]
#include "ExampleRun.h"

#include <CLI/CLI.hpp>
#include <Eigen/SparseCholesky>
#ifdef FLIPFREE_HAS_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <algorithm>
#include <cstdio>
#include <vector>

#include "Stopwatch.h"

using namespace FlipFree;

namespace
{

// Factorizations of large systems take seconds; two of them tell enough.
constexpr double LongEnough = 3;

template <typename Call>
double MedianSeconds(const Call& call, int runs)
{
  std::vector<double> seconds;
  double total = 0;
  while (static_cast<int>(seconds.size()) < runs && (seconds.size() < 2 || total < LongEnough))
  {
    Stopwatch watch;
    call();
    seconds.push_back(watch.Lap());
    total += seconds.back();
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

struct Example
{
  const char* Name;
  DeformationSettings Settings;
  bool Propagated; ///< else solitary vertices have no weight
};

class Comparison
{
public:
  Comparison(const SurfaceOnItsWay& surface, const Example& example, int runs)
    : Mesh(surface.Mesh)
    , Runs(runs)
  {
    const PointList& targets =
      (example.Propagated ? surface.Wanted : surface.Targets).Displacements;
    DeformationSolver solver(this->Mesh);
    DeformationReport report;
    const double seconds = MedianSeconds(
      [&]
      {
        this->Motion = targets;
        report = solver.Solve(surface.Points, targets, example.Settings, this->Motion);
      },
      runs);
    std::printf("| %.2f, %d iterations%s ", 1e3 * seconds, report.Iterations,
      report.Factorized ? ", then factorized" : "");

    Eigen::VectorXd diagonal;
    FindPositionWeights(targets, example.Settings.PositionWeight, diagonal);
    VertexField right(4, targets.rows());
    VertexField work(4, targets.rows());
    FindRightSide(this->Mesh, surface.Points, targets, example.Settings, diagonal, right, work);
    this->Right = right.topRows<3>().transpose();
    this->Matrix = AssembleSystem(this->Mesh, example.Settings.UniformWeight, diagonal);
  }

  template <typename Solver>
  void Measure()
  {
    Solver solver;
    const double analysis = MedianSeconds([&] { solver.analyzePattern(this->Matrix); }, this->Runs);
    Eigen::MatrixXd motion;
    const double seconds = MedianSeconds(
      [&]
      {
        solver.factorize(this->Matrix);
        motion = solver.solve(this->Right);
      },
      this->Runs);
    this->MaximumDifference = std::max(this->MaximumDifference,
      (motion - this->Motion).cwiseAbs().maxCoeff() / this->Motion.cwiseAbs().maxCoeff());
    std::printf("| %.2f (%.0f) ", 1e3 * seconds, 1e3 * analysis);
    std::fflush(stdout);
  }

  double MaximumDifference = 0; ///< between conjugate gradients and the factorizations

private:
  const ContourMesh& Mesh;
  int Runs;
  PointList Motion;
  Eigen::MatrixXd Right;
  Eigen::SparseMatrix<double> Matrix;
};

} // namespace

int main(int argc, char* argv[])
{
  int greatest = 64;
  int runs = 9;
  CLI::App app("Compares the linear solvers for the deformation step.");
  app.add_option("--greatest", greatest, "n of the greatest mesh, up to 128")
    ->capture_default_str();
  app.add_option("--runs", runs, "of which medians are printed")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::puts("milliseconds; of factorizations in brackets the analysis, once per topology");
#ifndef FLIPFREE_HAS_CHOLMOD
  std::puts(
    "CHOLMOD is not installed (Debian: libsuitesparse-dev), or was not when this was built");
#endif
  std::puts("| n | weights | conjugate gradients | LDLT | LLT "
#ifdef FLIPFREE_HAS_CHOLMOD
            "| CHOLMOD LDLT | CHOLMOD supernodal "
#endif
            "| greatest difference, relative |\n|---|---|---|---|---"
#ifdef FLIPFREE_HAS_CHOLMOD
            "|---|---"
#endif
            "|---|");
  using Matrix = Eigen::SparseMatrix<double>;
  for (const auto& [n, surface] : TheExampleRun().Surfaces)
  {
    for (const Example& example : { Example{ "default: lambda_p 0.3, lambda_u 1", {}, true },
           Example{ "default, solitary vertices free", {}, false },
           Example{ "lambda_u 0.1", { 0.3, 0.1, 0 }, true },
           Example{ "lambda_u 0", { 0.3, 0, 0 }, true },
           Example{ "lambda_p 0.01", { 0.01, 1, 0 }, true } })
    {
      if (n > greatest)
      {
        continue;
      }
      std::printf("| %d | %s ", n, example.Name);
      Comparison comparison(surface, example, runs);
      comparison.Measure<Eigen::SimplicialLDLT<Matrix>>();
      comparison.Measure<Eigen::SimplicialLLT<Matrix>>();
#ifdef FLIPFREE_HAS_CHOLMOD
      comparison.Measure<Eigen::CholmodSimplicialLDLT<Matrix>>();
      comparison.Measure<Eigen::CholmodSupernodalLLT<Matrix>>();
#endif
      std::printf("| %.0e |\n", comparison.MaximumDifference);
      std::fflush(stdout);
    }
  }
  return 0;
}
