#include "vtkGMMFeatureFilter.h"

#include "Deformation/SegmentationParameters.h"
#include "Evidence/CarvedForeground.h"
#include "Evidence/OrganCarving.h"
#include "FieldData.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "Intensity/ModelFit.h"
#include "Intensity/OrganFeature.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"
#include "SurfaceAdapter.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkGMMFeatureFilter);

namespace
{

FlipFree::PolygonalSurface ClosedSurfaceOf(vtkPolyData* data)
{
  const char* const name = "the surface{ on port 1}";
  FlipFree::PolygonalSurface surface = FlipFree::SurfaceOf(data, name);
  FlipFree::RequireClosed(static_cast<int>(surface.Points.rows()), surface.Triangles, name);
  return surface;
}

FlipFree::Refit RefitTo(vtkPolyData* surface, const FlipFree::ImageView<float>& smooth,
  double noise, const FlipFree::IntensitySettings& settings, const FlipFree::Monitor& monitor,
  FlipFree::IntensityModel& model)
{
  const FlipFree::PolygonalSurface inside = ClosedSurfaceOf(surface);
  const FlipFree::Refit refit = FlipFree::RefitToSurface(smooth, inside.Points, inside.Triangles,
    noise, settings, FlipFree::SMPFor, monitor, model);
  if (refit == FlipFree::Refit::NothingInside)
  {
    throw FlipFree::Error(FlipFree::ErrorCode::EmptyMask,
      "the surface{ on port 1} holds no voxel of the image{ on port 0}; "
      "check that both are in the same physical coordinates");
  }
  return refit;
}

bool Carve(vtkPolyData* surface, const FlipFree::ImageView<float>& smooth,
  const FlipFree::SeedSphere& seed, double noise, const FlipFree::OrganFeatureSettings& settings,
  const FlipFree::Monitor& monitor, FlipFree::BitMask& foreground)
{
  const FlipFree::PolygonalSurface closed = ClosedSurfaceOf(surface);
  FlipFree::CarvedForegroundInputs inputs;
  inputs.Smooth = smooth;
  inputs.EnsureSmoothed = [](const FlipFree::VoxelBox&) { return true; };
  inputs.Points = &closed.Points;
  inputs.Triangles = &closed.Triangles;
  inputs.Seed = seed;
  inputs.Noise = noise;
  inputs.Settings = settings;
  inputs.Settings.Modality =
    FlipFree::ResolveModality(settings.Modality, FlipFree::ReaderOf(smooth), smooth.Geometry);
  FlipFree::CarvedForeground carved;
  if (!FlipFree::CarveForeground(inputs, FlipFree::SMPFor, monitor, carved))
  {
    return false;
  }
  foreground = std::move(carved.Mask);
  return true;
}

// By carving the inside of a surface, or without one by the model, which must show contrast if it
// is the seed's. False if the monitor stopped it.
bool FindOrgan(vtkPolyData* toCarve, const FlipFree::ImageView<float>& smooth,
  const FlipFree::IntensityModel& model, bool isOfSeed, const FlipFree::SeedSphere& seed,
  double noise, const FlipFree::OrganFeatureSettings& settings, const FlipFree::Monitor& monitor,
  FlipFree::BitMask& foreground)
{
  if (!monitor(0.4))
  {
    return false;
  }
  const FlipFree::Monitor part = FlipFree::PartOf(monitor, 0.4, 0.9);
  if (toCarve)
  {
    return Carve(toCarve, smooth, seed, noise, settings, part, foreground);
  }
  if (!FlipFree::FindForeground(smooth, model, seed, settings, FlipFree::SMPFor, part,
        foreground) ||
    !monitor(0.9))
  {
    return false;
  }
  if (isOfSeed)
  {
    FlipFree::RequireContrast(foreground);
  }
  return true;
}

void AttachModel(const FlipFree::IntensityModel& model, vtkImageData* output)
{
  std::vector<double> weights;
  std::vector<double> means;
  std::vector<double> deviations;
  for (const FlipFree::Gaussian& component : model.Mixture.Components)
  {
    weights.push_back(component.Weight);
    means.push_back(component.Mean);
    deviations.push_back(component.StandardDeviation);
  }
  FlipFree::AddFieldValues("FeatureThreshold", { model.Threshold }, output);
  FlipFree::AddFieldValues("MixtureWeights", weights, output);
  FlipFree::AddFieldValues("MixtureMeans", means, output);
  FlipFree::AddFieldValues("MixtureStandardDeviations", deviations, output);
  FlipFree::AddFieldValues("EdgeRamp", { model.Ramp.Low, model.Ramp.High, model.Ramp.Width },
    output);
}

} // namespace

