#include "vtkAnisotropicDiffusionPrefilter.h"

#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "Image/BoxReading.h"
#include "Image/GradientScale.h"
#include "ItkDiffusion.h"
#include "PipelineAdapter.h"
#include "PropertyCheck.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

vtkStandardNewMacro(vtkAnisotropicDiffusionPrefilter);

namespace
{

using FlipFree::VoxelBox;

constexpr const char* InputName = "the image{ on port 0}";
// Of the progress: what comes before is short.
constexpr double ScaleEnds = 0.03;
constexpr double DiffusionBegins = 0.05;

/// The VOI, or all of the image if it is empty, counted from the image's first voxel.
VoxelBox ChooseRegion(const int (&voi)[6], const int* whole)
{
  const VoxelBox wanted = FlipFree::BoxOf(voi, whole);
  const VoxelBox all = FlipFree::BoxOf(whole, whole);
  return wanted.IsEmpty() ? all : wanted.Cropped(all);
}

/// The noise in the scale sphere, which must hold a voxel of the image.
double NoiseOfSphere(vtkImageData* image, const FlipFree::SeedSphere& sphere)
{
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::RequireFinite(image, FlipFree::BoxAround(geometry, sphere.Center, sphere.Radius),
    InputName);
  if (FlipFree::VoxelsInSphere(geometry, sphere).empty())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::SeedWithoutVoxels,
      "the scale sphere holds no voxel of " + std::string(InputName) +
        "; put {ScaleCenter} into the image, and give a {ScaleRadius} of a voxel or more");
  }
  return FlipFree::NoiseOf(image, sphere);
}

/// The gradient scale over a part of the image. False if the monitor said stop.
bool MeasureScale(vtkImageData* image, const VoxelBox& box, const FlipFree::SeedSphere& sphere,
  const FlipFree::Monitor& monitor, double& scale)
{
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  const VoxelBox whole = FlipFree::WholeBox(geometry);
  const VoxelBox read = box.Widened({ { 1, 1, 1 } }, whole); // with the neighbors of its voxels
  return FlipFree::RequireFinite(image, read, InputName, FlipFree::PartOf(monitor, 0, 0.2)) &&
    FlipFree::MeasureGradientScale(FlipFree::GrayReaderOf(image, whole), geometry, box, sphere,
      FlipFree::SMPThreading(), FlipFree::PartOf(monitor, 0.2, 1), scale);
}

/// The region as an image of its own, in float. False if the monitor said stop; the copy is then
/// worthless.
bool CopyRegion(vtkImageData* image, const VoxelBox& region, const FlipFree::Monitor& monitor,
  vtkImageData* copy)
{
  if (!FlipFree::RequireFinite(image, region, InputName, FlipFree::PartOf(monitor, 0, 0.3)))
  {
    return false;
  }
  copy->SetExtent(FlipFree::ExtentOf(region, image->GetExtent()).data());
  copy->SetOrigin(image->GetOrigin());
  copy->SetSpacing(image->GetSpacing());
  copy->SetDirectionMatrix(image->GetDirectionMatrix()->GetData());
  copy->AllocateScalars(VTK_FLOAT, 1);
  const FlipFree::VoxelReader read =
    FlipFree::GrayReaderOf(image, FlipFree::WholeBox(FlipFree::GeometryOf(image)));
  auto* const voxels = static_cast<float*>(copy->GetScalarPointer());
  return FlipFree::SMPForSlices(0, region.Size(2),
    static_cast<std::ptrdiff_t>(region.Size(0)) * region.Size(1), FlipFree::PartOf(monitor, 0.3, 1),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    { FlipFree::ReadSlices(read, region, first, last, voxels); });
}

} // namespace

int vtkAnisotropicDiffusionPrefilter::RequestInformation(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  int whole[6];
  inputVector[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
    whole);
  const VoxelBox region = ChooseRegion(this->VOI, whole);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
    FlipFree::ExtentOf(region, whole).data(), 6);
  vtkDataObject::SetPointDataActiveScalarInfo(outInfo, VTK_FLOAT, 1);
  return 1;
}

int vtkAnisotropicDiffusionPrefilter::RequestUpdateExtent(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector*)
{
  // The sphere may lie anywhere in the image.
  FlipFree::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkAnisotropicDiffusionPrefilter::RequestData(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  try
  {
    FlipFree::RequireNumbers({ { "TimeStep", this->TimeStep }, { "Conductance", this->Conductance },
      { "GradientScale", this->GradientScale }, { "ScaleRadius", this->ScaleRadius } });
    FlipFree::RequireGrayImage(input, InputName);
    const VoxelBox region = ChooseRegion(this->VOI, input->GetExtent());
    if (region.IsEmpty())
    {
      throw FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
        "{VOI} holds no voxel of " + std::string(InputName) +
          "; give an extent within the image's own, or an empty one for all of it");
    }
    const double* spacing = input->GetSpacing();
    const double stable = *std::min_element(spacing, spacing + 3) / 16;
    if (this->TimeStep > stable)
    {
      throw FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
        "{TimeStep} " + std::to_string(this->TimeStep) + " is not stable for the spacing of " +
          InputName + "; give at most " + std::to_string(stable) + ", or 0 to have it chosen");
    }
    this->TimeStepUsed = this->TimeStep > 0 ? this->TimeStep : stable;

    const bool ofSphere = this->ScaleRadius > 0;
    const FlipFree::SeedSphere sphere{ Eigen::Vector3d(this->ScaleCenter),
      ofSphere ? this->ScaleRadius : std::numeric_limits<double>::infinity() };
    const double noise = ofSphere ? NoiseOfSphere(input, sphere) : 0;
    const FlipFree::Monitor monitor = FlipFree::MonitorOf(this);
    double scale = this->GradientScale;
    if (scale == 0 &&
      !MeasureScale(input,
        ofSphere ? FlipFree::BoxAround(FlipFree::GeometryOf(input), sphere.Center, sphere.Radius)
                 : region,
        sphere, FlipFree::PartOf(monitor, 0, ScaleEnds), scale))
    {
      return 1; // aborted
    }
    if (!CopyRegion(input, region, FlipFree::PartOf(monitor, ScaleEnds, DiffusionBegins), output))
    {
      output->Initialize();
      return 1; // aborted
    }
    this->GradientScaleUsed = scale;
    const FlipFree::ItkDiffusionSettings settings{ this->Equation == CURVATURE,
      this->NumberOfIterations, this->TimeStepUsed, this->Conductance, scale };
    if (this->NumberOfIterations > 0 && scale > 0 &&
      !FlipFree::DiffuseByItk(output, settings, FlipFree::PartOf(monitor, DiffusionBegins, 1)))
    {
      output->Initialize();
      return 1; // aborted
    }
    if (ofSphere)
    {
      FlipFree::AddFieldValues("NoiseStandardDeviation", { noise }, output);
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("Nothing smoothed: ", error, ".");
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
