// What users ask for: each check by itself, and what is kept between segmentations.
#include "Deformation/OrganGroup.h"
#include "Deformation/SegmentationRequest.h"
#include "MessageText.h"

#include "ExampleMasks.h"
#include "GridParts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

const std::string StartLabelsName = "the start labels";

// A ball in an image, and as a label map of the value 3.
class AskedBall
{
public:
  AskedBall()
  {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 4);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d place = this->Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        const bool inside = (place - this->Seed.Center).norm() < 15;
        this->Voxels.push_back(static_cast<float>((inside ? 100 : 0) + normal(random)));
        this->Labels.push_back(inside ? 3.0F : 0.0F);
      });
  }

  GrayVolume Gray() const
  {
    GrayVolume volume = GrayVolumeOf(ImageView<float>{ this->Voxels.data(), this->Geometry });
    volume.Read = [this, all = volume.Read](int begin, int end, int j, int k, float* to)
    {
      // Each time, the seed's box is read from its first row on.
      for (const double radius : { this->Seed.Radius, OtherRadius })
      {
        const VoxelBox seed = BoxAround(this->Geometry, this->Seed.Center, radius);
        const bool isFirst = std::array<int, 3>{ { begin, j, k } } == seed.Begin;
        this->Preparations += isFirst && end == seed.End[0] ? 1 : 0;
      }
      all(begin, end, j, k, to);
    };
    return volume;
  }

  LabelVolume LabelMap() const
  {
    return LabelVolumeOf(ImageView<float>{ this->Labels.data(), this->Geometry }, StartLabelsName,
      {});
  }

  OrganSession Session() const { return { this->Gray(), "it", {} }; }

  OrganRequest Request() const
  {
    OrganRequest request;
    request.Seed = this->Seed;
    request.Settings.Method.Schedule.Resolution = 8;
    request.Settings.Method.Schedule.Levels = 2;
    request.Settings.Method.Schedule.MaximumIterations = 6;
    return request;
  }

  GroupRequest Pair() const
  {
    GroupRequest request;
    request.Settings = this->Request().Settings;
    request.Organs = { { "left", { { ConstraintKind::Seed, { 28, 35, 35 }, 5 } } },
      { "right", { { ConstraintKind::Seed, { 42, 35, 35 }, 5 } } } };
    return request;
  }

  ImageGeometry Geometry = Grid({ { 36, 36, 36 } }, { 2, 2, 2 });
  SeedSphere Seed{ { 35, 35, 35 }, 8 };
  std::vector<float> Voxels;
  std::vector<float> Labels;
  static constexpr double OtherRadius = 7;    // of a seed
  mutable std::atomic<int> Preparations{ 0 }; // how often the volume was read anew
};

GivenSurface GivenSphere(const Eigen::Vector3d& center, double radius)
{
  const DeformableSurface sphere = MakeStartSphere(4, center, radius);
  return { "the given surface", sphere.Points, sphere.Mesh.Faces };
}

OrganAnswer RunOnce(OrganSession& session, const OrganRequest& request)
{
  return session.Segment(request, NeverStop, nullptr);
}

// Stops at the question of that number, counted from 1.
Monitor StopAt(int question)
{
  return [left = question](double) mutable { return --left > 0; };
}

// Calls run(monitor) and returns how often it asked.
template <typename Run>
int QuestionsOf(const Run& run)
{
  int questions = 0;
  run([&questions](double) { return ++questions > 0; });
  return questions;
}

std::vector<int> SomeOf(int questions)
{
  return { 1, questions / 4, questions / 2, 3 * questions / 4, questions };
}

