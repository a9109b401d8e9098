#include "Intensity/BoundaryShift.h"

#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// Of the point's distance from the right side, and of this at most, in millimeters.
constexpr double ShiftPart = 0.7;
constexpr double GreatestDistance = 10;

// The balls whose gray values stand for the point and, of voxels in the mask, for the organ.
constexpr double PointBall = 2.5;
constexpr double PointBallVoxels = 1.01;
constexpr double OrganBall = 25;

// Gray values look alike within this many standard deviations.
constexpr double AlikeDeviations = 1.5;

// What earlier corrections to the other side keep, in millimeters.
constexpr double KeptRadius = 15;

class Shift
{
public:
  Shift(const ImagePart& image, const Correction& correction, double noise, Modality modality,
    const ParallelFor& parallelFor, const Monitor& monitor, const BitMask& before)
    : Image(image)
    , Wanted(correction)
    , Similarity(noise, modality)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Before(before)
    , Geometry(before.GetGeometry())
  {
  }

  // Finds what changes sides, and what the cut has changed already.
  bool Find(BitMask& changed)
  {
    const std::array<int, 3> own = NearestVoxel(this->Geometry, this->Wanted.Point);
    const bool target = this->Wanted.IsInside;
    const std::vector<float> squared =
      SquaredDistance(this->Before, target, this->Parallel, this->Ask);
    if (squared.empty())
    {
      return false;
    }
    this->Learn();
    const auto& size = this->Geometry.Dimensions;
    for (int k = 0; k < size[2]; ++k)
    {
      for (int j = 0; j < size[1]; ++j)
      {
        const float* const row = this->Image.Row(j, k);
        for (int i = 0; i < size[0]; ++i)
        {
          if (this->Before(i, j, k) != target && this->IsAlike(row[i]) &&
            this->IsNear({ i, j, k }, std::sqrt(squared[this->Geometry.Offset(i, j, k)])))
          {
            changed.Insert(i, j, k);
          }
        }
      }
    }
    changed.Insert(own[0], own[1], own[2]);
    return KeepConnected(changed, { this->Geometry.Offset(own[0], own[1], own[2]) }, this->Ask);
  }

private:
  // What the point and the organ look like.
  void Learn()
  {
    const double ball = std::max(PointBall, PointBallVoxels * this->Geometry.Spacing.maxCoeff());
    const RobustStatistics ofPoint =
      StatisticsInBall(this->Image, this->Geometry, { this->Wanted.Point, ball });
    std::vector<float> values;
    this->Before.ForEachRun(0, this->Geometry.Dimensions[2],
      [&](int begin, int end, int j, int k)
      {
        const float* const row = this->Image.Row(j, k);
        for (int i = begin; i < end; ++i)
        {
          if (this->DistanceOf({ i, j, k }) < OrganBall)
          {
            values.push_back(row[i]);
          }
        }
      });
    const RobustStatistics organ = values.empty() ? ofPoint : RobustStatisticsOf(values);
    const double spread =
      AlikeDeviations * std::max(this->Similarity.SpreadOf(ofPoint), 0.5 * organ.StandardDeviation);
    const double difference = ofPoint.Median - organ.Median;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    this->Least = -infinite;
    this->Most = infinite;
    if (this->Wanted.IsInside)
    {
      this->Least = std::min(ofPoint.Median, organ.Median) - spread;
      this->Most = std::max(ofPoint.Median, organ.Median) + spread;
    }
    else if (std::abs(difference) > spread)
    {
      (difference > 0 ? this->Least : this->Most) =
        ofPoint.Median + (difference > 0 ? -spread : spread);
    }
  }

  bool IsAlike(float value) const { return value > this->Least && value < this->Most; }

  double DistanceOf(const std::array<int, 3>& voxel) const
  {
    const Eigen::Vector3d center =
      this->Geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2]));
    return (center - this->Wanted.Point).norm();
  }

  bool IsNear(const std::array<int, 3>& voxel, double depth) const
  {
    const double greatest = ShiftPart * std::min(this->Wanted.Away, GreatestDistance);
    if (depth > greatest || depth > greatest * (1 - this->DistanceOf(voxel) / BoundaryShiftReach))
    {
      return false;
    }
    const Eigen::Vector3d center =
      this->Geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2]));
    return std::none_of(this->Wanted.Kept.begin(), this->Wanted.Kept.end(),
      [&](const SeedSphere& ball)
      {
        const double radius = std::min(std::max(ball.Radius, KeptRadius),
          0.5 * (ball.Center - this->Wanted.Point).norm());
        return (center - ball.Center).norm() <= radius;
      });
  }

  const ImagePart Image;
  const Correction& Wanted;
  const GrayValueSimilarity Similarity;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const BitMask& Before;
  const ImageGeometry& Geometry;
  double Least = 0; // of gray values that change sides
  double Most = 0;
};

} // namespace

bool ShiftBoundary(const ImagePart& image, const Correction& correction, double noise,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, const BitMask& before,
  BitMask& mask)
{
  const VoxelBox box = BoxAround(before.GetGeometry(), correction.Point, BoundaryShiftReach);
  const BitMask part = before.Cropped(box);
  // What the cut has changed leads on to what the shift changes.
  BitMask changed = mask.Cropped(box);
  BitMask same = part;
  if (correction.IsInside)
  {
    changed.Remove(part);
  }
  else
  {
    same.Remove(changed);
    changed = same;
  }
  if (!Shift(image.Cropped(box), correction, noise, modality, parallelFor, monitor, part)
         .Find(changed))
  {
    return false;
  }
  changed.ForEachRun(0, changed.GetGeometry().Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      mask.SetRun(correction.IsInside, box.Begin[0] + begin, box.Begin[0] + end, box.Begin[1] + j,
        box.Begin[2] + k);
    });
  return true;
}

} // namespace FlipFree
