#include "Deformation/Correspondence.h"
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/NoData.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

using Scalar = std::function<double(const Eigen::Vector3d& index)>;

struct TestImage
{
  TestImage(const ImageGeometry& geometry, const Scalar& value)
  {
    this->View.Geometry = geometry;
    ForEachVoxel(geometry,
      [&](int i, int j, int k) {
        this->Voxels.push_back(static_cast<float>(value({ i + 0.0, j + 0.0, k + 0.0 })));
      });
    this->View.Data = this->Voxels.data();
  }
  BitMask Foreground() const
  {
    return VoxelsWhere(
      this->View, [](float value) { return value >= 0.5F; }, SerialFor);
  }
  BitMask NoData() const
  {
    return FindNoData(ReaderOf(this->View), this->View.Geometry, SerialFor);
  }
  std::vector<float> Voxels;
  ImageView<float> View;
};

// A row of voxels along x: '#' is foreground, '?' has no data.
TestImage Row(const std::string& voxels, double spacing = 1)
{
  return TestImage(Grid({ { static_cast<int>(voxels.size()), 1, 1 } }, { spacing, 1, 1 }),
    [&](const Eigen::Vector3d& index)
    {
      const char voxel = voxels[static_cast<int>(index[0])];
      return voxel == '?' ? std::numeric_limits<double>::quiet_NaN() : (voxel == '#' ? 1 : 0);
    });
}

struct Answer
{
  bool Found;
  double Distance;
};

Answer Search(const TestImage& image, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
  const CorrespondenceSettings& settings, const TestImage* edges = nullptr)
{
  PointList points(1, 3);
  PointList normals(1, 3);
  points.row(0) = point;
  normals.row(0) = normal;
  const CorrespondenceField field = FindCorrespondences(points, normals, image.Foreground(),
    image.NoData(), edges != nullptr ? edges->View : ImageView<float>(), settings, SerialFor);
  EXPECT_NE(field.States[0], VertexState::Flipping);
  return { field.States[0] == VertexState::Matched,
    field.Displacements.row(0).dot(normals.row(0)) };
}

// The search alone, without refinement at edges and at the image's end.
CorrespondenceSettings PlainSearch(double distance)
{
  CorrespondenceSettings settings;
  settings.SearchDistance = distance;
  settings.ImageBoundaryDistance = 0;
  settings.EdgeWindow = 0;
  return settings;
}

CorrespondenceSettings RunOf(int voxels)
{
  CorrespondenceSettings settings = PlainSearch(40);
  settings.RunLength = 0;
  settings.RunVoxels = voxels;
  return settings;
}

CorrespondenceSettings RunOfLength(double length)
{
  CorrespondenceSettings settings = PlainSearch(100);
  settings.RunLength = length;
  return settings;
}

const Eigen::Vector3d AlongX(1, 0, 0);

void ExpectFound(const Answer& answer, double distance)
{
  EXPECT_TRUE(answer.Found);
  EXPECT_NEAR(answer.Distance, distance, 1e-12);
}

// Uneven directions all over the sphere.
PointList Directions(int count)
{
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  PointList directions(count, 3);
  for (int row = 0; row < count; ++row)
  {
    directions.row(row) =
      Eigen::RowVector3d(normal(random), normal(random), normal(random)).normalized();
  }
  return directions;
}

// Where the line leaves the box, both given in index space.
double BoxExit(const Eigen::Vector3d& point, const Eigen::Vector3d& slope,
  const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  double exit = 1e9;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double face = slope[axis] > 0 ? high[axis] : low[axis];
    exit = std::min(exit, (face - point[axis]) / slope[axis]);
  }
  return exit;
}

bool InBox(const Eigen::Vector3d& index)
{
  return (index.array() >= Eigen::Array3d(10, 9, 7)).all() &&
    (index.array() <= Eigen::Array3d(29, 27, 14)).all();
}

} // namespace

TEST(Correspondence, ReachesTheFaceOfABoxExactly)
{
  for (const auto& [name, matrix] : ExampleDirections())
  {
    ImageGeometry geometry = Grid({ { 40, 38, 22 } }, { 0.8, 1.1, 2.3 });
    geometry.Origin = Eigen::Vector3d(-30, 12, 200);
    geometry.Direction = matrix;
    const TestImage image(geometry, InBox);
    const Eigen::Vector3d start(19.2, 17.7, 10.1);
    const PointList normals = Directions(500);
    const PointList points = geometry.ToPhysical(start).transpose().replicate(500, 1);
    const CorrespondenceField field =
      FindCorrespondences(points, normals, image.Foreground(), {}, {}, RunOf(2), SerialFor);
    for (int vertex = 0; vertex < 500; ++vertex)
    {
      const Eigen::Vector3d slope =
        (matrix.transpose() * normals.row(vertex).transpose()).cwiseQuotient(geometry.Spacing);
      const double expected = BoxExit(start, slope, { 9.5, 8.5, 6.5 }, { 29.5, 27.5, 14.5 });
      ASSERT_EQ(field.States[vertex], VertexState::Matched);
      ASSERT_LT((field.Displacements.row(vertex) - expected * normals.row(vertex)).norm(), 1e-10)
        << name;
    }
  }
}

