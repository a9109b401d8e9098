#include "vtkAnisotropicDiffusionPrefilter.h"

#include "BackgroundTask.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "GrayImageAdapter.h"
#include "ItkVtkBridge.h"
#include "MonitoredDiffusion.h"
#include "PropertyCheck.h"
#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "itkCurvatureAnisotropicDiffusionImageFilter.h"
#include "itkGradientAnisotropicDiffusionImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkAnisotropicDiffusionPrefilter);

namespace
{

using ItkImage = itk::Image<float, 3>;

constexpr const char* InputName = "the image on port 0";
// Of the progress: what comes before is short.
constexpr double ScaleEnds = 0.03;
constexpr double DiffusionBegins = 0.05;

struct Extent
{
  int Bounds[6];

  bool IsEmpty() const
  {
    return this->Bounds[0] > this->Bounds[1] || this->Bounds[2] > this->Bounds[3] ||
      this->Bounds[4] > this->Bounds[5];
  }
  Extent Clipped(const Extent& other) const
  {
    Extent result = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      result.Bounds[2 * axis] = std::max(this->Bounds[2 * axis], other.Bounds[2 * axis]);
      result.Bounds[2 * axis + 1] =
        std::min(this->Bounds[2 * axis + 1], other.Bounds[2 * axis + 1]);
    }
    return result;
  }
  Extent Grown(int voxels) const
  {
    Extent result = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      result.Bounds[2 * axis] -= voxels;
      result.Bounds[2 * axis + 1] += voxels;
    }
    return result;
  }
};

Extent ExtentOf(vtkImageData* image)
{
  Extent extent;
  image->GetExtent(extent.Bounds);
  return extent;
}

Extent ChooseRegion(const int voi[6], const Extent& whole)
{
  const Extent wanted{ { voi[0], voi[1], voi[2], voi[3], voi[4], voi[5] } };
  return wanted.IsEmpty() ? whole : wanted.Clipped(whole);
}

/// As indices that count from the image's first voxel.
FlipFree::Extent WithinImage(const Extent& extent, vtkImageData* image)
{
  FlipFree::Extent result{};
  for (int side = 0; side < 6; ++side)
  {
    result[side] = extent.Bounds[side] - image->GetExtent()[side / 2 * 2];
  }
  return result;
}

/// The region as an image of its own, in float. False if the monitor said stop; the copy is then
/// worthless.
bool CopyRegion(vtkImageData* image, Extent region, const FlipFree::Monitor& monitor,
  vtkImageData* copy)
{
  const FlipFree::Extent extent = WithinImage(region, image);
  if (!FlipFree::RequireFinite(image, extent, InputName, FlipFree::PartOf(monitor, 0, 0.3)))
  {
    return false;
  }
  copy->SetExtent(region.Bounds);
  copy->SetOrigin(image->GetOrigin());
  copy->SetSpacing(image->GetSpacing());
  copy->SetDirectionMatrix(image->GetDirectionMatrix());
  copy->AllocateScalars(VTK_FLOAT, 1);
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(copy);
  const FlipFree::VoxelReader read = FlipFree::GrayReaderOf(image, extent);
  auto* const voxels = static_cast<float*>(copy->GetScalarPointer());
  const auto& size = geometry.Dimensions;
  return FlipFree::SMPForSlices(0, size[2], static_cast<std::ptrdiff_t>(size[0]) * size[1],
    FlipFree::PartOf(monitor, 0.3, 1),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          read(0, size[0], j, k, voxels + geometry.Offset(0, j, k));
        }
      }
    });
}

/// The voxels of the image that may lie in the sphere.
Extent BoxOfSphere(vtkImageData* image, const FlipFree::SeedSphere& sphere)
{
  const FlipFree::Extent reached =
    FlipFree::ReachableExtent(FlipFree::GeometryOf(image), sphere.Center, sphere.Radius);
  const Extent whole = ExtentOf(image);
  Extent box = whole;
  for (int side = 0; side < 6; ++side)
  {
    box.Bounds[side] = whole.Bounds[side / 2 * 2] + reached[side];
  }
  return box;
}