void ExpectSame(const VolumeSegmentation& one, const VolumeSegmentation& other)
{
  EXPECT_EQ(one.Organ.Reason, other.Organ.Reason);
  EXPECT_EQ(one.Organ.Points, other.Organ.Points);
  EXPECT_EQ(one.Organ.Mesh.Faces.Connectivity, other.Organ.Mesh.Faces.Connectivity);
  EXPECT_EQ(one.Organ.Iterations.size(), other.Organ.Iterations.size());
  EXPECT_EQ(one.Organ.Carving.Unanimity, other.Organ.Carving.Unanimity);
  EXPECT_EQ(CountVoxels(one.Voxels), CountVoxels(other.Voxels));
  EXPECT_EQ(one.Confidence.OfSurface, other.Confidence.OfSurface);
  EXPECT_EQ(one.Confidence.OfVertices, other.Confidence.OfVertices);
  EXPECT_EQ(one.Warnings, other.Warnings);
}

template <typename Call>
void ExpectRefusalWith(const std::string& words, const Call& call)
{
  try
  {
    call();
    ADD_FAILURE() << "not refused: " << words;
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

void ExpectRunRefused(const AskedBall& ball, const OrganRequest& request, const std::string& words)
{
  OrganSession session = ball.Session();
  ExpectRefusalWith(words, [&] { RunOnce(session, request); });
}

void ExpectGroupRefused(const AskedBall& ball, const GroupRequest& request,
  const std::string& words)
{
  ExpectRefusalWith(words, [&] { SegmentGroup(ball.Gray(), "it", request, {}, NeverStop); });
}

void ExpectLabelRefused(const AskedBall& ball, const LabelVolume& labels, int label,
  const std::string& words)
{
  OrganSession session = ball.Session();
  session.FillLabel(ball.LabelMap(), 3);
  ExpectRefusalWith(words, [&] { session.FillLabel(labels, label); });
  // The earlier label is none any more.
  OrganRequest request = ball.Request();
  request.Seed.reset();
  ExpectRefusalWith("there is neither a seed nor a label", [&] { RunOnce(session, request); });
}

} // namespace

TEST(OrganRequest, IsCheckedForNumbersGridAndSeed)
{
  AskedBall ball;
  OrganRequest request = ball.Request();
  request.Settings.StartScale = std::numeric_limits<double>::quiet_NaN();
  ExpectRunRefused(ball, request, "the value of StartScale is not a number");
  request = ball.Request();
  request.Seed->Center[1] = 500;
  ExpectRunRefused(ball, request, "lies outside it");
  request = ball.Request();
  request.Seed->Radius = 500;
  ExpectRunRefused(ball, request, "the seed sphere, with a radius of 500 mm, is larger than it");
  request = ball.Request();
  request.Settings.Method.Smoothing.Reach = 0.5 * request.Seed->Radius;
  ExpectRunRefused(ball, request, "less than the seed's radius");
  request.Seed.reset();
  ExpectRunRefused(ball, request, "there is neither a seed nor a label");
  request = ball.Request();
  request.Constraints = { { ConstraintKind::Inside, { 500, 0, 0 }, 0 } };
  ExpectRunRefused(ball, request, "lies outside it");
  request = ball.Request();
  ball.Geometry.Direction.setZero();
  ExpectRunRefused(ball, request, "it has a direction matrix that cannot be inverted");
  ball.Geometry.Dimensions[2] = 0;
  ExpectRunRefused(ball, request, "it has no voxels");
}

TEST(OrganRequest, IsCheckedForTheStartSurface)
{
  const AskedBall ball;
  OrganRequest request = ball.Request();
  request.Settings.Method.Schedule.MaximumIterations = 0;
  request.Settings.Method.Schedule.Levels = 1;
  OrganSession session = ball.Session();
  GivenSurface surface = GivenSphere(ball.Seed.Center, 9);
  session.StartFrom(surface);
  const OrganAnswer answer = RunOnce(session, request);
  EXPECT_EQ(answer.Result.Organ.Points, surface.Points);
  EXPECT_NE(answer.Provenance.find("\"startSurface\":true"), std::string::npos);

  surface.Points.row(0) += Eigen::RowVector3d(0, 0, 40);
  session.StartFrom(surface);
  ExpectRefusalWith("the given surface intersects itself", [&] { RunOnce(session, request); });
  request.Settings.Method.Step.Guard = false;
  EXPECT_EQ(RunOnce(session, request).Result.Organ.Points, surface.Points);
  surface.Points.resize(0, 3);
  session.StartFrom(surface);
  ExpectRefusalWith("the given surface has no points", [&] { RunOnce(session, request); });
}

TEST(OrganRequest, IsCheckedForTheLabel)
{
  AskedBall ball;
  const LabelVolume good = ball.LabelMap();
  ExpectLabelRefused(ball, good, 1,
    "the start labels have no voxels with the value 1; they have 3");
  LabelVolume bad = good;
  bad.Geometry.Dimensions = { { 0, 36, 36 } };
  ExpectLabelRefused(ball, bad, 3, "the start labels have no voxels; give a label map");
  bad = good;
  bad.Geometry.Spacing[0] = 0;
  ExpectLabelRefused(ball, bad, 3, "the start labels has a spacing of (0, 2, 2)");
  bad = good;
  bad.Geometry.Origin[0] = 0.8;
  ExpectLabelRefused(ball, bad, 3,
    "the voxels of the start labels and of it differ by a shift of (0.4, 0, 0) voxels");
  bad.Geometry.Origin[0] = 72;
  ExpectLabelRefused(ball, bad, 3, "it and the start labels do not overlap");
  bad.Geometry.Origin[0] = 60;
  ExpectLabelRefused(ball, bad, 3, "the start labels have the label only outside it");
  ball.Labels[5] = std::numeric_limits<float>::infinity();
  ExpectRefusalWith("is not a finite number",
    [&ball] { ball.Session().FillLabel(ball.LabelMap(), 3); });
}

TEST(OrganRequest, FillsALabelAndGoesBackToTheSeed)
{
  const AskedBall ball;
  OrganSession session = ball.Session();
  OrganRequest request = ball.Request();
  const OrganAnswer seeded = RunOnce(session, request);
  EXPECT_EQ(seeded.Seed.Center, ball.Seed.Center);
  const SeedSphere largest = session.FillLabel(ball.LabelMap(), 0);
  EXPECT_NEAR(largest.Radius, 14, 1); // a voxel less than the label
  request.Seed.reset();
  request.Constraints = { { ConstraintKind::Seed, { 35, 35, 35 }, 14.5 } }; // takes no place of it
  const OrganAnswer filled = RunOnce(session, request);
  EXPECT_EQ(filled.Seed.Radius, largest.Radius);
  EXPECT_NE(filled.Provenance.find("\"startLabels\":{\"name\":\"\",\"label\":0}"),
    std::string::npos);
  EXPECT_NE(filled.Provenance.find("\"radius\":14.5"), std::string::npos);
  EXPECT_NE(filled.Result.Organ.Points.rows(), seeded.Result.Organ.Points.rows());
  const OrganAnswer again = RunOnce(session, ball.Request());
  EXPECT_EQ(again.Result.Organ.Points, seeded.Result.Organ.Points);
  EXPECT_EQ(again.Provenance, seeded.Provenance);
}

TEST(OrganRequest, FillsALabelOfACroppedAndReorderedMapAsOfAWholeOne)
{
  const AskedBall ball;
  OrganSession session = ball.Session();
  OrganRequest request = ball.Request();
  request.Seed.reset();
  const auto fill = [&](const VoxelBox& box)
  {
    const ImageGeometry part = PartOf(ball.Geometry, box, { { 2, 0, 1 } }, { { 1, -1, -1 } });
    const std::vector<float> labels = VoxelsIn(part, ball.Labels, ball.Geometry);
    session.FillLabel(LabelVolumeOf(ImageView<float>{ labels.data(), part }, StartLabelsName, {}),
      3);
    return RunOnce(session, request);
  };
  session.FillLabel(ball.LabelMap(), 3);
  const OrganAnswer whole = RunOnce(session, request);
  const VoxelBox around = { { { 8, 8, 8 } }, { { 30, 28, 29 } } };
  for (const VoxelBox& box : { around, around.Joined({ { { -3, 0, 0 } }, { { 1, 1, 41 } } }) })
  {
    const OrganAnswer answer = fill(box);
    EXPECT_EQ(answer.Result.Organ.Points, whole.Result.Organ.Points);
    EXPECT_EQ(answer.Result.Warnings, whole.Result.Warnings);
    EXPECT_EQ(answer.Provenance, whole.Provenance);
  }
}

TEST(OrganRequest, SaysHowMuchOfALabelLiesOutsideTheVolume)
{
  const AskedBall ball;
  const ImageGeometry wide = PartOf(ball.Geometry, { { { 0, 0, 0 } }, { { 72, 36, 36 } } },
    { { 0, 1, 2 } }, { { 1, 1, 1 } });
  std::vector<float> labels = VoxelsIn(wide, ball.Labels, ball.Geometry);
  const auto inside = static_cast<double>(std::count(labels.begin(), labels.end(), 3));
  const int outside = 400;
  for (int voxel = 0; voxel < outside; ++voxel)
  {
    labels[wide.Offset(40 + voxel % 20, 10 + voxel / 20, 10)] = 3;
  }
  OrganSession session = ball.Session();
  session.FillLabel(LabelVolumeOf(ImageView<float>{ labels.data(), wide }, StartLabelsName, {}), 3);
  OrganRequest request = ball.Request();
  request.Seed.reset();
  const std::vector<std::string> warnings = RunOnce(session, request).Result.Warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.back(),
    PercentOf(outside / (inside + outside)) +
      " of the start labels lie outside it and are left out; give an image that holds the whole "
      "organ.");
}

