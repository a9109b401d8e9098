#include "vtkAnisotropicDiffusionPrefilter.h"

#include "BackgroundTask.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "GreyImageAdapter.h"
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
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkAnisotropicDiffusionPrefilter);

namespace
{

using ItkImage = itk::Image<float, 3>;

constexpr const char* InputName = "the image on port 0";

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

/// The region as an image of its own, in float.
void CopyRegion(vtkImageData* image, Extent region, vtkImageData* copy)
{
  copy->SetExtent(region.Bounds);
  copy->SetOrigin(image->GetOrigin());
  copy->SetSpacing(image->GetSpacing());
  copy->SetDirectionMatrix(image->GetDirectionMatrix());
  copy->AllocateScalars(VTK_FLOAT, 1);
  copy->CopyAndCastFrom(image, region.Bounds);

  const float* voxels = static_cast<const float*>(copy->GetScalarPointer());
  const float* end = voxels + copy->GetNumberOfPoints();
  const float* bad = std::find_if(voxels, end, [](float value) { return !std::isfinite(value); });
  if (bad != end)
  {
    double point[3];
    copy->GetPoint(bad - voxels, point);
    throw std::invalid_argument(std::string(InputName) +
      " has a voxel that is NaN, infinite or beyond the range of float at " +
      FlipFree::TextOf(Eigen::Vector3d(point)) + " mm; replace such voxels by a grey value");
  }
}

/// The voxels of the image that may lie in the sphere.
Extent BoxOfSphere(vtkImageData* image, const FlipFree::SeedSphere& sphere)
{
  const FlipFree::Extent reached =
    FlipFree::ReachableExtent(FlipFree::GeometryOf(image), sphere.Center, sphere.Radius);
  Extent box = ExtentOf(image);
  for (int side = 0; side < 6; ++side)
  {
    box.Bounds[side] = box.Bounds[side / 2 * 2] + reached[side];
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

/// Root mean square of the gradient's magnitude over the voxels of the box within the radius of the
/// centre; by central differences that see no gradient across the image's border, as ITK's do.
double GradientScaleOf(vtkImageData* image, const Extent& box, const Eigen::Vector3d& center,
  double radius)
{
  vtkNew<vtkImageData> local;
  const Extent frame = box.Grown(1).Clipped(ExtentOf(image));
  CopyRegion(image, frame, local);
  const auto* voxels = static_cast<const float*>(local->GetScalarPointer());
  const auto valueAt = [&](const int index[3])
  { return static_cast<double>(voxels[local->ComputePointId(const_cast<int*>(index))]); };

  double sum = 0;
  vtkIdType count = 0;
  int index[3];
  for (index[2] = box.Bounds[4]; index[2] <= box.Bounds[5]; ++index[2])
  {
    for (index[1] = box.Bounds[2]; index[1] <= box.Bounds[3]; ++index[1])
    {
      for (index[0] = box.Bounds[0]; index[0] <= box.Bounds[1]; ++index[0])
      {
        Eigen::Vector3d point;
        local->TransformIndexToPhysicalPoint(index, point.data());
        if ((point - center).squaredNorm() > radius * radius)
        {
          continue;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          int before[3] = { index[0], index[1], index[2] };
          int after[3] = { index[0], index[1], index[2] };
          before[axis] = std::max(before[axis] - 1, frame.Bounds[2 * axis]);
          after[axis] = std::min(after[axis] + 1, frame.Bounds[2 * axis + 1]);
          const double slope = (valueAt(after) - valueAt(before)) / (2 * local->GetSpacing()[axis]);
          sum += slope * slope;
        }
        ++count;
      }
    }
  }
  if (count == 0)
  {
    RefuseEmptySphere();
  }
  return std::sqrt(sum / static_cast<double>(count));
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
    FlipFree::RequireGreyImage(input, InputName);
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
    if (this->GradientScale > 0)
    {
      this->GradientScaleUsed = this->GradientScale;
    }
    else if (this->ScaleRadius > 0)
    {
      this->GradientScaleUsed =
        GradientScaleOf(input, BoxOfSphere(input, sphere), sphere.Center, sphere.Radius);
    }
    else
    {
      this->GradientScaleUsed = GradientScaleOf(input, region, sphere.Center, HUGE_VAL);
    }

    CopyRegion(input, region, output);
    const auto diffuse = this->Equation == CURVATURE
      ? Diffuse<itk::CurvatureAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>
      : Diffuse<itk::GradientAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>;
    if (this->NumberOfIterations > 0 && this->GradientScaleUsed > 0 &&
      !diffuse(output, this->NumberOfIterations, this->TimeStepUsed, this->Conductance,
        this->GradientScaleUsed, FlipFree::MonitorOf(this)))
    {
      output->Initialize();
      return 1;
    }
    if (this->ScaleRadius > 0)
    {
      FlipFree::AddFieldValues("NoiseDeviation", { noise }, output);
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
