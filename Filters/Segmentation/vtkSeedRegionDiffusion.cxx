#include "vtkSeedRegionDiffusion.h"

#include "Deformation/SegmentationParameters.h"
#include "FieldData.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "Image/NoData.h"
#include "Image/SmoothRegion.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkSeedRegionDiffusion);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// The geometry that the pipeline announces, before there are voxels.
FlipFree::ImageGeometry AnnouncedGeometry(vtkInformation* info, const int* extent)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(const_cast<int*>(extent));
  image->SetSpacing(info->Get(vtkDataObject::SPACING()));
  image->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
  if (info->Has(vtkDataObject::DIRECTION()))
  {
    image->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
  }
  return FlipFree::GeometryOf(image);
}

} // namespace

#define FLIPFREE_STAGE vtkSeedRegionDiffusion

#define PROPERTIES(P) FLIPFREE_SMOOTHING_PARAMETERS(P, Settings->, NumberOfIterations)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

void vtkSeedRegionDiffusion::SetSeedRadius(double value)
{
  FlipFree::SetSeedRadius(this, value, this->SeedRadius);
}

vtkSeedRegionDiffusion::vtkSeedRegionDiffusion()
  : Settings(std::make_unique<FlipFree::SmoothingSettings>())
{
}

vtkSeedRegionDiffusion::~vtkSeedRegionDiffusion() = default;

void vtkSeedRegionDiffusion::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY) });
}

int vtkSeedRegionDiffusion::RequestInformation(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  vtkInformation* in = inputVector[0]->GetInformationObject(0);
  vtkInformation* out = outputVector->GetInformationObject(0);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 1);
  if (!in->Has(Pipeline::WHOLE_EXTENT()) || !in->Has(vtkDataObject::SPACING()) ||
    !in->Has(vtkDataObject::ORIGIN()))
  {
    return 1;
  }
  int extent[6];
  in->Get(Pipeline::WHOLE_EXTENT(), extent);
  const FlipFree::VoxelBox box = FlipFree::BoxAround(AnnouncedGeometry(in, extent),
    Eigen::Vector3d(this->SeedCenter), FlipFree::ReachOf(*this->Settings, this->SeedRadius));
  out->Set(Pipeline::WHOLE_EXTENT(), FlipFree::ExtentOf(box, extent).data(), 6);
  return 1;
}

int vtkSeedRegionDiffusion::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector*)
{
  FlipFree::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkSeedRegionDiffusion::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const FlipFree::SeedSphere seed{ Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  try
  {
    this->RequireProperties();
    FlipFree::RequireGrayImage(image, "the image{ on port 0}");
    const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
    FlipFree::RequireSeed(geometry, seed, "the image{ on port 0}");
    FlipFree::RequireReach(*this->Settings, seed.Radius);
    const FlipFree::VoxelBox box =
      FlipFree::BoxAround(geometry, seed.Center, FlipFree::ReachOf(*this->Settings, seed.Radius));
    FlipFree::RequireData(FlipFree::GrayReaderOf(image, FlipFree::WholeBox(geometry)), geometry,
      seed);
    const double noise = FlipFree::NoiseOf(image, seed);
    FlipFree::FloatImage region;
    if (!FlipFree::SmoothRegionOf(image, box, FlipFree::DiffusionOf(*this->Settings, noise),
          FlipFree::MonitorOf(this), region))
    {
      output->Initialize();
      return 1;
    }
    output->SetExtent(outputVector->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT()));
    output->SetSpacing(image->GetSpacing());
    output->SetOrigin(image->GetOrigin());
    output->SetDirectionMatrix(image->GetDirectionMatrix()->GetData()); // not the matrix itself
    FlipFree::SetFloatScalars("Intensity", region.Voxels, output);
    FlipFree::AddFieldValues("NoiseStandardDeviation", { noise }, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("Nothing smoothed: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkSeedRegionDiffusion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
