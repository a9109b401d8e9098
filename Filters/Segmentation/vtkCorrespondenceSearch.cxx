#include "vtkCorrespondenceSearch.h"

#include "ContourMeshAdapter.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/TargetSearch.h"
#include "FieldData.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "Image/GridCheck.h"
#include "Image/NoData.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <vector>

namespace
{

bool SameGrid(const FlipFree::ImageGeometry& one, const FlipFree::ImageGeometry& other)
{
  return one.Dimensions == other.Dimensions && one.Origin == other.Origin &&
    one.Spacing == other.Spacing && one.Direction == other.Direction;
}

// An image as floats. It is not copied again while it stays the same.
class KeptImage
{
public:
  // Throws Error for an image that cannot be searched.
  void Update(vtkImageData* image, const std::string& name)
  {
    FlipFree::RequireGrayImage(image, name);
    const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
    vtkDataArray* scalars = image->GetPointData()->GetScalars();
    const bool isSame = this->Scalars == scalars && this->Time == image->GetMTime() &&
      SameGrid(geometry, this->View.Geometry);
    this->Time = 0; // until it is there
    if (!isSame || scalars->GetDataType() == VTK_FLOAT)
    {
      this->View = FlipFree::GrayViewOf(image, this->Copy);
    }
    this->Version += isSame ? 0 : 1;
    this->Scalars = scalars;
    this->Time = image->GetMTime();
  }

  const FlipFree::ImageView<float>& GetView() const { return this->View; }
  // Another number for another image.
  int GetVersion() const { return this->Version; }

private:
  const vtkDataArray* Scalars = nullptr; // to compare with alone
  vtkMTimeType Time = 0;
  int Version = 0;
  FlipFree::FloatImage Copy; // of voxels that are not floats
  FlipFree::ImageView<float> View;
};

// The progress of several passes over the data: it does not go back, and a stop is remembered.
class Passes
{
public:
  explicit Passes(vtkAlgorithm* filter)
    : Own(FlipFree::MonitorOf(filter))
  {
  }

  bool IsStopped() const { return this->Remembering.HasStopped(); }

  // The part [first, last] of the whole.
  FlipFree::Monitor Part(double first, double last)
  {
    return [this, first, last](double fraction)
    {
      this->Done = std::max(this->Done, first + fraction * (last - first));
      return this->Remembering.Get()(this->Done);
    };
  }

  // Threads that end soon after a stop; what they made is then incomplete. An element costs as much
  // as `voxels` that are looked at once.
  FlipFree::ParallelFor Threads(double first, double last, std::ptrdiff_t voxels)
  {
    return [monitor = this->Part(first, last), voxels](std::ptrdiff_t begin, std::ptrdiff_t end,
             const FlipFree::RangeBody& body)
    { FlipFree::SMPForSlices(begin, end, voxels, monitor, body); };
  }

private:
  const FlipFree::Monitor Own;
  const FlipFree::RememberingMonitor Remembering{ this->Own };
  double Done = 0;
};

// A search line is about as expensive as looking at this many voxels in a row.
constexpr std::ptrdiff_t VoxelsPerVertex = 1000;

// For a feature without the field data: gives search lines of 40 mm by default.
constexpr double UsualSeedRadius = 25;

// How messages call the inputs.
constexpr const char* SearchedSurface = "the surface{ on port 0}";
constexpr const char* SearchedFeature = "the feature{ on port 1}";
constexpr const char* SearchedEdges = "the edge image{ on port 2}";

double ThresholdFor(double wanted, vtkImageData* feature)
{
  const std::vector<double> given =
    FlipFree::FieldValues("FeatureThreshold", 1, false, feature, SearchedFeature);
  if (wanted > 0)
  {
    return wanted;
  }
  return !given.empty() && given.front() > 0 ? given.front() : 0.5;
}

double SeedRadiusOf(vtkImageData* feature)
{
  const std::vector<double> radius =
    FlipFree::FieldValues("SeedRadius", 1, false, feature, SearchedFeature);
  return radius.empty() ? UsualSeedRadius : radius.front();
}

// With the feature's own ramp, if it has one.
FlipFree::TargetSettings SettingsFor(vtkImageData* feature, FlipFree::TargetSettings settings)
{
  const std::vector<double> ramp =
    FlipFree::FieldValues("EdgeRamp", 3, true, feature, SearchedFeature);
  if (ramp.size() == 3)
  {
    settings.Correspondence.Ramp = { ramp[0], ramp[1], ramp[2] };
  }
  return settings;
}

} // namespace

