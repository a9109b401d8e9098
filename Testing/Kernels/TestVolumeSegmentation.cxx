// The whole method on a small phantom, and the scores of its result.
#include "Deformation/VolumeSegmentation.h"
#include "Measures/SegmentationScores.h"
#include "Phantom/PhantomVolume.h"

#include "ExampleSurfaces.h"
#include "GridParts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace FlipFree;

namespace
{

struct Volume
{
  ImageGeometry Geometry;
  std::vector<std::int16_t> Intensities;
  std::vector<std::uint8_t> Labels;
  SeedSphere Seed;

  Volume()
  {
    PhantomSettings settings;
    settings.Dimensions = { { 48, 48, 48 } };
    settings.Spacing = { 2, 2, 2 };
    this->Geometry = GridOf(settings);
    const Phantom phantom = PhantomOf(settings, this->Geometry);
    this->Intensities.resize(this->Geometry.NumberOfVoxels());
    this->Labels.resize(this->Geometry.NumberOfVoxels());
    SampleTissues(phantom.Tissues, this->Geometry, SamplingOf(settings), this->Intensities.data(),
      this->Labels.data());
    const Ball& start = phantom.Seeds.front().Start;
    this->Seed = { GridToPhysical(this->Geometry, start.Center), start.Radius };
  }

