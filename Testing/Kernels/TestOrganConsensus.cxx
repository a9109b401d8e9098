// Further opinions about doubtful organs, and what they are made of, on phantoms.
#include "Evidence/BoundarySupport.h"
#include "Evidence/CarvedForeground.h"
#include "Evidence/OrganCandidate.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/OrganConsensus.h"
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Intensity/IntensityField.h"
#include "Mesh/SurfaceVoxelization.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

const Eigen::Vector3d Center(35, 35, 36);

BitMask BallMask(const ImageGeometry& geometry, double radius)
{
  BitMask mask(geometry);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - Center).norm() < radius)
      {
        mask.Insert(i, j, k);
      }
    });
  return mask;
}

// An organ of 100 in surroundings of 20, with noise.
struct Organ
{
  ImageGeometry Geometry = Grid({ { 70, 70, 36 } }, { 1, 1, 2 });
  SeedSphere Seed{ Center, 8 };
  BitMask Mask = BallMask(this->Geometry, 20);
  double Noise = 4;
  OrganFeatureSettings Settings;

  Organ() { this->Settings.Modality = Modality::MR; }

  FloatImage Image(float scale = 1) const
  {
    FloatImage image{ this->Geometry, {} };
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, this->Noise);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const double value = (this->Mask(i, j, k) ? 100 : 20) + normal(random);
        image.Voxels.push_back(scale * static_cast<float>(value));
      });
    return image;
  }

  BitMask Consensus(const BitMask& carved, float scale = 1,
    const ParallelFor& parallelFor = SerialFor) const
  {
    const FloatImage image = this->Image(scale);
    BitMask mask = carved;
    FurtherOpinions opinions;
    EXPECT_TRUE(SeekConsensus(image.View(), this->Seed, scale * this->Noise, this->Settings,
      parallelFor, NeverStop, mask, opinions));
    return mask;
  }
};

// The ball without what lies beyond a plane.
BitMask CutOff(const Organ& organ, int first)
{
  BitMask mask = organ.Mask;
  for (int k = 0; k < organ.Geometry.Dimensions[2]; ++k)
  {
    for (int j = 0; j < organ.Geometry.Dimensions[1]; ++j)
    {
      mask.RemoveRun(first, organ.Geometry.Dimensions[0], j, k);
    }
  }
  return mask;
}

// A tenth of the organ's voxels are bright vessels.
FloatImage Drifting(const Organ& organ, const std::function<double(const Eigen::Vector3d&)>& value)
{
  FloatImage image = organ.Image();
  std::mt19937 random(2);
  std::bernoulli_distribution isVessel(0.1);
  ForEachVoxel(organ.Geometry,
    [&](int i, int j, int k)
    {
      if (organ.Mask(i, j, k))
      {
        const Eigen::Vector3d away = organ.Geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - Center;
        image.Voxels[organ.Geometry.Offset(i, j, k)] =
          static_cast<float>(isVessel(random) ? 250 : value(away));
      }
    });
  return image;
}

// How far the voxels of the organ that are no vessels are from 100.
double WorstOf(const Organ& organ, const FloatImage& image, const FloatImage& before)
{
  double worst = 0;
  organ.Mask.ForEach(
    [&](std::size_t voxel)
    {
      if (before.Voxels[voxel] != 250)
      {
        worst = std::max(worst, std::abs(image.Voxels[voxel] - 100.0));
      }
    });
  return worst;
}

} // namespace

TEST(IntensityField, DividesTheCoilsFieldOut)
{
  const Organ organ;
  const FloatImage image = Drifting(organ,
    [](const Eigen::Vector3d& away)
    { return 100 * (1 - 0.01 * away.x() + 0.0002 * away.y() * away.y()); });
  EXPECT_GT(WorstOf(organ, image, image), 15);
  const std::optional<IntensityField> field =
    IntensityField::Fit(image.View(), organ.Mask, organ.Seed, Modality::MR);
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->At(Center), 100, 2);
  FloatImage flat = image;
  field->Flatten(flat.Geometry, SerialFor, flat.Voxels.data());
  EXPECT_LT(WorstOf(organ, flat, image), 5);
  FloatImage other = image;
  field->Flatten(other.Geometry, ScatteredFor, other.Voxels.data());
  EXPECT_EQ(other.Voxels, flat.Voxels);
}

