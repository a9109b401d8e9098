#include "vtkPhantomSource.h"

#include "ExecutionAdapter.h"
#include "ImageAdapter.h"
#include "Phantom/AbdomenPhantom.h"
#include "Phantom/Phantom.h"
#include "PhantomSurface.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkPhantomSource);

namespace
{

FlipFree::ImageGeometry MakeGeometry(vtkPhantomSource* self)
{
  FlipFree::ImageGeometry geometry;
  self->GetDimensions(geometry.Dimensions.data());
  self->GetSpacing(geometry.Spacing.data());
  const bool abdomen = self->GetShape() == vtkPhantomSource::ABDOMEN;
  if (geometry.Dimensions == std::array<int, 3>{ { 0, 0, 0 } })
  {
    geometry.Dimensions =
      abdomen ? std::array<int, 3>{ { 220, 170, 90 } } : std::array<int, 3>{ { 96, 96, 96 } };
  }
  if (geometry.Spacing.isZero(0))
  {
    geometry.Spacing = abdomen ? Eigen::Vector3d(1.5, 1.5, 3) : Eigen::Vector3d(1, 1, 1);
  }
  geometry.Origin = Eigen::Vector3d(self->GetOrigin());
  geometry.Direction =
    Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(self->GetDirection());
  FlipFree::RequireGrid(geometry);
  return geometry;
}

FlipFree::Phantom MakePhantom(vtkPhantomSource* self, const FlipFree::ImageGeometry& geometry)
{
  const Eigen::Vector3d extent = FlipFree::GridExtent(geometry);
  if (self->GetShape() == vtkPhantomSource::ABDOMEN)
  {
    return FlipFree::MakeAbdomenPhantom(extent,
      { self->GetNumberOfLesions(), static_cast<std::uint64_t>(self->GetRandomSeed()) });
  }
  for (double intensity : { self->GetForeground(), self->GetBackground() })
  {
    if (!(intensity >= VTK_SHORT_MIN && intensity <= VTK_SHORT_MAX))
    {
      throw std::invalid_argument(
        "Foreground and Background must lie within -32768 to 32767, not " +
        std::to_string(intensity));
    }
  }
  return FlipFree::MakePlainPhantom(static_cast<FlipFree::PlainShape>(self->GetShape()), extent,
    self->GetForeground(), self->GetBackground());
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

} // namespace

vtkPhantomSource::vtkPhantomSource()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

bool vtkPhantomSource::GetSeed(int label, double seed[4])
{
  try
  {
    const FlipFree::ImageGeometry geometry = MakeGeometry(this);
    for (const FlipFree::PhantomSeed& organ : MakePhantom(this, geometry).Seeds)
    {
      if (organ.Label == label)
      {
        CopyBall(geometry, organ.Start, seed);
        return true;
      }
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("No seed: " << error.what());
  }
  return false;
}

bool vtkPhantomSource::GetEnclosingSphere(double sphere[4])
{
  try
  {
    const FlipFree::ImageGeometry geometry = MakeGeometry(this);
    const FlipFree::Phantom phantom = MakePhantom(this, geometry);
    if (phantom.Enclosing)
    {
      CopyBall(geometry, *phantom.Enclosing, sphere);
      return true;
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("No enclosing sphere: " << error.what());
  }
  return false;
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
  FlipFree::ImageGeometry geometry;
  try
  {
    geometry = MakeGeometry(this);
  }
  catch (const std::exception& error)
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(outputVector, port)->Initialize();
    }
    vtkErrorMacro("No phantom: " << error.what());
    return 0;
  }
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> direction = geometry.Direction;
  const int extent[6] = { 0, geometry.Dimensions[0] - 1, 0, geometry.Dimensions[1] - 1, 0,
    geometry.Dimensions[2] - 1 };
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::SPACING(), geometry.Spacing.data(), 3);
    info->Set(vtkDataObject::ORIGIN(), geometry.Origin.data(), 3);
    info->Set(vtkDataObject::DIRECTION(), direction.data(), 9);
    vtkDataObject::SetPointDataActiveScalarInfo(info, port == 0 ? VTK_SHORT : VTK_UNSIGNED_CHAR, 1);
  }
  return 1;
}

int vtkPhantomSource::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(outputVector, 0);
  vtkImageData* labelMap = vtkImageData::GetData(outputVector, 1);
  try
  {
    const FlipFree::ImageGeometry geometry = MakeGeometry(this);
    const FlipFree::Phantom phantom = MakePhantom(this, geometry);
    FlipFree::SamplingOptions options;
    options.PartialVolume = this->PartialVolume;
    options.NoiseStandardDeviation = this->NoiseStandardDeviation;
    options.NoiseCorrelation = this->NoiseCorrelation;
    options.Seed = static_cast<std::uint64_t>(this->RandomSeed);
    short* intensities = AttachScalars<vtkShortArray>(image, geometry, "Intensity");
    unsigned char* labels = AttachScalars<vtkUnsignedCharArray>(labelMap, geometry, "Labels");
    if (!FlipFree::SampleTissues(phantom.Tissues, geometry, options, intensities, labels,
          FlipFree::SMPFor, FlipFree::MonitorOf(this)))
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
    vtkErrorMacro("No phantom: " << error.what());
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