  GrayVolume Gray() const
  {
    return GrayVolumeOf(ImageView<std::int16_t>{ this->Intensities.data(), this->Geometry });
  }
  LabelVolume References() const
  {
    return LabelVolumeOf(ImageView<std::uint8_t>{ this->Labels.data(), this->Geometry },
      "the reference", {});
  }
  LabelMask Reference(int label) const
  {
    return LabelMaskOf(this->References(), label, "ReferenceLabel");
  }
};

VolumeSegmentationSettings Coarse()
{
  VolumeSegmentationSettings settings;
  settings.Method.Schedule.Resolution = 16;
  return settings;
}

VolumeSegmentation SegmentIt(const Volume& volume, const GrayVolume& gray,
  const VolumeSegmentationSettings& settings, const Monitor& monitor = NeverStop,
  const DeformableSurface* start = nullptr)
{
  return VolumeSegmenter(gray, "it", volume.Seed, start, settings, {})
    .Segment({}, monitor,
      [](const ContourMesh&, const PointList&, const CorrespondenceField&, const IterationRecord&) {
      });
}

template <typename Call>
std::string MessageOf(const Call& call)
{
  try
  {
    call();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(VolumeSegmentation, FindsABall)
{
  const Volume volume;
  const VolumeSegmentation result = SegmentIt(volume, volume.Gray(), Coarse());
  EXPECT_EQ(result.Organ.SelfIntersections, 0);
  EXPECT_TRUE(result.Warnings.empty());
  const SegmentationScores scores = ScoreSurface(result.Organ.Points, result.Organ.Mesh.Triangles,
    volume.Reference(1), {}, SerialFor, NeverStop);
  EXPECT_TRUE(scores.Complete);
  EXPECT_GT(scores.Dice, 0.97);
  EXPECT_LT(scores.ASD, 1);
  EXPECT_EQ(scores.DistanceOf, "mesh");
  EXPECT_NEAR(scores.SegmentationVolume, 8e-3 * CountVoxels(result.Voxels), 1e-9);
}

// With carving. Without, as published, the whole sphere is the model.
TEST(VolumeSegmentation, FindsABallFromASphereThatIsTooLarge)
{
  const Volume volume;
  const auto diceOf = [&volume](double factor, bool carving)
  {
    Volume larger = volume;
    larger.Seed.Radius *= factor;
    VolumeSegmentationSettings settings = Coarse();
    settings.Method.Feature.Carving = carving;
    const OrganSurface organ = SegmentIt(larger, larger.Gray(), settings).Organ;
    return ScoreSurface(organ.Points, organ.Mesh.Triangles, volume.Reference(1), {}, SerialFor,
      NeverStop)
      .Dice;
  };
  EXPECT_GT(diceOf(1.5, true), 0.98);
  EXPECT_GT(diceOf(2, true), 0.98);
  EXPECT_LT(diceOf(2, false), 0.9);
}

TEST(VolumeSegmentation, StopsAndStartsWhereItIsTold)
{
  const Volume volume;
  int asked = 0;
  const VolumeSegmentation stopped =
    SegmentIt(volume, volume.Gray(), Coarse(), [&asked](double) { return ++asked < 30; });
  EXPECT_EQ(stopped.Organ.Reason, StopReason::Aborted);
  EXPECT_TRUE(stopped.Voxels.empty());
  VolumeSegmentationSettings settings = Coarse();
  settings.Method.Schedule.Levels = 1;
  settings.Method.Schedule.MaximumIterations = 0;
  const DeformableSurface start = MakeStartSphere(5, volume.Seed.Center, 11);
  EXPECT_EQ(SegmentIt(volume, volume.Gray(), settings, NeverStop, &start).Organ.Points,
    start.Points);
  settings.StartScale = 0.5;
  settings.StartCenterOffset = { 3, 0, 0 };
  const PointList points = SegmentIt(volume, volume.Gray(), settings).Organ.Points;
  EXPECT_NEAR((points.row(7).transpose() - volume.Seed.Center - Eigen::Vector3d(3, 0, 0)).norm(),
    volume.Seed.Radius / 2, 1e-9);
}

TEST(VolumeSegmentation, RefinesAGivenSurfaceToTheSpheresVertices)
{
  const Volume volume;
  VolumeSegmentationSettings settings = Coarse();
  settings.Method.Schedule.MaximumIterations = 1;
  for (const int first : { 4, 16 })
  {
    const DeformableSurface start = MakeStartSphere(first, volume.Seed.Center, 11);
    const OrganSurface organ = SegmentIt(volume, volume.Gray(), settings, NeverStop, &start).Organ;
    EXPECT_EQ(organ.Mesh.NumberOfPoints(), 6 * 16 * 16) << first;
  }
}

TEST(VolumeSegmentation, RefusesWhatItCannotWorkWith)
{
  Volume volume;
  volume.Seed.Center[0] = 500;
  EXPECT_NE(MessageOf([&] { SegmentIt(volume, volume.Gray(), Coarse()); }).find("lies outside it"),
    std::string::npos);
}

TEST(StartSurface, MustBeEmbedded)
{
  const DeformableSurface sphere = MakeStartSphere(4, { 0, 0, 0 }, 10);
  GivenSurface given{ "it", sphere.Points, sphere.Mesh.Faces };
  EXPECT_EQ(MakeStartSurface(given, true, SerialFor).Points, sphere.Points);
  given.Points.row(0) *= -3;
  EXPECT_NE(
    MessageOf([&] { MakeStartSurface(given, true, SerialFor); }).find("it intersects itself in"),
    std::string::npos);
  EXPECT_EQ(MakeStartSurface(given, false, SerialFor).Points, given.Points);
  given.Points.resize(0, 3);
  EXPECT_EQ(MessageOf([&] { MakeStartSurface(given, false, SerialFor); }),
    "it has no points; give one that has");
}

TEST(SegmentationScores, OfAMaskAgainstItselfArePerfect)
{
  const Volume volume;
  const LabelMask reference = volume.Reference(1);
  const SegmentationScores scores = ScoreLabels(reference, reference, {}, SerialFor, NeverStop);
  EXPECT_EQ(scores.Dice, 1);
  EXPECT_EQ(scores.Jaccard, 1);
  EXPECT_NEAR(scores.ASD, 0, 1e-12);
  EXPECT_NEAR(scores.HD, 0, 1e-12);
  EXPECT_EQ(scores.OverlapOf, "label map");
  EXPECT_TRUE(scores.Warnings.empty());
}

TEST(SegmentationScores, AreOfLabelMapsWithVoxelsOnAGrid)
{
  const Volume volume;
  LabelVolume labels = volume.References();
  labels.Geometry.Spacing[1] = -1;
  EXPECT_NE(
    MessageOf([&] { LabelMaskOf(labels, -1, "it"); }).find("the reference has a spacing of"),
    std::string::npos);
  labels.Geometry.Dimensions[0] = 0;
  EXPECT_EQ(MessageOf([&] { LabelMaskOf(labels, -1, "it"); }),
    "the reference has no voxels; give a label map");
}

TEST(SegmentationScores, SayWhichLabelsThereAre)
{
  Volume volume;
  EXPECT_EQ(MessageOf([&] { volume.Reference(9); }),
    "the reference is empty: no voxel has the label 9; set ReferenceLabel to one of 1");
  volume.Labels.front() = 5;
  const SegmentationScores scores =
    ScoreLabels(volume.Reference(1), volume.Reference(-1), {}, SerialFor, NeverStop);
  ASSERT_EQ(scores.Warnings.size(), 1U);
  EXPECT_EQ(scores.Warnings[0].find("The reference has the labels 1, 5;"), 0U);
}

// Of label maps on parts of one lattice, the scores are those on a grid that holds both.
TEST(SegmentationScores, AreThoseOfAllVoxelsWhateverTheGridsHold)
{
  Volume volume;
  const ImageGeometry& whole = volume.Geometry;
  std::vector<std::uint8_t> moved = volume.Labels;
  std::rotate(moved.begin(), moved.begin() + 3, moved.end());
  const auto maskIn = [&](const std::vector<std::uint8_t>& labels, const ImageGeometry& part,
                        std::vector<std::uint8_t>& kept, const std::string& name)
  {
    kept = VoxelsIn(part, labels, whole);
    return LabelMaskOf(LabelVolumeOf(ImageView<std::uint8_t>{ kept.data(), part }, name, {}), 1,
      "Label");
  };
  const auto scoresOf = [&](const ImageGeometry& ofSegmentation, const ImageGeometry& ofReference)
  {
    std::vector<std::uint8_t> one;
    std::vector<std::uint8_t> other;
    return ScoreLabels(maskIn(moved, ofSegmentation, one, "the segmentation"),
      maskIn(volume.Labels, ofReference, other, "the reference"), {}, SerialFor, NeverStop);
  };
  const auto expectSame = [](const SegmentationScores& one, const SegmentationScores& other)
  {
    EXPECT_EQ(one.Dice, other.Dice);
    EXPECT_NEAR(one.SegmentationVolume, other.SegmentationVolume, 1e-9);
    EXPECT_NEAR(one.ReferenceVolume, other.ReferenceVolume, 1e-9);
    EXPECT_NEAR(one.ASD, other.ASD, 1e-4); // triangles are cut otherwise
    EXPECT_NEAR(one.HD, other.HD, 1e-9);
  };
  const SegmentationScores all = scoresOf(whole, whole);
  EXPECT_GT(all.Dice, 0.5);
  EXPECT_LT(all.Dice, 0.95);
  const VoxelBox ball = volume.Reference(1).Mask.Bounds();
  const ImageGeometry tight = PartOf(whole, ball, { { 1, 2, 0 } }, { { -1, 1, -1 } });
  const ImageGeometry turned = PartOf(whole, WholeBox(whole), { { 0, 2, 1 } }, { { 1, -1, 1 } });
  expectSame(scoresOf(whole, turned), all);
  expectSame(scoresOf(turned, whole), all);
  EXPECT_TRUE(scoresOf(turned, whole).Warnings.empty());
  // The reference's box does not hold all of the segmentation, nor the other way round.
  const SegmentationScores cropped = scoresOf(turned, tight);
  expectSame(cropped, all);
  ASSERT_EQ(cropped.Warnings.size(), 1U);
  EXPECT_NE(cropped.Warnings[0].find(
              " of the voxels of the segmentation lie outside the grid of the reference, and count "
              "as wrong."),
    std::string::npos);
  // What the segmentation's grid has lost is missed.
  VoxelBox half = WholeBox(whole);
  half.Begin[2] = (ball.Begin[2] + ball.End[2]) / 2;
  const SegmentationScores lost =
    scoresOf(PartOf(whole, half, { { 0, 1, 2 } }, { { 1, 1, 1 } }), whole);
  EXPECT_NEAR(lost.ReferenceVolume, all.ReferenceVolume, 1e-9);
  EXPECT_LT(lost.Dice, 0.7);
  ASSERT_EQ(lost.Warnings.size(), 1U);
  EXPECT_EQ(lost.Warnings[0].find("50 % of the voxels of the reference lie outside the grid of the "
                                  "segmentation, and count as missed."),
    0U)
    << lost.Warnings[0];
}

TEST(SegmentationScores, OfASurfaceAreThoseOfAllVoxelsWhateverTheReferenceHolds)
{
  const Volume volume;
  const DeformableSurface ball = MakeStartSphere(16, { 32, 48, 48 }, 20);
  const auto scoresIn = [&](const ImageGeometry& part)
  {
    const std::vector<std::uint8_t> labels = VoxelsIn(part, volume.Labels, volume.Geometry);
    const LabelVolume map =
      LabelVolumeOf(ImageView<std::uint8_t>{ labels.data(), part }, "the reference", {});
    return ScoreSurface(ball.Points, ball.Mesh.Triangles, LabelMaskOf(map, 1, "ReferenceLabel"), {},
      SerialFor, NeverStop);
  };
  const SegmentationScores all = scoresIn(volume.Geometry);
  EXPECT_TRUE(all.Warnings.empty());
  const VoxelBox box = volume.Reference(1).Mask.Bounds();
  const SegmentationScores cropped =
    scoresIn(PartOf(volume.Geometry, box, { { 2, 1, 0 } }, { { 1, -1, 1 } }));
  EXPECT_NEAR(cropped.SegmentationVolume, all.SegmentationVolume, 1e-9);
  EXPECT_NEAR(cropped.ReferenceVolume, all.ReferenceVolume, 1e-9);
  EXPECT_EQ(cropped.Dice, all.Dice);
  EXPECT_EQ(cropped.Warnings.size(), 1U);
  // In other units.
  const DeformableSurface large = MakeStartSphere(16, { 48, 48, 48 }, 2e5);
  EXPECT_NE(ErrorOf(
              [&]
              {
                ScoreSurface(large.Points, large.Mesh.Triangles, volume.Reference(1), {}, SerialFor,
                  NeverStop);
              })
              .find("the segmentation reaches too far beyond the reference"),
    std::string::npos);
}

TEST(SegmentationScores, SayHowMuchOfASurfaceLiesOutsideTheReference)
{
  const Volume volume; // ends at 95 mm
  const auto warningsOf = [&](double x)
  {
    const DeformableSurface ball = MakeStartSphere(16, { x, 48, 48 }, 11);
    return ScoreSurface(ball.Points, ball.Mesh.Triangles, volume.Reference(1), {}, SerialFor,
      NeverStop)
      .Warnings;
  };
  EXPECT_TRUE(warningsOf(85).empty()); // less than a voxel
  ASSERT_EQ(warningsOf(97).size(), 1U);
  EXPECT_EQ(
    warningsOf(97)[0].find("About 50 % of the segmentation's surface lies outside the reference, "),
    0U)
    << warningsOf(97)[0];
  ASSERT_EQ(warningsOf(86.05).size(), 1U);
  EXPECT_EQ(warningsOf(86.05)[0].find("About 1 % of the segmentation's surface"), 0U);
}

TEST(PhantomVolume, RefusesIntensitiesThatDoNotFit)
{
  PhantomSettings settings;
  settings.Foreground = 40000;
  EXPECT_NE(MessageOf([&] { PhantomOf(settings, GridOf(settings)); }).find("-32768 to 32767"),
    std::string::npos);
  settings.Shape = AbdomenShape;
  EXPECT_EQ(GridOf(settings).Dimensions, (std::array<int, 3>{ { 220, 170, 90 } }));
  EXPECT_FALSE(PhantomOf(settings, GridOf(settings)).Seeds.empty());
}