TEST(OrganRequest, StartsInTheLargestSeed)
{
  const AskedBall ball;
  OrganSession session = ball.Session();
  const OrganRequest plain = ball.Request();
  OrganRequest turned = plain;
  turned.Constraints = { { ConstraintKind::Seed, plain.Seed->Center, plain.Seed->Radius } };
  turned.Seed = SeedSphere{ { 35, 35, 42 }, 3 };
  const OrganAnswer answer = RunOnce(session, turned);
  EXPECT_EQ(answer.Seed.Center, plain.Seed->Center);
  EXPECT_NE(answer.Provenance.find("\"seed\":{\"center\":[35,35,35],\"radius\":8}"),
    std::string::npos);
  EXPECT_NE(answer.Provenance.find("{\"kind\":\"seed\",\"position\":[35,35,42],\"radius\":3}"),
    std::string::npos);
}

TEST(OrganRequest, KeepsWhatPointsDoNotChange)
{
  const AskedBall ball;
  OrganSession session = ball.Session();
  const OrganRequest plain = ball.Request();
  const OrganAnswer free = RunOnce(session, plain);
  EXPECT_EQ(ball.Preparations, 1);
  OrganRequest corrected = plain;
  corrected.Constraints = { { ConstraintKind::Outside, { 35, 35, 46 }, 0 } };
  const OrganAnswer moved = RunOnce(session, corrected);
  EXPECT_NE(moved.Result.Organ.Points, free.Result.Organ.Points);
  EXPECT_EQ(RunOnce(session, plain).Result.Organ.Points, free.Result.Organ.Points);
  EXPECT_EQ(ball.Preparations, 1);
  OrganSession others = ball.Session();
  EXPECT_EQ(RunOnce(others, corrected).Result.Organ.Points, moved.Result.Organ.Points);

  ball.Preparations = 0;
  OrganRequest other = plain;
  other.Settings.Method.Targets.MaximumDisplacement = 0.5;
  EXPECT_NE(RunOnce(session, other).Result.Organ.Points, free.Result.Organ.Points);
  EXPECT_EQ(ball.Preparations, 1);
  other = plain;
  other.Seed->Radius = ball.OtherRadius;
  RunOnce(session, other);
  EXPECT_EQ(ball.Preparations, 2);
  RunOnce(session, other);
  EXPECT_EQ(ball.Preparations, 2);
  session.Release();
  RunOnce(session, other);
  EXPECT_EQ(ball.Preparations, 3);
  session.StartFrom(GivenSphere(ball.Seed.Center, 9));
  RunOnce(session, other);
  EXPECT_EQ(ball.Preparations, 4);
}