[[noreturn]] void RefuseEmptySphere()
{
  throw std::invalid_argument("the scale sphere holds no voxel of " + std::string(InputName) +
    "; put ScaleCenter into the image, and give a ScaleRadius of a voxel or more");
}

/// Of the voxels as they are, in the sphere.
double NoiseOfSphere(vtkImageData* image, const FlipFree::SeedSphere& sphere)
{
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::RequireFinite(image, FlipFree::ReachableExtent(geometry, sphere.Center, sphere.Radius),
    InputName);
  if (FlipFree::VoxelsInSphere(geometry, sphere).empty())
  {
    RefuseEmptySphere();
  }
  return FlipFree::NoiseOf(image, sphere);
}

/// Measures the gradient's magnitude in slices of a box of the image, at the voxels within the
/// radius of the center, which is infinite for all: by central differences that see no gradient
/// across the image's border, as ITK's do.
class GradientMeasure
{
public:
  GradientMeasure(vtkImageData* image, const Extent& box, const Eigen::Vector3d& center,
    double radius)
    : Image(image)
    , Box(box)
    , Frame(box.Grown(1).Clipped(ExtentOf(image)))
    , Read(FlipFree::GrayReaderOf(image, WithinImage(this->Frame, image)))
    , Center(center)
    , Radius(radius)
  {
  }

  /// The voxels that are read.
  const Extent& GetFrame() const { return this->Frame; }

  /// Of a slice, the sum of the squared magnitudes and the number of voxels.
  void Measure(int k, double& sumOfSlice, vtkIdType& countOfSlice) const
  {
    double sum = 0; // neighboring slices' results share a line of the cache
    vtkIdType count = 0;
    const int* const box = this->Box.Bounds;
    const int* const frame = this->Frame.Bounds;
    const std::size_t width = frame[1] - frame[0] + 1;
    // The rows around one: it, those before and behind it in its slice, and in the next slices.
    std::array<std::vector<float>, 5> rows;
    rows.fill(std::vector<float>(width));
    for (int j = box[2]; j <= box[3]; ++j)
    {
      this->ReadRow(j, k, rows[0]);
      this->ReadRow(std::max(j - 1, frame[2]), k, rows[1]);
      this->ReadRow(std::min(j + 1, frame[3]), k, rows[2]);
      this->ReadRow(j, std::max(k - 1, frame[4]), rows[3]);
      this->ReadRow(j, std::min(k + 1, frame[5]), rows[4]);
      for (int i = box[0]; i <= box[1]; ++i)
      {
        if (!this->IsNear(i, j, k))
        {
          continue;
        }
        const int at = i - frame[0];
        const int before = std::max(i - 1, frame[0]) - frame[0];
        const int after = std::min(i + 1, frame[1]) - frame[0];
        sum += this->Square(0, rows[0][before], rows[0][after]);
        sum += this->Square(1, rows[1][at], rows[2][at]);
        sum += this->Square(2, rows[3][at], rows[4][at]);
        ++count;
      }
    }
    sumOfSlice = sum;
    countOfSlice = count;
  }

private:
  void ReadRow(int j, int k, std::vector<float>& row) const
  {
    const int* const frame = this->Frame.Bounds;
    this->Read(0, static_cast<int>(row.size()), j - frame[2], k - frame[4], row.data());
  }

  bool IsNear(int i, int j, int k) const
  {
    if (std::isinf(this->Radius))
    {
      return true;
    }
    Eigen::Vector3d point;
    this->Image->TransformIndexToPhysicalPoint(i, j, k, point.data());
    return (point - this->Center).squaredNorm() <= this->Radius * this->Radius;
  }

  double Square(int axis, double before, double after) const
  {
    const double slope = (after - before) / (2 * this->Spacing[axis]);
    return slope * slope;
  }

