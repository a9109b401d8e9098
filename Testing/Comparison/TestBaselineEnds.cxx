// Methods that know neither several seeds nor ends, given both, as a comparison on vessels needs
// them: seeds at either end of a bar, and a path between them, beyond whose ends is nothing.
#include "BadInput.h"
#include "BaselineMethods.h"
#include "PathEnds.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

constexpr double FirstEnd = 15;
constexpr double SecondEnd = 57;
constexpr double BarRadius = 6;
const Eigen::Vector3d BarAxis(0, 18, 18);

// A bright bar along x through the whole of 72 x 36 x 36 mm, cut through in the middle or not.
vtkSmartPointer<vtkImageData> BarImage(bool isCut)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(49, 25, 25);
  image->SetSpacing(1.5, 1.5, 1.5);
  image->AllocateScalars(VTK_SHORT, 1);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 5);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    const Eigen::Vector3d point(image->GetPoint(voxel));
    const double gap = isCut ? 6 : 0;
    const bool isInside = (point - BarAxis).tail<2>().norm() < BarRadius &&
      std::abs(point.x() - (FirstEnd + SecondEnd) / 2) >= gap;
    image->GetPointData()->GetScalars()->SetTuple1(voxel, (isInside ? 100 : 0) + noise(random));
  }
  return image;
}

vtkSmartPointer<vtkPolyData> LineThrough(const std::vector<Eigen::Vector3d>& places)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(places.size()));
  for (const Eigen::Vector3d& place : places)
  {
    lines->InsertCellPoint(points->InsertNextPoint(place.data()));
  }
  auto path = vtkSmartPointer<vtkPolyData>::New();
  path->SetPoints(points);
  path->SetLines(lines);
  return path;
}

Eigen::Vector3d AlongBar(double x)
{
  return BarAxis + Eigen::Vector3d(x, 0, 0);
}

class BaselineEnds : public testing::TestWithParam<BaselineMethod>
{
protected:
  void SetUp() override
  {
    this->Filter->SetInputData(BarImage(false));
    this->Filter->SetSeedCenter(AlongBar(FirstEnd).data());
    this->Filter->SetSeedRadius(4);
    if (auto* level = vtkLevelSetSegmentation::SafeDownCast(this->Filter))
    {
      level->SetCurvatureScaling(0.2); // the bar is thin
    }
  }
  void AddSecondSeed() { this->Filter->AddFurtherSeed(SecondEnd, BarAxis.y(), BarAxis.z(), 4); }

  // Along the axis, of those from `begin` to `end`, the part that is labeled.
  double PartFound(double begin, double end)
  {
    double found = 0;
    double all = 0;
    for (double x = begin; x <= end; x += 0.5)
    {
      const Eigen::Vector3d place = AlongBar(x);
      const vtkIdType voxel =
        this->Filter->GetLabelMap()->FindPoint(place.x(), place.y(), place.z());
      found += this->Filter->GetLabelMap()->GetPointData()->GetScalars()->GetTuple1(voxel);
      ++all;
    }
    return found / all;
  }

  vtkSmartPointer<vtkBaselineSegmentation> Filter = GetParam().Make();
};

class BaselineSingleSeed : public BaselineEnds
{
};

std::vector<BaselineMethod> MethodsOf(bool severalSeeds)
{
  std::vector<BaselineMethod> methods;
  for (const BaselineMethod& method : BaselineMethods())
  {
    if ((method.Name != "SimplexMesh" && method.Name != "GVFSnake") == severalSeeds)
    {
      methods.push_back(method);
    }
  }
  return methods;
}

} // namespace

TEST_P(BaselineEnds, SeedsOfPartsThatDoNotMeetFindBoth)
{
  this->Filter->SetInputData(BarImage(true));
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->PartFound(13, 17), 1);
  EXPECT_EQ(this->PartFound(48, 60), 0);
  this->AddSecondSeed();
  EXPECT_EQ(this->Filter->GetNumberOfFurtherSeeds(), 1);
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->PartFound(13, 17), 1);
  EXPECT_EQ(this->PartFound(55, 59), 1);
  EXPECT_EQ(this->PartFound(34, 38), 0);
  this->Filter->RemoveAllFurtherSeeds();
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->PartFound(48, 60), 0);
}

TEST_P(BaselineEnds, NothingIsFoundBeyondThePath)
{
  this->AddSecondSeed();
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(this->PartFound(12, 14), 0.9);
  this->Filter->SetPathData(LineThrough({ AlongBar(FirstEnd), AlongBar(30), AlongBar(SecondEnd) }));
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->PartFound(16, 18), 1);
  EXPECT_EQ(this->PartFound(54, 56), 1);
  EXPECT_EQ(this->PartFound(0, 14), 0);
  EXPECT_EQ(this->PartFound(58, 72), 0);
  double bounds[6];
  this->Filter->GetSurface()->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], FirstEnd, 1.5);
  EXPECT_NEAR(bounds[1], SecondEnd, 1.5);
  this->Filter->SetPathData(nullptr);
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(this->PartFound(12, 14), 0.9);
}