TEST(IntensityField, SubtractsShadingByALimitedAmount)
{
  const Organ organ;
  const FloatImage image =
    Drifting(organ, [](const Eigen::Vector3d& away) { return 100 + 0.8 * away.z(); });
  const std::optional<IntensityField> field =
    IntensityField::Fit(image.View(), organ.Mask, organ.Seed, Modality::CT);
  ASSERT_TRUE(field);
  FloatImage flat = image;
  field->Flatten(flat.Geometry, SerialFor, flat.Voxels.data());
  EXPECT_LT(WorstOf(organ, flat, image), 5);
  for (std::size_t voxel = 0; voxel < flat.Voxels.size(); ++voxel)
  {
    ASSERT_LE(std::abs(flat.Voxels[voxel] - image.Voxels[voxel]), 60.001);
  }
}

TEST(IntensityField, IsTheSameInARotatedFrame)
{
  const Organ organ;
  FloatImage image = Drifting(organ,
    [](const Eigen::Vector3d& away)
    { return 100 * (1 + 0.01 * away.z() + 0.0004 * away.x() * away.y()); });
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  const auto field = IntensityField::Fit(image.View(), organ.Mask, organ.Seed, Modality::CT);
  image.Geometry.Origin = turn * image.Geometry.Origin;
  image.Geometry.Direction = turn * image.Geometry.Direction;
  const SeedSphere seed{ turn * organ.Seed.Center, organ.Seed.Radius };
  const auto turned = IntensityField::Fit(image.View(), organ.Mask, seed, Modality::CT);
  ASSERT_TRUE(field && turned);
  for (const Eigen::Vector3d& away :
    { Eigen::Vector3d(15, 15, 0), Eigen::Vector3d(-15, 15, 0), Eigen::Vector3d(9, -4, 14) })
  {
    EXPECT_NEAR(turned->At(turn * (Center + away)), field->At(Center + away), 1e-6);
  }
}

TEST(IntensityField, NeedsVoxelsAroundTheSeed)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  EXPECT_FALSE(
    IntensityField::Fit(image.View(), BallMask(organ.Geometry, 3), organ.Seed, Modality::MR));
  EXPECT_FALSE(IntensityField::Fit(image.View(), organ.Mask,
    { Center + Eigen::Vector3d(60, 0, 0), 3 }, Modality::MR));
}

TEST(BoundarySupport, IsGreatestForTheOrgan)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  const double right = BoundarySupport(image.View(), organ.Mask, 0.1);
  EXPECT_GT(right, 1.5 * BoundarySupport(image.View(), BallMask(organ.Geometry, 28), 0.1));
  EXPECT_GT(right, 1.5 * BoundarySupport(image.View(), BallMask(organ.Geometry, 12), 0.1));
  EXPECT_GT(right, 1.5 * BoundarySupport(image.View(), CutOff(organ, 36), 0.1));
  const FloatImage scaled = organ.Image(37);
  EXPECT_NEAR(BoundarySupport(scaled.View(), organ.Mask, 3.7), 37 * right, 1e-3 * right);
  EXPECT_EQ(BoundarySupport(image.View(), BitMask(organ.Geometry), 0.1), 0);
}

TEST(OrganConsensus, DoubtsWhatCarvingChanged)
{
  const Organ organ;
  EXPECT_FALSE(IsDoubtful(organ.Mask, organ.Mask));
  EXPECT_FALSE(IsDoubtful(BallMask(organ.Geometry, 20.5), organ.Mask));
  EXPECT_TRUE(IsDoubtful(BallMask(organ.Geometry, 24), organ.Mask));
  EXPECT_TRUE(IsDoubtful(BitMask(organ.Geometry), organ.Mask));
}