vtkStandardNewMacro(vtkCorrespondenceSearch);

struct vtkCorrespondenceSearch::Workspace
{
  FlipFree::ContourMeshCache Meshes;
  KeptImage Feature;
  KeptImage Edges;
  FlipFree::BitMask Foreground;
  FlipFree::BitMask NoData;
  // What they were made from; no version is 0.
  int Version = 0;
  double Threshold = 0;

  void UpdateEdges(vtkImageData* image)
  {
    this->Edges.Update(image, SearchedEdges);
    FlipFree::RequireSameGeometry(this->Edges.GetView().Geometry, this->Feature.GetView().Geometry,
      SearchedEdges, SearchedFeature);
  }

  void UpdateMasks(double threshold, Passes& passes)
  {
    const FlipFree::ImageView<float>& feature = this->Feature.GetView();
    if (this->Version == this->Feature.GetVersion() && this->Threshold == threshold)
    {
      return;
    }
    const auto& size = feature.Geometry.Dimensions;
    this->Foreground = FlipFree::VoxelsWhere(
      feature, [threshold](float value) { return value >= threshold; },
      passes.Threads(0, 0.2, static_cast<std::ptrdiff_t>(size[0]) * size[1]));
    this->NoData = FlipFree::FindNoData(FlipFree::ReaderOf(feature), feature.Geometry,
      passes.Threads(0.2, 0.4, static_cast<std::ptrdiff_t>(size[0]) * size[1]));
    this->Version = passes.IsStopped() ? 0 : this->Feature.GetVersion();
    this->Threshold = threshold;
  }
};

#define FLIPFREE_STAGE vtkCorrespondenceSearch

#define PROPERTIES(P)                                                                              \
  P(Threshold, double, Threshold, 0, 1, "")                                                        \
  FLIPFREE_TARGET_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkCorrespondenceSearch::vtkCorrespondenceSearch()
  : Settings(std::make_unique<FlipFree::TargetSettings>())
  , Kept(std::make_unique<Workspace>())
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
  for (int port = 1; port < 3; ++port)
  {
    FlipFree::RequestWholeExtent(inputVector[port]->GetInformationObject(0));
  }
  return 1;
}

int vtkCorrespondenceSearch::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkImageData* featureImage = vtkImageData::GetData(inputVector[1]);
  vtkImageData* edgeImage = vtkImageData::GetData(inputVector[2]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  try
  {
    this->RequireProperties();
    Passes passes(this);
    FlipFree::PointList copy;
    const auto points = FlipFree::ViewPoints(input, copy);
    const auto mesh = this->Kept->Meshes.MeshOf(input, points, SearchedSurface);
    this->Kept->Feature.Update(featureImage, SearchedFeature);
    this->Kept->UpdateMasks(ThresholdFor(this->Threshold, featureImage), passes);
    FlipFree::ImageView<float> edges;
    if (edgeImage && this->Settings->Correspondence.EdgeWindow > 0)
    {
      this->Kept->UpdateEdges(edgeImage);
      edges = this->Kept->Edges.GetView();
    }

    const double radius = SeedRadiusOf(featureImage);
    const FlipFree::TargetSettings settings = SettingsFor(featureImage, *this->Settings);
    FlipFree::TargetReport report;
    const FlipFree::CorrespondenceField field =
      FlipFree::FindTargets(*mesh, points, this->Kept->Foreground, this->Kept->NoData, edges,
        radius, settings, passes.Threads(0.4, 1, VoxelsPerVertex), report);
    if (passes.IsStopped())
    {
      return 1;
    }
    output->ShallowCopy(input);
    FlipFree::AttachField(field, output);
    FlipFree::AddFieldValues("MeanDistance", { report.MeanDistance }, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("No correspondence: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkCorrespondenceSearch::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