TEST_P(BaselineEnds, BadSeedsAndPathsAreRefused)
{
  this->Filter->AddFurtherSeed(500, 0, 0, 4);
  ExpectRefusal(this->Filter, { "the seed's center (500, 0, 0) mm lies outside" });
  this->Filter->RemoveAllFurtherSeeds();
  this->Filter->AddFurtherSeed(SecondEnd, BarAxis.y(), BarAxis.z(), 0.1);
  ExpectRefusal(this->Filter, { "the seed's radius of 0.1 mm is below a voxel" });
  this->Filter->RemoveAllFurtherSeeds();
  vtkNew<vtkPolyData> empty;
  this->Filter->SetPathData(empty);
  ExpectRefusal(this->Filter, { "no line on port 1" });
  this->Filter->SetPathData(LineThrough({ AlongBar(20), AlongBar(20) }));
  ExpectRefusal(this->Filter, { "line 0 on port 1", "no two points that differ" });
  this->Filter->SetPathData(LineThrough({ AlongBar(20), AlongBar(NotANumber) }));
  ExpectRefusal(this->Filter, { "line 0 on port 1", "not a number" });
  this->Filter->SetPathData(LineThrough({ AlongBar(40), AlongBar(50) }));
  ExpectRefusal(this->Filter, { "beyond the ends of the path on port 1" });
}

TEST_P(BaselineSingleSeed, RefusesFurtherSeeds)
{
  this->AddSecondSeed();
  ExpectRefusal(this->Filter, { "starts from one seed, and has 2" });
}

// By the definition: the nearest of all points of the path is an end.
TEST(PathEnds, AreThoseOfEachVoxelsNearestPoint)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 23, 19, 17 } };
  geometry.Spacing = { 1.1, 1.7, 2.3 };
  geometry.Origin = { -5, 3, 8 };
  geometry.Direction << 0, -0.8, 0.6, 1, 0, 0, 0, -0.6, -0.8;
  const auto at = [&geometry](double i, double j, double k)
  { return geometry.ToPhysical(Eigen::Vector3d(i, j, k)); };
  // A hook, whose second end looks back at its first, and a branch.
  PathLines path(2);
  path[0].resize(21, 3);
  for (int place = 0; place <= 20; ++place)
  {
    const double angle = 4.2 * place / 20;
    path[0].row(place) = at(11 - 7 * std::cos(angle), 9 + 6 * std::sin(angle), 8 + 0.1 * place);
  }
  path[1].resize(5, 3);
  for (int place = 0; place <= 4; ++place)
  {
    path[1].row(place) = path[0].row(10) + 1.5 * place * Eigen::RowVector3d(0.6, 0, 0.8);
  }
  const BitMask beyond = VoxelsBeyondEnds(path, geometry, SerialFor);
  std::size_t expected = 0;
  for (int k = 0; k < geometry.Dimensions[2]; ++k)
  {
    for (int j = 0; j < geometry.Dimensions[1]; ++j)
    {
      for (int i = 0; i < geometry.Dimensions[0]; ++i)
      {
        const Eigen::Vector3d voxel = at(i, j, k);
        double least = HUGE_VAL;
        Eigen::Vector3d outward = Eigen::Vector3d::Zero();
        Eigen::Vector3d nearest = voxel;
        for (std::size_t line = 0; line < path.size(); ++line)
        {
          const Eigen::Index last = path[line].rows() - 1;
          for (Eigen::Index place = 0; place <= last; ++place)
          {
            const Eigen::Vector3d point = path[line].row(place);
            if ((point - voxel).norm() < least)
            {
              least = (point - voxel).norm();
              nearest = point;
              outward.setZero();
              if (place == last)
              {
                outward = path[line].row(last) - path[line].row(last - 1);
              }
              else if (place == 0 && line == 0)
              {
                outward = path[line].row(0) - path[line].row(1);
              }
            }
          }
        }
        const bool isBeyond = (voxel - nearest).dot(outward) > 0;
        EXPECT_EQ(beyond(i, j, k), isBeyond) << i << " " << j << " " << k;
        expected += isBeyond;
      }
    }
  }
  EXPECT_GT(expected, 500U);
  EXPECT_LT(expected, geometry.NumberOfVoxels() - 500);
}

INSTANTIATE_TEST_SUITE_P(Baselines, BaselineEnds, testing::ValuesIn(MethodsOf(true)), NameOf);
INSTANTIATE_TEST_SUITE_P(Baselines, BaselineSingleSeed, testing::ValuesIn(MethodsOf(false)),
  NameOf);
