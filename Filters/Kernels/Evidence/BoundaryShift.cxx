#include "Evidence/BoundaryShift.h"

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

class Shift
{
public:
  Shift(const ImagePart& image, const PointCorrection& correction, double noise, Modality modality,
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

  // Finds what changes sides.
  bool Find(BitMask& changed)
  {
    const bool target = this->Wanted.IsInside;
    const std::vector<float> squared =
      SquaredDistance(this->Before, target, this->Parallel, this->Ask);
    if (squared.empty())
    {
      return false;
    }
    this->Learn();
    std::vector<std::size_t> atPoint;
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
            if (this->IsOnWay({ i, j, k }))
            {
              atPoint.push_back(this->Geometry.Offset(i, j, k));
            }
          }
        }
      }
    }
    return KeepConnected(changed, atPoint, this->Ask);
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

  // Whether it lies between the point and its side of the mask.
  bool IsOnWay(const std::array<int, 3>& voxel) const
  {
    const Eigen::Vector3d way = this->Wanted.NearestOnSide - this->Wanted.Point;
    const Eigen::Vector3d from =
      this->Geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2])) - this->Wanted.Point;
    const double along = std::max(0.0, std::min(1.0, from.dot(way) / way.squaredNorm()));
    return (from - along * way).norm() <= this->Geometry.Spacing.maxCoeff();
  }

  bool IsNear(const std::array<int, 3>& voxel, double depth) const
  {
    const double greatest = ShiftPart * std::min(this->Wanted.Away, GreatestDistance);
    if (depth > greatest || depth > greatest * (1 - this->DistanceOf(voxel) / BoundaryShiftReach))
    {
      return false;
    }
    return !this->Wanted.IsHeld(
      this->Geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2])));
  }

  const ImagePart Image;
  const PointCorrection& Wanted;
  const GrayValueSimilarity Similarity;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const BitMask& Before;
  const ImageGeometry& Geometry;
  double Least = 0; // of gray values that change sides
  double Most = 0;
};

} // namespace

bool ShiftBoundary(const ImagePart& image, const PointCorrection& correction, double noise,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, const BitMask& before,
  BitMask& changed)
{
  const VoxelBox box = BoxAround(before.GetGeometry(), correction.Point, BoundaryShiftReach);
  const BitMask part = before.Cropped(box);
  BitMask found(part.GetGeometry());
  if (!Shift(image.Cropped(box), correction, noise, modality, parallelFor, monitor, part)
         .Find(found))
  {
    return false;
  }
  changed = BitMask(before.GetGeometry());
  changed.Insert(found, box.Begin);
  return true;
}

} // namespace FlipFree