  vtkImageData* Image;
  Extent Box;
  Extent Frame;
  FlipFree::VoxelReader Read;
  Eigen::Vector3d Center;
  double Radius;
  Eigen::Vector3d Spacing = Eigen::Vector3d(Image->GetSpacing());
};

/// Root mean square of the gradient's magnitude over the voxels of the box within the radius of the
/// center. False if the monitor said stop.
bool MeasureGradientScale(vtkImageData* image, const Extent& box, const Eigen::Vector3d& center,
  double radius, const FlipFree::Monitor& monitor, double& scale)
{
  const GradientMeasure measure(image, box, center, radius);
  if (!FlipFree::RequireFinite(image, WithinImage(measure.GetFrame(), image), InputName,
        FlipFree::PartOf(monitor, 0, 0.2)))
  {
    return false;
  }
  // By slices, which are summed in their order, whatever thread had them.
  const int begin = box.Bounds[4];
  const int depth = box.Bounds[5] - begin + 1;
  std::vector<double> sums(std::max(0, depth), 0.0);
  std::vector<vtkIdType> counts(sums.size(), 0);
  const auto measureSlices = [&](std::ptrdiff_t first, std::ptrdiff_t last)
  {
    for (std::ptrdiff_t slice = first; slice < last; ++slice)
    {
      measure.Measure(begin + static_cast<int>(slice), sums[slice], counts[slice]);
    }
  };
  const std::ptrdiff_t voxelsOfSlice =
    static_cast<std::ptrdiff_t>(box.Bounds[1] - box.Bounds[0] + 1) *
    (box.Bounds[3] - box.Bounds[2] + 1);
  if (!FlipFree::SMPForSlices(0, depth, voxelsOfSlice, FlipFree::PartOf(monitor, 0.2, 1),
        measureSlices))
  {
    return false;
  }
  const vtkIdType count = std::accumulate(counts.begin(), counts.end(), vtkIdType(0));
  if (count == 0)
  {
    RefuseEmptySphere();
  }
  scale = std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(count));
  return true;
}

/// Diffuses the image in place. False if the monitor said stop; the image is then worthless.
template <typename TFilter>
bool Diffuse(vtkImageData* image, int iterations, double timeStep, double conductance,
  double gradientScale, const FlipFree::Monitor& monitor)
{
  const FlipFree::ItkWarningsOff quiet; // one of the two filters warns as if spacings were 1
  auto filter = FlipFree::MonitoredDiffusion<TFilter>::New();
  filter->SetInput(FlipFree::ShareWithItk<float>(image));
  filter->InPlaceOn(); // into VTK's own array
  filter->SetUseImageSpacing(true);
  filter->SetNumberOfIterations(static_cast<unsigned int>(iterations));
  filter->SetTimeStep(timeStep);
  filter->SetConductanceParameter(conductance);
  filter->SetFixedAverageGradientMagnitude(gradientScale);
  filter->SetNumberOfWorkUnits(
    static_cast<itk::ThreadIdType>(vtkSMPTools::GetEstimatedNumberOfThreads()));

  FlipFree::BackgroundTask task([filter]() { filter->Update(); });
  const double work = static_cast<double>(image->GetNumberOfPoints()) * iterations;
  const bool done =
    task.Wait([&]() { return monitor(static_cast<double>(filter->GetVoxelsDone()) / work); });
  if (!done)
  {
    filter->Stop();
    try
    {
      task.Wait([]() { return true; });
    }
    catch (const itk::ProcessAborted&)
    {
    }
  }
  image->GetPointData()->GetScalars()->Modified();
  return done;
}

} // namespace

int vtkAnisotropicDiffusionPrefilter::RequestInformation(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Extent whole;
  inputVector[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
    whole.Bounds);
  const Extent region = ChooseRegion(this->VOI, whole);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), region.Bounds, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(outInfo, VTK_FLOAT, 1);
  return 1;
}

