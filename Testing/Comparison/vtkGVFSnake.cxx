#include "vtkGVFSnake.h"

#include "BaselineTask.h"
#include "EdgeGradient.h"
#include "GradientVectorFlow.h"
#include "PlaneSnake.h"

#include "Image/ImageInterpolation.h"
#include "PropertyCheck.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkGVFSnake);

namespace
{

using FlipFree::PlaneImage;

// Shares of the progress.
constexpr double FlowBegins = 0.1;
constexpr double FlowEnds = 0.6;

// The slice through the seed's center, on square pixels: ITK's flow takes steps in x and y as
// equal.
struct SeedSlice
{
  explicit SeedSlice(const FlipFree::BaselineTask& task)
    : Region(task.Region.Geometry)
    , Pixel(Region.Spacing.head<2>().minCoeff())
    , Center(Region.ToIndex(FlipFree::OnlySeedOf(task).Center))
  {
    this->K = std::max(0,
      std::min(this->Region.Dimensions[2] - 1, static_cast<int>(std::lround(this->Center[2]))));
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Size[axis] = 1 +
        static_cast<int>(std::lround(
          (this->Region.Dimensions[axis] - 1) * this->Region.Spacing[axis] / this->Pixel));
    }
  }

  Eigen::Vector3d ToIndex(double x, double y) const
  {
    return { x * this->Pixel / this->Region.Spacing[0], y * this->Pixel / this->Region.Spacing[1],
      static_cast<double>(this->K) };
  }
  Eigen::Vector2d ToPixel(const Eigen::Vector3d& index) const
  {
    return index.head<2>().cwiseProduct(this->Region.Spacing.head<2>()) / this->Pixel;
  }

  FlipFree::ImageGeometry Region;
  double Pixel; // millimeters
  Eigen::Vector3d Center;
  int K = 0;
  std::array<int, 2> Size{};
};

PlaneImage::Pointer SampleSlice(const FlipFree::BaselineTask& task, const SeedSlice& slice)
{
  auto image = PlaneImage::New();
  PlaneImage::SizeType size;
  size[0] = static_cast<itk::SizeValueType>(slice.Size[0]);
  size[1] = static_cast<itk::SizeValueType>(slice.Size[1]);
  image->SetRegions(size);
  PlaneImage::SpacingType spacing;
  spacing.Fill(slice.Pixel);
  image->SetSpacing(spacing);
  image->Allocate();
  float* value = image->GetBufferPointer();
  for (int y = 0; y < slice.Size[1]; ++y)
  {
    for (int x = 0; x < slice.Size[0]; ++x)
    {
      *value++ =
        static_cast<float>(FlipFree::InterpolateClamped(task.Region.View(), slice.ToIndex(x, y)));
    }
  }
  return image;
}

// The pixels within the seed's cross-section, of which there is one at least.
std::vector<std::size_t> PixelsInSeed(const SeedSlice& slice, double radius)
{
  const Eigen::Vector2d center = slice.ToPixel(slice.Center);
  std::vector<std::size_t> pixels;
  for (int y = 0; y < slice.Size[1]; ++y)
  {
    for (int x = 0; x < slice.Size[0]; ++x)
    {
      if ((Eigen::Vector2d(x, y) - center).norm() * slice.Pixel <= radius)
      {
        pixels.push_back(x + static_cast<std::size_t>(slice.Size[0]) * y);
      }
    }
  }
  if (pixels.empty())
  {
    const Eigen::Array2d last(slice.Size[0] - 1, slice.Size[1] - 1);
    const Eigen::Array2d nearest = center.array().round().max(0).min(last);
    pixels.push_back(static_cast<std::size_t>(nearest[0] + slice.Size[0] * nearest[1]));
  }
  return pixels;
}

} // namespace

bool vtkGVFSnake::Segment(const FlipFree::BaselineTask& task,
  const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result)
{
  FlipFree::RequireGaussianWidth(task.Region.Geometry, 2);
  const SeedSlice slice(task);
  // The sphere's center may lie between two slices.
  const double aside = (slice.Center[2] - slice.K) * slice.Region.Spacing[2];
  const double seed = FlipFree::OnlySeedOf(task).Radius;
  const double radius = std::sqrt(std::max(slice.Pixel * slice.Pixel, seed * seed - aside * aside));
  // 0 in flat parts of the image, a half where the gradient is EdgeContrast times the seed's mean,
  // 1 at strong edges.
  const PlaneImage::Pointer edges =
    FlipFree::MapGradient<PlaneImage>(SampleSlice(task, slice), this->EdgeSigma, this->EdgeContrast,
      PixelsInSeed(slice, radius), FlipFree::PartOf(monitor, 0, FlowBegins),
      [](double squared) { return 1 - 1 / (1 + squared * squared * squared * squared); });
  FlipFree::PlaneField field{ slice.Size[0], slice.Size[1],
    std::vector<Eigen::Vector2d>(static_cast<std::size_t>(slice.Size[0]) * slice.Size[1]) };
  FlipFree::SnakeSettings settings;
  settings.Elasticity = this->Elasticity;
  settings.Rigidity = this->Rigidity;
  settings.Force = this->FlowWeight;
  settings.Pressure = this->Pressure;
  settings.MaximumIterations = this->MaximumIterations;
  settings.AreaTolerance = this->AreaTolerance;
  FlipFree::Outline outline =
    FlipFree::MakeCircle(slice.ToPixel(slice.Center), radius / slice.Pixel);
  if (!edges ||
    !FlipFree::FindVectorFlow(edges, this->FlowSmoothness, this->FlowIterations,
      FlipFree::PartOf(monitor, FlowBegins, FlowEnds), field) ||
    !FlipFree::MoveSnake(field, settings, FlipFree::PartOf(monitor, FlowEnds, 1), outline,
      result.Iterations))
  {
    return false;
  }

  result.Field.assign(task.Region.Voxels.size(), -1);
  result.Points.resize(outline.rows(), 3);
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    const Eigen::Vector3d index = slice.ToIndex(outline(i, 0), outline(i, 1));
    result.Points.row(i) = slice.Region.ToPhysical(index);
    outline.row(i) = index.head<2>(); // from here on in voxels
  }
  const std::vector<unsigned char> mask =
    FlipFree::FillOutline(outline, slice.Region.Dimensions[0], slice.Region.Dimensions[1]);
  std::transform(mask.begin(), mask.end(),
    result.Field.begin() + static_cast<std::ptrdiff_t>(slice.Region.Offset(0, 0, slice.K)),
    [](unsigned char inside) { return inside ? 1.0F : -1.0F; });
  return true;
}

void vtkGVFSnake::RequireProperties()
{
  this->Superclass::RequireProperties();
  FlipFree::RequireNumbers(
    { { "EdgeSigma", this->EdgeSigma }, { "EdgeContrast", this->EdgeContrast },
      { "FlowSmoothness", this->FlowSmoothness }, { "Elasticity", this->Elasticity },
      { "Rigidity", this->Rigidity }, { "FlowWeight", this->FlowWeight },
      { "Pressure", this->Pressure }, { "AreaTolerance", this->AreaTolerance } });
}