// From outside, with outward normals, the same face is found by looking inward.
TEST(Correspondence, ReachesTheSameFaceFromOutside)
{
  const ImageGeometry geometry = Grid({ { 40, 38, 22 } }, { 0.8, 1.1, 2.3 });
  const TestImage image(geometry, InBox);
  const Eigen::Vector3d start = geometry.ToPhysical({ 19.2, 17.7, 10.1 });
  const PointList normals = Directions(500);
  const PointList inner = start.transpose().replicate(500, 1);
  // Beyond the image's end as well: the search may begin there.
  const PointList outer = inner + 36 * normals;
  const CorrespondenceField fromInside =
    FindCorrespondences(inner, normals, image.Foreground(), {}, {}, RunOf(1), SerialFor);
  const CorrespondenceField fromOutside =
    FindCorrespondences(outer, normals, image.Foreground(), {}, {}, RunOf(1), SerialFor);
  for (int vertex = 0; vertex < 500; ++vertex)
  {
    ASSERT_EQ(fromOutside.States[vertex], VertexState::Matched);
    ASSERT_LT((inner.row(vertex) + fromInside.Displacements.row(vertex) - outer.row(vertex) -
                fromOutside.Displacements.row(vertex))
                .norm(),
      1e-10);
  }
}

// A gap of exactly the length counts, whichever way its ends are rounded.
TEST(Correspondence, RunsInMillimetersDoNotDependOnTheVoxels)
{
  for (double spacing : { 0.1, 0.3, 0.7, 1.1, 2.9 })
  {
    const TestImage image = Row("#####...####........", spacing);
    for (double start : { 0.0, 0.123, 1.77, 2.0, 3.999 })
    {
      const Eigen::Vector3d point(start * spacing, 0, 0);
      const double gap = (4.5 - start) * spacing;
      ExpectFound(Search(image, point, AlongX, RunOfLength(2.5 * spacing)), gap);
      ExpectFound(Search(image, point, AlongX, RunOfLength(3 * spacing)), gap);
      ExpectFound(Search(image, point, AlongX, RunOfLength(3.1 * spacing)), gap + 7 * spacing);
    }
  }
}

// What each search from a point x along a row finds; a vertex that finds nothing is solitary.
TEST(Correspondence, FindsTheFirstRunOfARow)
{
  constexpr double Solitary = std::numeric_limits<double>::infinity();
  const struct
  {
    const char* Voxels;
    double X;
    int Run;
    double SearchDistance;
    double ImageBoundaryDistance;
    bool Inward;
    double Expected;
  } cases[] = {
    // Outward runs skip gaps that are shorter.
    { "#####..####........", 2, 1, 40, 0, true, 2.5 },
    { "#####..####........", 2, 2, 40, 0, true, 2.5 },
    { "#####..####........", 2, 3, 40, 0, true, 8.5 },
    { "#####..####........", 2, 8, 40, 0, true, 8.5 },
    { "#####..####........", 2, 9, 40, 0, true, Solitary },
    // Inward runs skip specks.
    { "..####...#....", 12, 1, 40, 0, true, -2.5 },
    { "..####...#....", 12, 2, 40, 0, true, -6.5 },
    { "..####...#....", 12, 5, 40, 0, true, Solitary },
    // The line's end.
    { "##########..........", 3, 1, 6.4, 0, true, Solitary },
    { "##########..........", 3, 1, 6.6, 0, true, 6.5 },
    // The image's boundary is a target only on demand and nearby.
    { "..########", 5, 3, 40, 0, true, Solitary },
    { "..########", 5, 3, 40, 4.4, true, Solitary },
    { "..########", 5, 3, 40, 4.6, true, 4.5 },
    // So is the border of what has no data, behind which there may be more.
    { "..########????????", 5, 3, 40, 0, true, Solitary },
    { "..########????????", 5, 3, 40, 4.4, true, Solitary },
    { "..########????????", 5, 3, 40, 4.6, true, 4.5 },
    { "..########.???????", 5, 3, 40, 0, true, 4.5 },
    { "..####??####......", 3, 3, 40, 0, true, 8.5 },
    // A run that the boundary cuts off begins where it begins.
    { "..######..", 5, 3, 40, 4.6, true, 2.5 },
    { "..######..", 5, 3, 40, 0, true, Solitary },
    // Eq. 2 read literally: in the background, a run begins at the vertex itself. Cut off by the
    // boundary there is none, and none outside the image.
    { "###..........", 6, 4, 40, 0, false, 0 },
    { "###..........", 1, 4, 40, 0, false, 1.5 },
    { "###..........", 10, 4, 40, 0, false, Solitary },
    { "###..........", 20, 4, 40, 0, false, Solitary },
    { "###..........", 6, 3, 40, 0, true, -3.5 },
  };
  for (const auto& example : cases)
  {
    SCOPED_TRACE(testing::Message() << example.Voxels << " from " << example.X << ", run of "
                                    << example.Run << ", inward " << example.Inward);
    CorrespondenceSettings settings = RunOf(example.Run);
    settings.SearchDistance = example.SearchDistance;
    settings.ImageBoundaryDistance = example.ImageBoundaryDistance;
    settings.SearchInward = example.Inward;
    const Answer answer = Search(Row(example.Voxels), { example.X, 0, 0 }, AlongX, settings);
    EXPECT_EQ(answer.Found, example.Expected < Solitary);
    EXPECT_NEAR(answer.Distance, answer.Found ? example.Expected : 0, 1e-12);
  }
}

