#include "vtkPhantomSource.h"

#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "ImageAdapter.h"
#include "Phantom/PhantomVolume.h"
#include "PhantomSurface.h"
#include "PipelineAdapter.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkPhantomSource);

namespace
{

static_assert(vtkPhantomSource::ABDOMEN == FlipFree::AbdomenShape,
  "the public enumeration follows the kernel's");

FlipFree::PhantomSettings SettingsOf(vtkPhantomSource* self)
{
  FlipFree::PhantomSettings settings;
  settings.Shape = self->GetShape();
  self->GetDimensions(settings.Dimensions.data());
  settings.Spacing = Eigen::Vector3d(self->GetSpacing());
  settings.Origin = Eigen::Vector3d(self->GetOrigin());
  std::copy_n(self->GetDirection(), 9, settings.Direction.data());
  settings.Foreground = self->GetForeground();
  settings.Background = self->GetBackground();
  settings.NoiseStandardDeviation = self->GetNoiseStandardDeviation();
  settings.NoiseCorrelation = self->GetNoiseCorrelation();
  settings.RandomSeed = self->GetRandomSeed();
  settings.NumberOfLesions = self->GetNumberOfLesions();
  settings.PartialVolume = self->GetPartialVolume();
  return settings;
}

void CopyBall(const FlipFree::ImageGeometry& geometry, const FlipFree::Ball& ball, double sphere[4])
{
  const Eigen::Vector3d center = FlipFree::GridToPhysical(geometry, ball.Center);
  std::copy_n(center.data(), 3, sphere);
  sphere[3] = ball.Radius;
}

template <typename ArrayType>
auto* AttachScalars(vtkImageData* image, const FlipFree::ImageGeometry& geometry, const char* name)
{
  FlipFree::SetGeometry(image, geometry);
  vtkNew<ArrayType> values;
  values->SetName(name);
  values->SetNumberOfValues(static_cast<vtkIdType>(geometry.NumberOfVoxels()));
  image->GetPointData()->SetScalars(values);
  return values->GetPointer(0);
}

// Copies a part of the phantom; false where it has none, and an error where it cannot be made.
template <typename Copy>
bool CopyOf(vtkPhantomSource* source, const char* what, const Copy& copy)
{
  try
  {
    const FlipFree::PhantomSettings settings = SettingsOf(source);
    const FlipFree::ImageGeometry geometry = FlipFree::GridOf(settings);
    return copy(FlipFree::PhantomOf(settings, geometry), geometry);
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(source, "No " << what << ": " << FlipFree::MessageOf(error) << ".");
    return false;
  }
}

} // namespace

vtkPhantomSource::vtkPhantomSource()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

bool vtkPhantomSource::GetSeed(int label, double seed[4])
{
  return CopyOf(this, "seed",
    [=](const FlipFree::Phantom& phantom, const FlipFree::ImageGeometry& geometry)
    {
      for (const FlipFree::PhantomSeed& organ : phantom.Seeds)
      {
        if (organ.Label == label)
        {
          CopyBall(geometry, organ.Start, seed);
          return true;
        }
      }
      return false;
    });
}

bool vtkPhantomSource::GetEnclosingSphere(double sphere[4])
{
  return CopyOf(this, "enclosing sphere",
    [=](const FlipFree::Phantom& phantom, const FlipFree::ImageGeometry& geometry)
    {
      if (phantom.Enclosing)
      {
        CopyBall(geometry, *phantom.Enclosing, sphere);
      }
      return phantom.Enclosing.has_value();
    });
}

bool vtkPhantomSource::GetVesselEnds(double ends[6])
{
  return CopyOf(this, "ends of a vessel",
    [=](const FlipFree::Phantom& phantom, const FlipFree::ImageGeometry& geometry)
    {
      if (phantom.Ends)
      {
        double* next = ends;
        for (const Eigen::Vector3d& end : *phantom.Ends)
        {
          const Eigen::Vector3d place = FlipFree::GridToPhysical(geometry, end);
          next = std::copy_n(place.data(), 3, next);
        }
      }
      return phantom.Ends.has_value();
    });
}

vtkImageData* vtkPhantomSource::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPolyData* vtkPhantomSource::GetSurface()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkPhantomSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

int vtkPhantomSource::RequestInformation(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  FlipFree::ImageGeometry geometry;
  try
  {
    geometry = FlipFree::GridOf(SettingsOf(this));
  }
  catch (const std::exception& error)
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(outputVector, port)->Initialize();
    }
    FlipFreeErrorMacro("No phantom: ", error, ".");
    return 0;
  }
  FlipFree::AnnounceImage(geometry, VTK_SHORT, outputVector->GetInformationObject(0));
  FlipFree::AnnounceImage(geometry, VTK_UNSIGNED_CHAR, outputVector->GetInformationObject(1));
  return 1;
}

int vtkPhantomSource::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* image = vtkImageData::GetData(outputVector, 0);
  vtkImageData* labelMap = vtkImageData::GetData(outputVector, 1);
  try
  {
    const FlipFree::PhantomSettings settings = SettingsOf(this);
    const FlipFree::ImageGeometry geometry = FlipFree::GridOf(settings);
    const FlipFree::Phantom phantom = FlipFree::PhantomOf(settings, geometry);
    short* intensities = AttachScalars<vtkShortArray>(image, geometry, "Intensity");
    unsigned char* labels = AttachScalars<vtkUnsignedCharArray>(labelMap, geometry, "Labels");
    if (!FlipFree::SampleTissues(phantom.Tissues, geometry, FlipFree::SamplingOf(settings),
          intensities, labels, FlipFree::SMPFor, FlipFree::MonitorOf(this)))
    {
      image->Initialize();
      labelMap->Initialize();
      return 1;
    }
    if (this->GenerateSurface && phantom.Surface)
    {
      vtkPolyData::GetData(outputVector, 2)
        ->ShallowCopy(FlipFree::MakePhantomSurface(phantom.Surface, *phantom.Enclosing, geometry));
    }
  }
  catch (const std::exception& error)
  {
    image->Initialize();
    labelMap->Initialize();
    FlipFreeErrorMacro("No phantom: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkPhantomSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "Spacing: " << this->Spacing[0] << " " << this->Spacing[1] << " "
     << this->Spacing[2] << "\n";
  os << indent << "Origin: " << this->Origin[0] << " " << this->Origin[1] << " " << this->Origin[2]
     << "\n";
  os << indent << "Direction:";
  for (double entry : this->Direction)
  {
    os << " " << entry;
  }
  os << "\n";
  os << indent << "Foreground: " << this->Foreground << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "NoiseStandardDeviation: " << this->NoiseStandardDeviation << "\n";
  os << indent << "NoiseCorrelation: " << this->NoiseCorrelation << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
  os << indent << "NumberOfLesions: " << this->NumberOfLesions << "\n";
  os << indent << "PartialVolume: " << this->PartialVolume << "\n";
  os << indent << "GenerateSurface: " << this->GenerateSurface << "\n";
}
