#include "Deformation/LaplacianDeformation.h"
#include "Error.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// The least-squares problem of Eq. 4 to 8, one row per summand, in the paper's unknowns: the moved
// vertices u'. Solved densely.
class PaperEnergy
{
public:
  PaperEnergy(const ContourMesh& mesh, const PointList& points)
    : Mesh(mesh)
    , Points(points)
    , Size(mesh.NumberOfPoints())
  {
  }

  // Eq. 5 with Eq. 6: (1 - fairing) L(u) is what L(u') shall be.
  void AddLaplacians(double fairing)
  {
    for (int vertex = 0; vertex < this->Size; ++vertex)
    {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(this->Size);
      row[vertex] = 1;
      for (int neighbor : this->Mesh.Neighbors[vertex])
      {
        row[neighbor] -= 0.25;
      }
      this->Add(1, row, (1 - fairing) * row * this->Points);
    }
  }

  // Eq. 7.
  void AddPositions(double weight, const PointList& targets)
  {
    double mean = 0;
    for (int vertex = 0; vertex < this->Size; ++vertex)
    {
      mean += targets.row(vertex).norm() / this->Size;
    }
    for (int vertex = 0; vertex < this->Size; ++vertex)
    {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(this->Size);
      row[vertex] = 1;
      this->Add(weight * targets.row(vertex).norm() / mean, row,
        this->Points.row(vertex) + targets.row(vertex));
    }
  }

  // Eq. 8, edge by edge.
  void AddEdges(double weight)
  {
    for (const auto& contour : this->Mesh.Contours)
    {
      double length = 0;
      for (std::size_t position = 0; position < contour.size(); ++position)
      {
        length += this->EdgeOf(contour, position).norm() / static_cast<double>(contour.size());
      }
      for (std::size_t position = 0; position < contour.size(); ++position)
      {
        const Eigen::RowVector3d edge = this->EdgeOf(contour, position);
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(this->Size);
        row[contour[position]] = 1;
        row[contour[(position + 1) % contour.size()]] = -1;
        this->Add(weight, row, edge * length / edge.norm());
      }
    }
  }

  /// u' - u.
  PointList Minimize() const
  {
    const auto count = static_cast<Eigen::Index>(this->Rows.size());
    Eigen::MatrixXd matrix(count, this->Size);
    Eigen::MatrixXd right(count, 3);
    for (Eigen::Index row = 0; row < count; ++row)
    {
      matrix.row(row) = this->Rows[row];
      right.row(row) = this->Rights[row];
    }
    const Eigen::MatrixXd normal = matrix.transpose() * matrix;
    return Eigen::MatrixXd(normal.ldlt().solve(matrix.transpose() * right)) - this->Points;
  }

private:
  Eigen::RowVector3d EdgeOf(const std::vector<int>& contour, std::size_t position) const
  {
    return this->Points.row(contour[position]) -
      this->Points.row(contour[(position + 1) % contour.size()]);
  }
  void Add(double weight, const Eigen::RowVectorXd& row, const Eigen::RowVector3d& right)
  {
    this->Rows.emplace_back(std::sqrt(weight) * row);
    this->Rights.emplace_back(std::sqrt(weight) * right);
  }

  const ContourMesh& Mesh;
  const PointList& Points;
  int Size;
  std::vector<Eigen::RowVectorXd> Rows;
  std::vector<Eigen::RowVector3d> Rights;
};

struct Case
{
  explicit Case(int n, unsigned int seed = 1)
    : Sphere(n)
  {
    std::mt19937 random(seed);
    const Eigen::Index count = this->Sphere.Points().rows();
    this->Points = this->Sphere.Points() + WhiteNoise(count, 0.2 * this->Sphere.EdgeLength, random);
    this->Targets = WhiteNoise(count, this->Sphere.EdgeLength, random);
    this->Targets.col(2).array() += this->Sphere.EdgeLength;
  }
  DeformationReport Solve(const DeformationSettings& settings, PointList& motion) const
  {
    return DeformationSolver(this->Sphere.Mesh)
      .Solve(this->Points, this->Targets, settings, motion);
  }
  PointList Solve(const DeformationSettings& settings) const
  {
    PointList motion = PointList::Zero(this->Points.rows(), 3);
    this->Solve(settings, motion);
    return motion;
  }
  PointList Expected(const DeformationSettings& settings) const
  {
    PaperEnergy energy(this->Sphere.Mesh, this->Points);
    energy.AddLaplacians(settings.Fairing);
    energy.AddPositions(settings.PositionWeight, this->Targets);
    energy.AddEdges(settings.UniformWeight);
    return energy.Minimize();
  }