TEST(OrganConsensus, LeavesARightForegroundAsItIs)
{
  const Organ organ;
  EXPECT_GT(Dice(organ.Consensus(organ.Mask), organ.Mask), 0.98);
}

TEST(OrganConsensus, RestoresWhatCarvingTookAway)
{
  const Organ organ;
  const BitMask carved = CutOff(organ, 42);
  EXPECT_LT(Dice(carved, organ.Mask), 0.9);
  const BitMask consensus = organ.Consensus(carved);
  EXPECT_GT(Dice(consensus, organ.Mask), 0.97);
  EXPECT_EQ(organ.Consensus(carved, 1, ScatteredFor), consensus);
  EXPECT_GT(Dice(organ.Consensus(carved, 37), consensus), 0.999);
}

TEST(OrganConsensus, IsNotUnanimousWhereItRestores)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  const BitMask carved = CutOff(organ, 42);
  BitMask mask = carved;
  FurtherOpinions opinions;
  ASSERT_TRUE(SeekConsensus(image.View(), organ.Seed, organ.Noise, organ.Settings, SerialFor,
    NeverStop, mask, opinions));
  EXPECT_GT(opinions.Unanimity, 0.5);
  EXPECT_LT(opinions.Unanimity, 0.95);
  ASSERT_GE(opinions.Carved.size(), 2U);
  EXPECT_EQ(opinions.Carved.front(), carved);
  EXPECT_EQ(opinions.Carved[1], mask);
  for (const BitMask& opinion : opinions.Carved)
  {
    EXPECT_EQ(opinion.GetGeometry().Dimensions, mask.GetGeometry().Dimensions);
  }
  EXPECT_GT(opinions.Considered.Count(), carved.Count());
}

TEST(OrganConsensus, StartsAnewWhereAllHasLeaked)
{
  const Organ organ;
  const BitMask leaked = BallMask(organ.Geometry, 30);
  EXPECT_LT(Dice(leaked, organ.Mask), 0.5);
  EXPECT_GT(Dice(organ.Consensus(leaked), organ.Mask), 0.95);
}

TEST(OrganConsensus, StopsAtOnce)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  const BitMask carved = CutOff(organ, 42);
  for (int allowed = 0; allowed < 60; allowed += 4)
  {
    int asked = 0;
    const Monitor monitor = [&](double) { return ++asked <= allowed; };
    BitMask mask = carved;
    FurtherOpinions opinions;
    if (SeekConsensus(image.View(), organ.Seed, organ.Noise, organ.Settings, SerialFor, monitor,
          mask, opinions))
    {
      EXPECT_LE(asked, allowed);
      continue;
    }
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_EQ(mask, carved);
  }
}

namespace
{

// The image and the surface must outlive what is returned.
CarvedForegroundInputs InputsOf(const Organ& organ, const FloatImage& image, const Surface& surface)
{
  CarvedForegroundInputs inputs;
  inputs.Smooth = image.View();
  inputs.EnsureSmoothed = [](const VoxelBox&) { return true; };
  inputs.Points = &surface.Points;
  inputs.Triangles = &surface.Triangles;
  inputs.Seed = organ.Seed;
  inputs.Noise = organ.Noise;
  inputs.Settings = organ.Settings;
  inputs.Settings.Modality = Modality::MR;
  return inputs;
}

} // namespace

