/**
 * Gray values along the rays of cross-sections. Where a ray runs in the image's index space is
 * worked out once per ray.
 */
#ifndef FlipFreeSectionRays_h
#define FlipFreeSectionRays_h

#include "Image/ImageInterpolation.h"
#include "Vessel/SectionFrames.h"

namespace FlipFree
{

class SectionRays
{
public:
  /// The image outlives the object.
  SectionRays(const ImageView<float>& image, const std::vector<SectionFrame>& frames, int rays)
    : Image(image)
    , Rays(rays)
  {
    const ImageGeometry& geometry = image.Geometry;
    const Eigen::Matrix3d toIndex =
      geometry.Spacing.cwiseInverse().asDiagonal() * geometry.Direction.inverse();
    this->Origins.reserve(frames.size());
    this->Steps.reserve(frames.size() * rays);
    for (const SectionFrame& frame : frames)
    {
      this->Origins.emplace_back(toIndex * (frame.Origin - geometry.Origin));
      for (int ray = 0; ray < rays; ++ray)
      {
        this->Steps.emplace_back(toIndex * frame.Ray(2 * EIGEN_PI * ray / rays));
      }
    }
  }

  /// At a distance from the section's center, in millimeters.
  double Sample(std::ptrdiff_t section, int ray, double distance) const
  {
    return InterpolateClamped(this->Image,
      this->Origins[section] + distance * this->Steps[section * this->Rays + ray]);
  }

private:
  const ImageView<float>& Image;
  int Rays;
  std::vector<Eigen::Vector3d> Origins; // index space, per section
  std::vector<Eigen::Vector3d> Steps;   // per ray and millimeter
};

} // namespace FlipFree

#endif