TEST(OrganRequest, ShowsIterationsWhoseHistoryIsKept)
{
  const AskedBall ball;
  OrganRequest request = ball.Request();
  for (const bool keeps : { false, true })
  {
    request.Settings.KeepHistory = keeps;
    OrganSession session = ball.Session();
    std::size_t seen = 0;
    const OrganAnswer answer = session.Segment(request, NeverStop,
      [&seen](const ContourMesh&, const PointList&, const CorrespondenceField&,
        const IterationRecord&) { ++seen; });
    EXPECT_EQ(seen, keeps ? answer.Result.Organ.Iterations.size() : 0);
  }
}

TEST(OrganRequest, GivesTheSameAfterAnAbort)
{
  const AskedBall ball;
  const OrganRequest request = ball.Request();
  OrganSession fresh = ball.Session();
  const VolumeSegmentation expected = RunOnce(fresh, request).Result;
  fresh.Release();
  const int questions =
    QuestionsOf([&](const Monitor& monitor) { fresh.Segment(request, monitor, nullptr); });
  ASSERT_GT(questions, 20);
  for (const int stop : SomeOf(questions))
  {
    SCOPED_TRACE(stop);
    OrganSession session = ball.Session();
    const VolumeSegmentation aborted = session.Segment(request, StopAt(stop), nullptr).Result;
    EXPECT_EQ(aborted.Organ.Reason, StopReason::Aborted);
    EXPECT_TRUE(aborted.Voxels.empty());
    ExpectSame(RunOnce(session, request).Result, expected);
  }
}