#define FLIPFREE_STAGE vtkGMMFeatureFilter

#define PROPERTIES(P) FLIPFREE_FEATURE_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

void vtkGMMFeatureFilter::SetSeedRadius(double value)
{
  FlipFree::SetSeedRadius(this, value, this->SeedRadius);
}

vtkGMMFeatureFilter::vtkGMMFeatureFilter()
  : Settings(std::make_unique<FlipFree::OrganFeatureSettings>())
{
  this->SetNumberOfInputPorts(2);
}

vtkGMMFeatureFilter::~vtkGMMFeatureFilter() = default;

void vtkGMMFeatureFilter::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY) });
}

void vtkGMMFeatureFilter::SetSurfaceData(vtkPolyData* surface)
{
  this->SetInputDataObject(1, surface);
}

int vtkGMMFeatureFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkPolyData");
  info->Set(INPUT_IS_OPTIONAL(), port == 1);
  return 1;
}

int vtkGMMFeatureFilter::RequestInformation(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputVector->GetInformationObject(0), VTK_FLOAT, 1);
  return 1;
}

int vtkGMMFeatureFilter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector*)
{
  FlipFree::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkGMMFeatureFilter::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  try
  {
    this->RequireProperties();
    this->ComputeFeature(vtkImageData::GetData(inputVector[0]),
      vtkPolyData::GetData(inputVector[1]), output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("No feature: ", error, ".");
    return 0;
  }
  return 1;
}

// Returns with an empty output when it is aborted.
void vtkGMMFeatureFilter::ComputeFeature(vtkImageData* image, vtkPolyData* surface,
  vtkImageData* output)
{
  const FlipFree::SeedSphere seed{ Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::RequireGrayImage(image, "the image{ on port 0}");
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::RequireSeed(geometry, seed, "the image{ on port 0}");
  const std::vector<double> given =
    FlipFree::FieldValues("NoiseStandardDeviation", 1, false, image, "the image{ on port 0}");
  const FlipFree::Monitor whole = FlipFree::MonitorOf(this);
  FlipFree::FloatImage copy;
  const FlipFree::ImageView<float> smooth = FlipFree::GrayViewOf(image, copy);
  if (!whole(0.08))
  {
    return;
  }
  const double noise =
    given.empty() ? FlipFree::NoiseStandardDeviation(smooth, seed) : given.front();
  FlipFree::IntensityModel model =
    FlipFree::FitToSeed(smooth, seed, noise, this->Settings->Intensity);
  FlipFree::Refit refit = FlipFree::Refit::TooFewInside; // of no surface
  if (whole(0.1) && surface && this->Settings->ReestimateIntensities)
  {
    refit = RefitTo(surface, smooth, noise, this->Settings->Intensity,
      FlipFree::PartOf(whole, 0.1, 0.4), model);
    if (refit == FlipFree::Refit::TooFewInside)
    {
      FlipFreeWarningMacro("The surface{ on port 1} has no more than " +
        std::to_string(FlipFree::MinimumRefitSample) + " voxels that are more than " +
        FlipFree::TextOf(this->Settings->Intensity.InnerMargin) +
        " mm inside, too few to model the organ, so its intensities are those of the seed; "
        "enlarge the surface, or disconnect it.");
    }
  }
  FlipFree::BitMask foreground;
  vtkPolyData* const toCarve = this->Settings->Carving ? surface : nullptr;
  if (!FindOrgan(toCarve, smooth, model, refit != FlipFree::Refit::Done, seed, noise,
        *this->Settings, whole, foreground))
  {
    return;
  }
  const double radius = toCarve ? FlipFree::RadiusOf(foreground, seed) : seed.Radius;
  const std::vector<float> feature =
    FlipFree::MakeFeature(smooth, model, foreground, FlipFree::SMPFor);
  if (whole(0.97))
  {
    output->CopyStructure(image);
    FlipFree::SetFloatScalars("Feature", feature, output);
    FlipFree::AddFieldValues("SeedRadius", { radius }, output);
    AttachModel(model, output);
  }
}

void vtkGMMFeatureFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