// Partial volume: the voxels' faces are up to half a voxel off, the edge is where the blurred step
// is steepest.
TEST(Correspondence, EdgeWindowFindsTheAnalyticEdge)
{
  const double edge = 12.3;
  const auto blurred = [&](const Eigen::Vector3d& index)
  { return 50 + 50 * std::erf((edge - index[0]) / 1.5); };
  const ImageGeometry geometry = Grid({ { 30, 3, 3 } }, { 1, 1, 1 });
  const TestImage gray(geometry, blurred);
  // A threshold that is off by more than a voxel.
  const TestImage feature(geometry,
    [&](const Eigen::Vector3d& index) { return blurred(index) > 93; });
  CorrespondenceSettings settings = RunOf(2);
  const Eigen::Vector3d inside(6, 1, 1);
  const double crude = Search(feature, inside, AlongX, settings).Distance;
  EXPECT_GT(std::abs(6 + crude - edge), 0.7);
  settings.EdgeWindow = 3;
  EXPECT_NEAR(6 + Search(feature, inside, AlongX, settings, &gray).Distance, edge, 0.5);
  EXPECT_NEAR(20 + Search(feature, { 20, 1, 1 }, AlongX, settings, &gray).Distance, edge, 0.5);
  // Only edges that fall outward count; with none the target stays on the voxel's face.
  const TestImage rising(geometry, [&](const Eigen::Vector3d& index) { return -blurred(index); });
  EXPECT_NEAR(Search(feature, inside, AlongX, settings, &rising).Distance, crude, 1e-12);
  // Unless the ramp says that what is darker is the organ's own.
  settings.Ramp.Low = -120;
  settings.Ramp.High = -90;
  settings.Ramp.Width = 200;
  EXPECT_NEAR(6 + Search(feature, inside, AlongX, settings, &rising).Distance, edge, 0.7);
}

TEST(Correspondence, AnyNumberOfPartsGivesTheSameBits)
{
  std::mt19937 random(3);
  const ImageGeometry geometry = Grid({ { 40, 38, 22 } }, { 0.8, 1.1, 2.3 });
  const TestImage noise(geometry, [&](const Eigen::Vector3d&) { return random() % 100 * 0.01; });
  const PointList normals = Directions(777);
  const PointList points =
    geometry.ToPhysical({ 20, 19, 11 }).transpose().replicate(777, 1) + 5 * Directions(777);
  CorrespondenceSettings settings = RunOf(3);
  settings.EdgeWindow = 2;
  const CorrespondenceField serial =
    FindCorrespondences(points, normals, noise.Foreground(), {}, noise.View, settings, SerialFor);
  EXPECT_GT(std::count(serial.States.begin(), serial.States.end(), VertexState::Matched), 300);
  const CorrespondenceField parts = FindCorrespondences(points, normals, noise.Foreground(), {},
    noise.View, settings, ScatteredFor);
  EXPECT_EQ(parts.States, serial.States);
  EXPECT_EQ(parts.Displacements, serial.Displacements);
}

TEST(Correspondence, MovesWithTheImage)
{
  std::mt19937 random(4);
  const ImageGeometry geometry = Grid({ { 40, 38, 22 } }, { 0.8, 1.1, 2.3 });
  TestImage image(geometry,
    [&](const Eigen::Vector3d& index) { return InBox(index) + random() % 100 * 0.007; });
  const PointList normals = Directions(500);
  const PointList points =
    geometry.ToPhysical({ 19.2, 17.7, 10.1 }).transpose().replicate(500, 1) + 7 * Directions(500);
  CorrespondenceSettings settings = RunOfLength(3);
  settings.EdgeWindow = 2;
  const CorrespondenceField still =
    FindCorrespondences(points, normals, image.Foreground(), {}, image.View, settings, SerialFor);
  for (const auto& [name, matrix] : ExampleDirections())
  {
    const Eigen::RowVector3d shift(100, -50, 7);
    image.View.Geometry.Direction = matrix;
    image.View.Geometry.Origin = shift.transpose();
    const CorrespondenceField moved =
      FindCorrespondences((points * matrix.transpose()).rowwise() + shift,
        normals * matrix.transpose(), image.Foreground(), {}, image.View, settings, SerialFor);
    EXPECT_EQ(moved.States, still.States) << name;
    EXPECT_LT(
      (moved.Displacements - still.Displacements * matrix.transpose()).cwiseAbs().maxCoeff(), 1e-9)
      << name;
  }
}