TEST(OrganRequest, GivesTheSameAfterAnAbortOfACorrection)
{
  const AskedBall ball;
  const OrganRequest plain = ball.Request();
  OrganRequest corrected = plain;
  corrected.Constraints = { { ConstraintKind::Outside, { 35, 35, 46 }, 0 } };
  OrganSession fresh = ball.Session();
  const VolumeSegmentation expected = RunOnce(fresh, corrected).Result;
  OrganSession kept = ball.Session();
  const VolumeSegmentation free = RunOnce(kept, plain).Result;
  const int questions =
    QuestionsOf([&](const Monitor& monitor) { kept.Segment(corrected, monitor, nullptr); });
  ASSERT_GT(questions, 4);
  for (const int stop : SomeOf(questions))
  {
    SCOPED_TRACE(stop);
    OrganSession session = ball.Session();
    RunOnce(session, plain);
    EXPECT_EQ(session.Segment(corrected, StopAt(stop), nullptr).Result.Organ.Reason,
      StopReason::Aborted);
    ExpectSame(RunOnce(session, corrected).Result, expected);
    ExpectSame(RunOnce(session, plain).Result, free);
  }
}

TEST(GroupRequest, IsChecked)
{
  const AskedBall ball;
  GroupRequest request = ball.Pair();
  request.Settings.Method.Step.Energy.Fairing = std::numeric_limits<double>::infinity();
  ExpectGroupRefused(ball, request, "the value of Fairing is infinite");
  request = ball.Pair();
  request.Settings.LabelValue = 255;
  ExpectGroupRefused(ball, request, "labels go up to 255, which leaves none for 'right'");
  request.Settings.LabelValue = 254;
  request.Organs.back().Constraints.front().Kind = ConstraintKind::Inside;
  ExpectGroupRefused(ball, request, "'right' has no seed");
  request = ball.Pair();
  request.Settings.Method.Smoothing.Reach = 0.5 * request.Organs.front().Constraints.front().Radius;
  ExpectGroupRefused(ball, request, "less than the seed's radius");
  ExpectGroupRefused(ball, request, "or lower its radius");
  request = ball.Pair();
  request.Organs.front().Constraints.front().Radius = 500;
  ExpectGroupRefused(ball, request, "mm long; lower its radius so that");
  request = ball.Pair();
  request.Fixed = { GivenSphere({ 35, 35, 60 }, 4) };
  request.Fixed.front().Points.row(0) += Eigen::RowVector3d(0, 0, 40);
  ExpectGroupRefused(ball, request, "the given surface intersects itself");
  request.Fixed = { GivenSphere({ 42, 35, 35 }, 4) };
  ExpectGroupRefused(ball, request, "meets the given surface");
  AskedBall empty;
  empty.Geometry.Dimensions[0] = 0;
  ExpectGroupRefused(empty, ball.Pair(), "it has no voxels");
}