int vtkAnisotropicDiffusionPrefilter::RequestUpdateExtent(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector*)
{
  // The sphere may lie anywhere in the image.
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  inInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
    inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
  return 1;
}

int vtkAnisotropicDiffusionPrefilter::RequestData(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  try
  {
    FlipFree::RequireNumbers({ { "TimeStep", this->TimeStep }, { "Conductance", this->Conductance },
      { "GradientScale", this->GradientScale }, { "ScaleRadius", this->ScaleRadius } });
    FlipFree::RequireGrayImage(input, InputName);
    const Extent region = ChooseRegion(this->VOI, ExtentOf(input));
    if (region.IsEmpty())
    {
      throw std::invalid_argument("VOI holds no voxel of " + std::string(InputName) +
        "; give an extent within the image's own, or an empty one for all of it");
    }
    const double* spacing = input->GetSpacing();
    const double stable = *std::min_element(spacing, spacing + 3) / 16;
    if (this->TimeStep > stable)
    {
      throw std::invalid_argument("TimeStep " + std::to_string(this->TimeStep) +
        " is not stable for the spacing of " + InputName + "; give at most " +
        std::to_string(stable) + ", or 0 to have it chosen");
    }
    this->TimeStepUsed = this->TimeStep > 0 ? this->TimeStep : stable;

    const FlipFree::SeedSphere sphere{ Eigen::Vector3d(this->ScaleCenter), this->ScaleRadius };
    const double noise = this->ScaleRadius > 0 ? NoiseOfSphere(input, sphere) : 0;
    const FlipFree::Monitor monitor = FlipFree::MonitorOf(this);
    const bool ofSphere = this->ScaleRadius > 0;
    double scale = this->GradientScale;
    const bool proceed =
      (scale > 0 ||
        MeasureGradientScale(input, ofSphere ? BoxOfSphere(input, sphere) : region, sphere.Center,
          ofSphere ? sphere.Radius : HUGE_VAL, FlipFree::PartOf(monitor, 0, ScaleEnds), scale)) &&
      CopyRegion(input, region, FlipFree::PartOf(monitor, ScaleEnds, DiffusionBegins), output);
    if (proceed)
    {
      this->GradientScaleUsed = scale;
    }
    const auto diffuse = this->Equation == CURVATURE
      ? Diffuse<itk::CurvatureAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>
      : Diffuse<itk::GradientAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>;
    if (!proceed ||
      (this->NumberOfIterations > 0 && scale > 0 &&
        !diffuse(output, this->NumberOfIterations, this->TimeStepUsed, this->Conductance, scale,
          FlipFree::PartOf(monitor, DiffusionBegins, 1))))
    {
      output->Initialize();
      return 1; // aborted
    }
    if (this->ScaleRadius > 0)
    {
      FlipFree::AddFieldValues("NoiseStandardDeviation", { noise }, output);
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro("Nothing smoothed: " << error.what() << ".");
    return 0;
  }
}

void vtkAnisotropicDiffusionPrefilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Equation: " << (this->Equation == CURVATURE ? "curvature" : "gradient") << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "TimeStep: " << this->TimeStep << ", used " << this->TimeStepUsed << "\n";
  os << indent << "Conductance: " << this->Conductance << "\n";
  os << indent << "GradientScale: " << this->GradientScale << ", used " << this->GradientScaleUsed
     << "\n";
  os << indent << "ScaleCenter: (" << this->ScaleCenter[0] << ", " << this->ScaleCenter[1] << ", "
     << this->ScaleCenter[2] << ")\n";
  os << indent << "ScaleRadius: " << this->ScaleRadius << "\n";
  os << indent << "VOI: (" << this->VOI[0] << ", " << this->VOI[1] << ", " << this->VOI[2] << ", "
     << this->VOI[3] << ", " << this->VOI[4] << ", " << this->VOI[5] << ")\n";
}
