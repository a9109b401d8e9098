#include "vtkCorrespondenceSearch.h"

#include "ContourMeshAdapter.h"
#include "Deformation/TargetSearch.h"
#include "FieldData.h"
#include "GrayImageAdapter.h"
#include "Measures/VoxelOverlap.h"
#include "PropertyCheck.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkCorrespondenceSearch);

vtkCorrespondenceSearch::vtkCorrespondenceSearch()
{
  this->SetNumberOfInputPorts(3);
}

void vtkCorrespondenceSearch::SetFeatureData(vtkImageData* feature)
{
  this->SetInputDataObject(1, feature);
}

void vtkCorrespondenceSearch::SetEdgeData(vtkImageData* image)
{
  this->SetInputDataObject(2, image);
}

int vtkCorrespondenceSearch::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkImageData");
  info->Set(INPUT_IS_OPTIONAL(), port == 2);
  return 1;
}

int vtkCorrespondenceSearch::RequestUpdateExtent(vtkInformation*,
  vtkInformationVector** inputVector, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 1; port < 3; ++port)
  {
    vtkInformation* in = inputVector[port]->GetInformationObject(0);
    if (in && in->Has(Pipeline::WHOLE_EXTENT()))
    {
      in->Set(Pipeline::UPDATE_EXTENT(), in->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

int vtkCorrespondenceSearch::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkImageData* featureImage = vtkImageData::GetData(inputVector[1]);
  vtkImageData* edgeImage = vtkImageData::GetData(inputVector[2]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  try
  {
    FlipFree::RequireNumbers({ { "Threshold", this->Threshold },
      { "SearchDistance", this->SearchDistance }, { "RunLength", this->RunLength },
      { "ImageBoundaryDistance", this->ImageBoundaryDistance }, { "EdgeWindow", this->EdgeWindow },
      { "OutlierStandardDeviations", this->OutlierStandardDeviations },
      { "MaximumDisplacement", this->MaximumDisplacement } });
    const FlipFree::DeformableSurface surface =
      FlipFree::DeformableSurfaceOf(input, "the surface on port 0", false);
    FlipFree::RequireGrayImage(featureImage, "the feature on port 1");
    FlipFree::RequireFinite(featureImage, FlipFree::WholeExtent(FlipFree::GeometryOf(featureImage)),
      "the feature on port 1");
    FlipFree::FloatImage copyOfFeature;
    const FlipFree::ImageView<float> feature = FlipFree::GrayViewOf(featureImage, copyOfFeature);
    const std::vector<double> given =
      FlipFree::FieldValues("FeatureThreshold", 1, false, featureImage, "the feature on port 1");
    const double threshold = this->Threshold > 0 ? this->Threshold
      : !given.empty() && given.front() > 0      ? given.front()
                                                 : 0.5;
    const FlipFree::BitMask foreground = FlipFree::VoxelsWhere(
      feature, [threshold](float value) { return value >= threshold; }, FlipFree::SMPFor);
    FlipFree::FloatImage copyOfEdges;
    FlipFree::ImageView<float> edges;
    if (this->EdgeWindow > 0)
    {
      FlipFree::RequireGrayImage(edgeImage, "the edge image on port 2");
      FlipFree::RequireFinite(edgeImage, FlipFree::WholeExtent(FlipFree::GeometryOf(edgeImage)),
        "the edge image on port 2");
      edges = FlipFree::GrayViewOf(edgeImage, copyOfEdges);
      FlipFree::RequireSameGeometry(edges.Geometry, feature.Geometry, "the edge image on port 2",
        "the feature on port 1");
    }

    FlipFree::TargetSettings settings;
    const std::vector<double> ramp =
      FlipFree::FieldValues("EdgeRamp", 3, true, featureImage, "the feature on port 1");
    if (ramp.size() == 3)
    {
      settings.Correspondence.Ramp = { ramp[0], ramp[1], ramp[2] };
    }
    settings.Correspondence.SearchDistance = this->SearchDistance;
    settings.Correspondence.RunLength = this->RunLength;
    settings.Correspondence.RunVoxels = this->RunVoxels;
    settings.Correspondence.SearchInward = this->SearchInward;
    settings.Correspondence.ImageBoundaryDistance = this->ImageBoundaryDistance;
    settings.Correspondence.EdgeWindow = this->EdgeWindow;
    settings.NormalSmoothingIterations = this->NormalSmoothingIterations;
    settings.OutlierStandardDeviations = this->OutlierStandardDeviations;
    settings.MaximumDisplacement = this->MaximumDisplacement * feature.Geometry.Spacing.maxCoeff();

    FlipFree::TargetReport report;
    const FlipFree::CorrespondenceField field = FlipFree::FindTargets(surface.Mesh, surface.Points,
      foreground, edges, settings, FlipFree::SMPFor, report);
    output->ShallowCopy(input);
    FlipFree::AttachField(field, output);
    FlipFree::AddFieldValues("MeanDistance", { report.MeanDistance }, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro("No correspondence: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkCorrespondenceSearch::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "SearchDistance: " << this->SearchDistance << "\n";
  os << indent << "RunLength: " << this->RunLength << "\n";
  os << indent << "RunVoxels: " << this->RunVoxels << "\n";
  os << indent << "SearchInward: " << this->SearchInward << "\n";
  os << indent << "ImageBoundaryDistance: " << this->ImageBoundaryDistance << "\n";
  os << indent << "EdgeWindow: " << this->EdgeWindow << "\n";
  os << indent << "NormalSmoothingIterations: " << this->NormalSmoothingIterations << "\n";
  os << indent << "OutlierStandardDeviations: " << this->OutlierStandardDeviations << "\n";
  os << indent << "MaximumDisplacement: " << this->MaximumDisplacement << "\n";
}
