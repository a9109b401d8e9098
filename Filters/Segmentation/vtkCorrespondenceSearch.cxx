#include "vtkCorrespondenceSearch.h"

#include "ContourMeshAdapter.h"
#include "Deformation/TargetSearch.h"
#include "FieldData.h"
#include "GrayImageAdapter.h"
#include "Measures/VoxelOverlap.h"
#include "StageProperties.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkCorrespondenceSearch);

namespace
{

// Of a feature that does not say: search lines of 40 mm by default.
constexpr double UsualSeedRadius = 25;

} // namespace

using Stage = vtkCorrespondenceSearch;

#define PROPERTIES(P)                                                                              \
  P(Threshold, double, Threshold, 0, 1)                                                            \
  P(SearchDistance, double, Settings->Correspondence.SearchDistance, 0, 1e6)                       \
  P(SearchScale, double, Settings->SearchScale, 0, 1e6)                                            \
  P(RunLength, double, Settings->Correspondence.RunLength, 0, 1000)                                \
  P(RunVoxels, int, Settings->Correspondence.RunVoxels, 1, 1000)                                   \
  P(SearchInward, bool, Settings->Correspondence.SearchInward, false, true)                        \
  P(EdgeWindow, double, Settings->Correspondence.EdgeWindow, 0, 1000)                              \
  P(ImageBoundaryDistance, double, Settings->Correspondence.ImageBoundaryDistance, 0, 1e6)         \
  P(NormalSmoothingIterations, int, Settings->NormalSmoothingIterations, 0, 1000)                  \
  P(OutlierStandardDeviations, double, Settings->OutlierStandardDeviations, 0, 1e6)                \
  P(MaximumDisplacement, double, Settings->MaximumDisplacement, 0, 1e6)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkCorrespondenceSearch::vtkCorrespondenceSearch()
  : Settings(std::make_unique<FlipFree::TargetSettings>())
{
  this->SetNumberOfInputPorts(3);
}

vtkCorrespondenceSearch::~vtkCorrespondenceSearch() = default;

void vtkCorrespondenceSearch::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY) });
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
    this->RequireProperties();
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
    if (edgeImage && this->Settings->Correspondence.EdgeWindow > 0)
    {
      FlipFree::RequireGrayImage(edgeImage, "the edge image on port 2");
      FlipFree::RequireFinite(edgeImage, FlipFree::WholeExtent(FlipFree::GeometryOf(edgeImage)),
        "the edge image on port 2");
      edges = FlipFree::GrayViewOf(edgeImage, copyOfEdges);
      FlipFree::RequireSameGeometry(edges.Geometry, feature.Geometry, "the edge image on port 2",
        "the feature on port 1");
    }

    const std::vector<double> radius =
      FlipFree::FieldValues("SeedRadius", 1, false, featureImage, "the feature on port 1");
    FlipFree::TargetSettings settings = *this->Settings;
    const std::vector<double> ramp =
      FlipFree::FieldValues("EdgeRamp", 3, true, featureImage, "the feature on port 1");
    if (ramp.size() == 3)
    {
      settings.Correspondence.Ramp = { ramp[0], ramp[1], ramp[2] };
    }

    FlipFree::TargetReport report;
    const FlipFree::CorrespondenceField field =
      FlipFree::FindTargets(surface.Mesh, surface.Points, foreground, edges,
        radius.empty() ? UsualSeedRadius : radius.front(), settings, FlipFree::SMPFor, report);
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
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}