TEST(GroupRequest, IsThatOfTheGroup)
{
  const AskedBall ball;
  GroupRequest request = ball.Pair();
  request.Organs.front().Constraints.push_back({ ConstraintKind::Inside, { 28, 41, 35 }, 0 });
  request.Organs.back().Constraints.push_back({ ConstraintKind::Seed, { 42, 42, 35 }, 6 });
  request.Fixed = { GivenSphere({ 35, 35, 62 }, 4) };
  const GroupAnswer answer = SegmentGroup(ball.Gray(), "it", request, {}, NeverStop);
  const DeformableSurface fixed = MakeStartSurface(request.Fixed.front(), true, SerialFor);
  OrganGroup group(ball.Gray(), "it",
    { { "left", { { 28, 35, 35 }, 5 } }, { "right", { { 42, 42, 35 }, 6 } } },
    { { "the given surface", fixed } }, request.Settings, {});
  const std::vector<VolumeSegmentation> expected =
    group.Segment({ { { ConstraintKind::Inside, { 28, 41, 35 }, 0 } },
                    { { ConstraintKind::Seed, { 42, 35, 35 }, 5 } } },
      NeverStop,
      [](std::size_t, const ContourMesh&, const PointList&, const CorrespondenceField&,
        const IterationRecord&) {});
  ASSERT_EQ(answer.Results.size(), 2U);
  EXPECT_EQ(answer.Results[0].Organ.Points, expected[0].Organ.Points);
  EXPECT_EQ(answer.Results[1].Organ.Points, expected[1].Organ.Points);
  for (const char* words : { "\"name\":\"left\"", "\"name\":\"right\"",
         "\"seed\":{\"center\":[42,42,35],\"radius\":6}", "\"fixed\":[\"\"]" })
  {
    EXPECT_NE(answer.Provenance.find(words), std::string::npos) << words;
  }
}

// Whenever it is aborted, nothing of it is taken for a result.
TEST(GroupRequest, AnAbortLeavesNoVoxels)
{
  const AskedBall ball;
  const GroupRequest request = ball.Pair();
  const auto segment = [&](const Monitor& monitor)
  { return SegmentGroup(ball.Gray(), "it", request, {}, monitor); };
  const int questions = QuestionsOf(segment);
  ASSERT_GT(questions, 20);
  for (const int stop : SomeOf(questions))
  {
    SCOPED_TRACE(stop);
    for (const VolumeSegmentation& aborted : segment(StopAt(stop)).Results)
    {
      EXPECT_EQ(aborted.Organ.Reason, StopReason::Aborted);
      EXPECT_TRUE(aborted.Voxels.empty());
    }
  }
}
