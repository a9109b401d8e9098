#include "Evidence/BoundarySupport.h"

#include "Image/NoData.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Quantile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace FlipFree
{
namespace
{

// In millimeters: where contrast is measured along the normal, and the ball that gives the normal.
constexpr int Nearest = 2;
constexpr int Farthest = 6;
constexpr double NormalReach = 6;
constexpr double NormalStep = 1.5;
constexpr std::size_t MostSamples = 2500;
constexpr double Tail = 0.1;

class Boundary
{
public:
  Boundary(const ImageView<float>& image, const BitMask& mask)
    : Image(image)
    , Geometry(image.Geometry)
    , Mask(mask)
  {
    const Eigen::Vector3d reach = this->Geometry.IndexReach(NormalReach);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Step[axis] = std::max(1, static_cast<int>(NormalStep / this->Geometry.Spacing[axis]));
      const int voxels = std::max(1, static_cast<int>(reach[axis]));
      this->Reach[axis] = voxels / this->Step[axis] * this->Step[axis];
    }
    this->Find();
  }

  double Compactness() const
  {
    const double volume = static_cast<double>(this->Mask.Count()) * this->Geometry.VoxelVolume();
    return 36 * EIGEN_PI * volume * volume / (this->Area * this->Area * this->Area);
  }

  double ContrastOfMost() const
  {
    const std::size_t step = std::max<std::size_t>(1, this->Voxels.size() / MostSamples);
    std::vector<double> contrasts;
    for (std::size_t voxel = step / 2; voxel < this->Voxels.size(); voxel += step)
    {
      if (const std::optional<double> contrast = this->ContrastAt(this->Voxels[voxel]))
      {
        contrasts.push_back(*contrast);
      }
    }
    return contrasts.empty() ? 0 : TakeQuantile(contrasts, Tail);
  }

private:
  bool IsInside(int i, int j, int k) const
  {
    return this->Geometry.Contains(i, j, k) && this->Mask(i, j, k);
  }

  void Find()
  {
    const Eigen::Vector3d& spacing = this->Geometry.Spacing;
    const std::array<double, 3> faces{ { spacing[1] * spacing[2], spacing[0] * spacing[2],
      spacing[0] * spacing[1] } };
    this->Mask.ForEachRun(0, this->Geometry.Dimensions[2],
      [&](int begin, int end, int j, int k)
      {
        for (int i = begin; i < end; ++i)
        {
          const int x =
            (this->IsInside(i - 1, j, k) ? 0 : 1) + (this->IsInside(i + 1, j, k) ? 0 : 1);
          const int y =
            (this->IsInside(i, j - 1, k) ? 0 : 1) + (this->IsInside(i, j + 1, k) ? 0 : 1);
          const int z =
            (this->IsInside(i, j, k - 1) ? 0 : 1) + (this->IsInside(i, j, k + 1) ? 0 : 1);
          if (x + y + z > 0)
          {
            this->Area += x * faces[0] + y * faces[1] + z * faces[2];
            this->Voxels.push_back({ { i, j, k } });
          }
        }
      });
  }

  // To the center of what lies outside in a ball; zero where there is no such direction.
  Eigen::Vector3d NormalAt(const std::array<int, 3>& voxel) const
  {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int z = -this->Reach[2]; z <= this->Reach[2]; z += this->Step[2])
    {
      for (int y = -this->Reach[1]; y <= this->Reach[1]; y += this->Step[1])
      {
        for (int x = -this->Reach[0]; x <= this->Reach[0]; x += this->Step[0])
        {
          const Eigen::Vector3d away = this->Geometry.Direction *
            this->Geometry.Spacing.cwiseProduct(Eigen::Vector3d(x, y, z));
          if (away.squaredNorm() <= NormalReach * NormalReach &&
            !this->IsInside(voxel[0] + x, voxel[1] + y, voxel[2] + z))
          {
            normal += away;
          }
        }
      }
    }
    const double length = normal.norm();
    return length > 1e-9 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
  }

  // Of the voxels along a ray that are on its side of the boundary.
  std::optional<double> MeanAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
    bool inside) const
  {
    double sum = 0;
    int count = 0;
    for (int distance = Nearest; distance <= Farthest; ++distance)
    {
      const Eigen::Vector3d index = this->Geometry.ToIndex(from + distance * direction);
      const int i = static_cast<int>(std::lround(index[0]));
      const int j = static_cast<int>(std::lround(index[1]));
      const int k = static_cast<int>(std::lround(index[2]));
      if (this->Geometry.Contains(i, j, k) && this->Mask(i, j, k) == inside &&
        HasData(this->Image(i, j, k)))
      {
        sum += this->Image(i, j, k);
        ++count;
      }
    }
    return count > 0 ? std::optional<double>(sum / count) : std::nullopt;
  }

  std::optional<double> ContrastAt(const std::array<int, 3>& voxel) const
  {
    const Eigen::Vector3d normal = this->NormalAt(voxel);
    if (normal.isZero())
    {
      return std::nullopt;
    }
    const Eigen::Vector3d point =
      this->Geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2]));
    const std::optional<double> inside = this->MeanAlong(point, -normal, true);
    const std::optional<double> outside = this->MeanAlong(point, normal, false);
    return inside && outside ? std::optional<double>(std::abs(*inside - *outside)) : std::nullopt;
  }

  const ImageView<float>& Image;
  const ImageGeometry& Geometry;
  const BitMask& Mask;
  std::array<int, 3> Step{};
  std::array<int, 3> Reach{};
  std::vector<std::array<int, 3>> Voxels;
  double Area = 0;
};

} // namespace

double BoundarySupport(const ImageView<float>& image, const BitMask& mask, double leastContrast)
{
  if (mask.Count() == 0)
  {
    return 0;
  }
  const Boundary boundary(image, mask);
  return std::max(leastContrast, boundary.ContrastOfMost()) * std::cbrt(boundary.Compactness());
}

double LeastContrastAround(const ImageView<float>& image, const SeedSphere& seed, double noise)
{
  constexpr double least = 0.1; // of the standard deviation
  return least *
    std::max(StatisticsInBall({ image, {} }, image.Geometry, seed).StandardDeviation, 0.5 * noise);
}

} // namespace FlipFree
