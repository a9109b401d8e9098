#include "Evidence/PointWorth.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// What a voxel is worth, per mm3, that looks like the point's ball or like the organ (inside), or
// more like the ball than like the organ (outside).
constexpr double InsideGain = 0.3;
constexpr double OutsideGain = 0.1;
// And what it loses for each reach that it is farther away than the reach, by the point's distance
// from its side.
constexpr double DecayOfDeepPoint = 0.1;
constexpr double DeepAway = 10;
constexpr double DecayOfNearPoint = 0.3;
constexpr double NearAway = 4;
// How far around the point the image is looked at, in millimeters.
constexpr double GreatestReachInside = 40;
constexpr double GreatestReachOutside = 20;
constexpr double LeastReach = 3;
// Of the reach: what changes in any case.
constexpr double CertainPart = 0.8;

// The ball whose gray values stand for the point's surroundings, in reaches and millimeters.
constexpr double BallPart = 0.7;
constexpr double LeastBall = 2;
constexpr double GreatestBall = 8;
// It counts as at most this many times as varied as the seed: one that reaches across the boundary
// holds gray values of both sides, and would look like either.
constexpr double VarietyInSeedSpreads = 1.5;

// What looks like the organ around an inside point is the organ's for this part of the way to it.
constexpr double PartOfWayToOrgan = 0.6;

// How many reaches farther away than the reach.
double Beyond(double away, double reach)
{
  return std::max(0.0, (away - reach) / std::max(1.0, reach));
}

} // namespace

PointWorth::PointWorth(const ImagePart& image, const ImageGeometry& voxels,
  const PointCorrection& correction, const GrayValueSimilarity& similarity,
  const OrganGrayValues& organ)
  : Wanted(correction)
  , Similarity(similarity)
  , Organ(organ)
{
  const double away = correction.Away;
  const double limit =
    std::min(away, correction.IsInside ? GreatestReachInside : GreatestReachOutside);
  this->Reach = std::max({ similarity.ReachOfLikeness(image, voxels, correction.Point, limit),
    std::min(voxels.Spacing.maxCoeff(), std::max(away, LeastReach)), correction.Radius });
  const RobustStatistics ball = StatisticsInBall(image, voxels,
    { correction.Point, std::max(LeastBall, std::min(GreatestBall, BallPart * this->Reach)) });
  this->AsVaried = ball;
  this->AsVaried.StandardDeviation =
    std::max(ball.StandardDeviation, organ.OfSeed.StandardDeviation);
  this->NotVaried = ball;
  this->NotVaried.StandardDeviation =
    std::min(ball.StandardDeviation, VarietyInSeedSpreads * similarity.SpreadOf(organ.OfSeed));
  const double depth = (away - NearAway) / (DeepAway - NearAway);
  this->Decay =
    DecayOfNearPoint + std::max(0.0, std::min(1.0, depth)) * (DecayOfDeepPoint - DecayOfNearPoint);
  if (correction.IsInside)
  {
    this->OrganReach = this->ReachOfOrgan(image, voxels);
    this->Reach = std::max(LeastReach, std::min(this->Reach, this->OrganReach));
  }
}

// As far as most voxels look like the point or like the organ. A ball across the boundary would
// look like anything.
double PointWorth::ReachOfOrgan(const ImagePart& image, const ImageGeometry& voxels) const
{
  const double away = this->Wanted.Away;
  const double limit =
    std::min({ GreatestReachInside, away, std::max(DeepAway, PartOfWayToOrgan * away) });
  AlikeShells shells(voxels.Spacing.maxCoeff(), limit);
  for (const std::size_t voxel : VoxelsInSphere(voxels, { this->Wanted.Point, limit }))
  {
    const std::array<int, 3> index = IndexOf(voxel, voxels);
    const float value = image.Row(index[1], index[2])[index[0]];
    shells.Add((CenterOf(voxel, voxels) - this->Wanted.Point).norm(),
      this->Similarity.LikenessOf(value, this->NotVaried) > 0 ||
        this->Similarity.LikenessOf(value, this->Organ.OfOrgan) > 0);
  }
  return shells.Reach();
}

bool PointWorth::IsCertain(const Eigen::Vector3d& place) const
{
  return (place - this->Wanted.Point).norm() <= CertainPart * this->Reach;
}

double PointWorth::Of(double value, const Eigen::Vector3d& place) const
{
  const double away = (place - this->Wanted.Point).norm();
  const double loss = this->Decay * Beyond(away, this->Reach);
  if (this->Wanted.IsInside)
  {
    return std::max(InsideGain * this->Similarity.LikenessOf(value, this->AsVaried) - loss,
      InsideGain * this->Similarity.LikenessOf(value, this->Organ.OfOrgan) -
        DecayOfNearPoint * Beyond(away, this->OrganReach));
  }
  return this->OutsideOf(value) - loss;
}

double PointWorth::OutsideOf(double value) const
{
  return OutsideGain *
    (this->Similarity.LikenessOf(value, this->NotVaried) -
      std::max(this->Similarity.LikenessOf(value, this->Organ.OfOrgan),
        this->Similarity.LikenessOf(value, this->Organ.OfSeed)));
}

} // namespace FlipFree