  TestSphere Sphere;
  PointList Points;
  PointList Targets;
};

double Difference(const PointList& one, const PointList& other)
{
  return (one - other).cwiseAbs().maxCoeff() / other.cwiseAbs().maxCoeff();
}

} // namespace

TEST(LaplacianDeformation, MinimizesThePapersEnergy)
{
  for (int n : { 1, 2, 5 })
  {
    const Case example(n);
    for (double position : { 0.1, 0.3, 3.0 })
    {
      for (double uniform : { 0.0, 0.03, 1.0, 10.0 })
      {
        for (double fairing : { 0.0, 0.4, 1.0 })
        {
          const DeformationSettings settings{ position, uniform, fairing };
          PointList motion = PointList::Zero(example.Points.rows(), 3);
          const DeformationReport report = example.Solve(settings, motion);
          EXPECT_FALSE(report.Factorized);
          EXPECT_LT(Difference(motion, example.Expected(settings)), 1e-4)
            << "n " << n << " weights " << position << " " << uniform << " " << fairing;
        }
      }
    }
  }
}

TEST(LaplacianDeformation, WhereItStartsDoesNotMatter)
{
  const Case example(5);
  const DeformationSettings settings{ 0.3, 1, 0.2 };
  const PointList cold = example.Solve(settings);
  PointList warm = 1.1 * cold;
  example.Solve(settings, warm);
  EXPECT_LT(Difference(warm, cold), 1e-5);
  PointList there = cold;
  EXPECT_EQ(example.Solve(settings, there).Iterations, 0);
  EXPECT_EQ(there, cold);
}

TEST(LaplacianDeformation, HugeWeightsDecideAlone)
{
  const Case example(5);
  // Positions: every vertex arrives.
  EXPECT_LT(Difference(example.Solve({ 1e7, 1, 0 }), example.Targets), 1e-4);
  // Edges.
  const DeformationSettings uniform{ 0.3, 1e4, 0 };
  PointList motion = PointList::Zero(example.Points.rows(), 3);
  example.Solve(uniform, motion);
  EXPECT_LT(Difference(motion, example.Expected(uniform)), 1e-3);
}

TEST(LaplacianDeformation, WithoutAnyForceNothingMoves)
{
  Case example(4);
  EXPECT_TRUE(example.Solve({ 0, 0, 0 }).isZero(0));
  example.Targets.setZero();
  EXPECT_TRUE(example.Solve({ 0.3, 0, 0 }).isZero(0));
  // Even from a start that moves: the result is at rest up to a translation, which nothing holds.
  std::mt19937 random(3);
  PointList motion = WhiteNoise(example.Points.rows(), 1, random);
  example.Solve({ 0, 0, 0 }, motion);
  EXPECT_LT((motion.rowwise() - motion.colwise().mean()).cwiseAbs().maxCoeff(), 1e-5);
}

// A coordinate in which nothing draws must not keep the solver busy until it gives up.
TEST(LaplacianDeformation, ACoordinateWithoutForceComesToRest)
{
  Case example(5);
  example.Targets.leftCols(2).setZero();
  PointList motion = PointList::Ones(example.Points.rows(), 3);
  const DeformationReport report = example.Solve({ 0.3, 0, 0 }, motion);
  EXPECT_FALSE(report.Factorized);
  EXPECT_LT(motion.leftCols(2).cwiseAbs().maxCoeff(), 1e-5 * motion.cwiseAbs().maxCoeff());
}