// Which boxes are made tells whether further opinions were sought.
TEST(CarvedForeground, IsCarvedAndIfInDoubtVotedOn)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  for (const double radius : { 20.5, 25.0 })
  {
    SCOPED_TRACE(radius);
    const Surface surface = Sphere(16, Center, radius);
    BitMask inside(organ.Geometry);
    inside.InsertRuns(VoxelizeSurface(surface.Points, surface.Triangles, organ.Geometry));
    BitMask expected;
    FurtherOpinions opinions;
    std::vector<DoubtfulPart> doubts;
    ASSERT_TRUE(CarveOrgan(image.View(), inside, &inside, organ.Seed, organ.Noise, Modality::MR,
      SerialFor, NeverStop, expected, &doubts));
    std::vector<VoxelBox> boxes{ CarvingBox(inside, organ.Seed) };
    const bool doubtful = IsDoubtful(inside, expected);
    EXPECT_EQ(doubtful, radius > 21);
    CarvedForegroundInputs inputs = InputsOf(organ, image, surface);
    for (const bool seeks : { false, true })
    {
      inputs.Settings.Consensus = seeks;
      if (seeks && doubtful)
      {
        boxes.push_back(ConsensusBox(expected, organ.Seed));
        ASSERT_TRUE(SeekConsensus(image.View(), organ.Seed, organ.Noise, inputs.Settings, SerialFor,
          NeverStop, expected, opinions));
      }
      std::vector<VoxelBox> made;
      inputs.EnsureSmoothed = [&made](const VoxelBox& box)
      {
        made.push_back(box);
        return true;
      };
      CarvedForeground carved;
      ASSERT_TRUE(CarveForeground(inputs, SerialFor, NeverStop, carved));
      EXPECT_EQ(carved.Mask, expected);
      EXPECT_EQ(carved.Report.Unanimity, opinions.Unanimity);
      EXPECT_EQ(carved.Report.Doubts.size(), doubts.size());
      EXPECT_EQ(carved.Opinions.empty(), !seeks);
      EXPECT_TRUE(!seeks || carved.Opinions.back() == inside);
      EXPECT_TRUE(made == boxes);
    }
  }
}

// A surface that has stopped before a neck: the lobe behind it is reached by voxels, in CT.
TEST(OrganCandidate, HoldsWhatTheSurfaceHasNotReached)
{
  Organ organ;
  const Eigen::Vector3d lobe(57, 35, 36);
  ForEachVoxel(organ.Geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d point = organ.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      if ((point - lobe).norm() < 8)
      {
        organ.Mask.Insert(i, j, k);
      }
    });
  const FloatImage image = organ.Image();
  const BitMask inside = BallMask(organ.Geometry, 20);
  const auto candidate = [&](const OrganFeatureSettings& settings, double growth)
  {
    BitMask mask = inside;
    OrganCandidateSettings limits;
    limits.GreatestGrowth = growth;
    EXPECT_TRUE(AddForeground(
      image.View(), [](const VoxelBox&) { return true; }, organ.Seed, organ.Noise, settings, limits,
      SerialFor, NeverStop, mask));
    return mask;
  };
  OrganFeatureSettings settings = organ.Settings;
  EXPECT_EQ(candidate(settings, 1.2), inside); // in MR
  settings.Modality = Modality::CT;
  EXPECT_GT(Dice(candidate(settings, 1.2), organ.Mask), 0.98);
  EXPECT_EQ(candidate(settings, 1.02), inside); // as if it had leaked
  settings.ReestimateIntensities = false;
  EXPECT_EQ(candidate(settings, 1.2), inside);
}

TEST(CarvedForeground, StopsAtOnce)
{
  const Organ organ;
  const FloatImage image = organ.Image();
  const Surface surface = Sphere(16, Center, 25);
  CarvedForegroundInputs inputs = InputsOf(organ, image, surface);
  const auto stops = [&inputs](const Monitor& monitor)
  {
    CarvedForeground carved;
    return !CarveForeground(inputs, SerialFor, monitor, carved);
  };
  for (int allowed = 0; allowed < 24; allowed += 4)
  {
    int asked = 0;
    EXPECT_TRUE(stops([&](double) { return ++asked <= allowed; })) << allowed;
    EXPECT_EQ(asked, allowed + 1);
  }
  int boxes = 0;
  inputs.EnsureSmoothed = [&boxes](const VoxelBox&) { return ++boxes < 2; };
  EXPECT_TRUE(stops(NeverStop));
  EXPECT_EQ(boxes, 2);
}