TEST(LaplacianDeformation, MovesWithTheMesh)
{
  Case example(6);
  const DeformationSettings settings{ 0.3, 1, 0.3 };
  const PointList still = example.Solve(settings);
  example.Points.rowwise() += Eigen::RowVector3d(500, -300, 200);
  EXPECT_LT(Difference(example.Solve(settings), still), 1e-5);
  // And turned.
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  example.Points = (example.Points * turn).eval();
  example.Targets = (example.Targets * turn).eval();
  EXPECT_LT(Difference(example.Solve(settings), still * turn), 1e-5);
}

// Weights so small that conjugate gradients would need too long: the factorization takes over.
TEST(LaplacianDeformation, FactorizesWhereIterationsDoNotConverge)
{
  const Case example(12, 5);
  const DeformationSettings settings{ 1e-6, 0, 0 };
  PointList motion = PointList::Zero(example.Points.rows(), 3);
  const DeformationReport report = example.Solve(settings, motion);
  EXPECT_TRUE(report.Factorized);
  EXPECT_LT(Difference(motion, example.Expected(settings)), 1e-2);
}

// The analysis of the pattern is kept, whatever the weights are the next time.
TEST(LaplacianDeformation, ASolverThatIsUsedAgainGivesTheSame)
{
  const Case example(12, 5);
  DeformationSolver solver(example.Sphere.Mesh);
  for (const DeformationSettings& settings : { DeformationSettings{ 1e-6, 0, 0 },
         DeformationSettings{ 0.3, 1, 0.2 }, DeformationSettings{ 1e-6, 0.0001, 0 } })
  {
    PointList motion = PointList::Zero(example.Points.rows(), 3);
    const DeformationReport report =
      solver.Solve(example.Points, example.Targets, settings, motion);
    PointList anew = PointList::Zero(example.Points.rows(), 3);
    EXPECT_EQ(example.Solve(settings, anew).Factorized, report.Factorized);
    EXPECT_EQ(motion, anew);
    EXPECT_EQ(report.Factorized, settings.PositionWeight < 0.1);
  }
}

// Conjugate gradients run in single precision, the factorization does not.
TEST(LaplacianDeformation, FactorizesWhatOverflowsSinglePrecision)
{
  Case example(5);
  const DeformationSettings settings{ 0.3, 1, 0 };
  PointList small = PointList::Zero(example.Points.rows(), 3);
  example.Points.setZero(); // no edges, so that the motion is linear in the targets
  EXPECT_FALSE(example.Solve(settings, small).Factorized);
  example.Targets *= 1e25;
  PointList motion = PointList::Zero(example.Points.rows(), 3);
  EXPECT_TRUE(example.Solve(settings, motion).Factorized);
  EXPECT_LT(Difference(1e-25 * motion, small), 1e-4);
}

// The squares overflow, so that neither iterations nor the factorization give a finite motion.
TEST(LaplacianDeformation, RefusesWhatHasNoFiniteSolution)
{
  Case example(4);
  example.Targets.row(7).setConstant(1e200);
  try
  {
    example.Solve({ 0.3, 1, 0 });
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.GetCode(), ErrorCode::SingularSystem);
    EXPECT_STREQ(error.what(),
      "the system of the deformation has no finite solution for displacements of up to 1e+200 mm; "
      "limit them (MaximumDisplacement), or check the surface");
  }
}

TEST(LaplacianDeformation, SolverRecoversAfterAFailure)
{
  const Case good(4);
  Case bad(4);
  bad.Targets.row(7).setConstant(1e200);
  const DeformationSettings settings;
  PointList expected = PointList::Zero(good.Points.rows(), 3);
  const DeformationReport report = good.Solve(settings, expected);

  DeformationSolver solver(good.Sphere.Mesh);
  PointList motion = PointList::Zero(good.Points.rows(), 3);
  EXPECT_THROW(solver.Solve(bad.Points, bad.Targets, settings, motion), Error);
  motion.setZero();
  EXPECT_EQ(solver.Solve(good.Points, good.Targets, settings, motion).Iterations,
    report.Iterations);
  EXPECT_EQ(motion, expected);
}

TEST(LaplacianDeformation, CollapsedEdgesDoNoHarm)
{
  Case example(4);
  example.Points.row(example.Sphere.Mesh.Neighbors[3][0]) = example.Points.row(3);
  EXPECT_TRUE(example.Solve({ 0.3, 1, 0 }).allFinite());
}
