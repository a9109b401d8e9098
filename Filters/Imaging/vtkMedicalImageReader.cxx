#include "vtkMedicalImageReader.h"

#include "DicomLibraries.h"
#include "ExecutionAdapter.h"
#include "ImageAdapter.h"
#include "PipelineAdapter.h"
#include "VolumeFile.h"
#include "VolumeHeader.h"

#include "Exchange/SegmentationLayers.h"

#include "Exchange/DicomChoice.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cstdlib>
#include <filesystem>

vtkStandardNewMacro(vtkMedicalImageReader);

/// What FileName has turned out to be. No volume: a single file.
struct vtkMedicalImageReader::Source
{
  FlipFree::DicomFolder Folder;
  const FlipFree::DicomVolume* Chosen = nullptr;
  std::string ChosenUID;
  FlipFree::VolumeHeader Header;
  FlipFree::LabelChoice Label;
};

namespace
{

/// An array without initial values that owns `bytes` of memory; null if there is not that much.
vtkSmartPointer<vtkDataArray> AllocateScalars(const FlipFree::VolumeHeader& header)
{
  void* voxels = std::malloc(header.NumberOfBytes());
  if (!voxels)
  {
    return nullptr;
  }
  auto scalars = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(header.ScalarType));
  scalars->SetName("ImageScalars");
  scalars->SetVoidArray(voxels, static_cast<vtkIdType>(header.Geometry.NumberOfVoxels()), 0,
    vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  return scalars;
}

// What the labels of a file's layer are called.
void AttachLabelNames(const FlipFree::VolumeFileHeader& file, int layer, vtkImageData* image)
{
  vtkNew<vtkDoubleArray> labels;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> colors;
  labels->SetName("SegmentLabels");
  names->SetName("SegmentNames");
  colors->SetName("SegmentColors");
  for (const FlipFree::Segment& segment : FlipFree::SegmentsOf(file))
  {
    if (segment.Layer == layer)
    {
      labels->InsertNextValue(segment.Label);
      names->InsertNextValue(segment.Name);
      colors->InsertNextValue(segment.Color);
    }
  }
  if (labels->GetNumberOfValues() > 0)
  {
    image->GetFieldData()->AddArray(labels);
    image->GetFieldData()->AddArray(names);
    image->GetFieldData()->AddArray(colors);
  }
}

} // namespace

vtkMedicalImageReader::vtkMedicalImageReader()
  : Found(new Source)
{
  this->SetNumberOfInputPorts(0);
}

vtkMedicalImageReader::~vtkMedicalImageReader()
{
  this->SetFileName(nullptr);
  this->SetSeriesUID(nullptr);
  this->SetSegment(nullptr);
}

int vtkMedicalImageReader::RequestInformation(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  *this->Found = Source();
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw FlipFree::ImageFileError(vtkErrorCode::NoFileNameError,
        "No FileName is set. Give a file, or the folder of a DICOM series.");
    }
    Source& found = *this->Found;
    const std::string name = this->FileName;
    const std::string segment = this->Segment ? this->Segment : "";
    const std::vector<std::string> dicom = FlipFree::DicomFilesOf(name);
    std::error_code ignored;
    if (!dicom.empty() || std::filesystem::is_directory(name, ignored))
    {
      found.Folder = FlipFree::ReadDicomFolder(name, dicom, FlipFree::DicomByLibraries(),
        FlipFree::MonitorOf(this, 0, 0.5));
      if (FlipFree::IsAborted(this))
      {
        return 0;
      }
      found.Chosen =
        &FlipFree::ChooseDicomVolume(found.Folder, this->SeriesUID ? this->SeriesUID : "");
      found.Label = FlipFree::ChooseLabel({}, 1, segment, name);
      const FlipFree::DicomVolume& volume = *found.Chosen;
      found.ChosenUID = volume.Identifier();
      found.Header = { volume.Geometry, FlipFree::ScalarTypeOf(volume.Type) };
      for (const std::string& warning :
        { volume.Warning, FlipFree::WarningOfLeftOut(found.Folder, volume) })
      {
        if (!warning.empty())
        {
          vtkWarningMacro(<< warning);
        }
      }
    }
    else
    {
      const FlipFree::VolumeFileHeader file = FlipFree::OpenVolumeFile(name);
      for (const std::string& warning : file.Warnings)
      {
        vtkWarningMacro(<< warning);
      }
      found.Header = { file.Geometry, FlipFree::ScalarTypeOf(file.ValueType()) };
      found.Label =
        FlipFree::ChooseLabel(FlipFree::SegmentsOf(file), file.Layers.Count, segment, name);
    }
  }
  catch (const std::exception& error)
  {
    return this->Fail(error, outInfo);
  }

  const FlipFree::VolumeHeader& header = this->Found->Header;
  FlipFree::AnnounceImage(header.Geometry, header.ScalarType, outInfo);
  return 1;
}

int vtkMedicalImageReader::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  const Source& found = *this->Found;
  const FlipFree::Monitor monitor = FlipFree::MonitorOf(this, found.Chosen ? 0.5 : 0, 1);
  try
  {
    vtkSmartPointer<vtkDataArray> scalars = AllocateScalars(found.Header);
    if (!scalars)
    {
      throw FlipFree::ImageFileError(vtkErrorCode::UnknownError,
        std::string("There is not enough memory for the ") +
          std::to_string(found.Header.NumberOfBytes() >> 20) + " MiB of voxels that '" +
          this->FileName + "' claims to have. Crop the image, or check its header.");
    }
    const std::string name = this->FileName;
    if (!found.Chosen)
    {
      const FlipFree::VolumeFileHeader file = FlipFree::OpenVolumeFile(name);
      if (file.Geometry.Dimensions != found.Header.Geometry.Dimensions ||
        FlipFree::ScalarTypeOf(file.ValueType()) != found.Header.ScalarType)
      {
        throw FlipFree::ImageFileError(vtkErrorCode::FileFormatError,
          "'" + name +
            "' has changed since its header was read. Call Modified() and update again.");
      }
      FlipFree::ReadVolumeFile(file, found.Label.Layer, scalars->GetVoidPointer(0), monitor);
      AttachLabelNames(file, found.Label.Layer, output);
    }
    else
    {
      FlipFree::ReadDicomVoxels(found.Folder, *found.Chosen, FlipFree::DicomByLibraries(),
        scalars->GetVoidPointer(0), monitor);
      vtkNew<vtkStringArray> uid;
      uid->SetName("SeriesUID");
      uid->InsertNextValue(found.ChosenUID);
      output->GetFieldData()->AddArray(uid);
    }
    if (FlipFree::IsAborted(this))
    {
      output->Initialize();
      return 1;
    }
    FlipFree::SetGeometry(output, found.Header.Geometry);
    output->GetPointData()->SetScalars(scalars);
    return 1;
  }
  catch (const std::exception& error)
  {
    return this->Fail(error, outputVector->GetInformationObject(0));
  }
}

int vtkMedicalImageReader::Fail(const std::exception& error, vtkInformation* outInfo)
{
  if (vtkImageData* stale = outInfo ? vtkImageData::GetData(outInfo) : nullptr)
  {
    stale->Initialize();
  }
  if (const auto* problem = dynamic_cast<const FlipFree::FileProblem*>(&error))
  {
    this->SetErrorCode(FlipFree::ErrorCodeOf(problem->GetKind()));
    vtkErrorMacro(<< problem->what());
  }
  else if (const auto* expected = dynamic_cast<const FlipFree::ImageFileError*>(&error))
  {
    this->SetErrorCode(expected->Code);
    vtkErrorMacro(<< expected->what());
  }
  else
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro(<< "'" << this->FileName << "' cannot be read (" << FlipFree::MessageOf(error)
                  << "). Check the file and the available memory.");
  }
  return 0;
}

int vtkMedicalImageReader::GetSegmentLabel()
{
  return this->Found->Label.Label.value_or(-1);
}

bool vtkMedicalImageReader::FindSeries()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  *this->Found = Source();
  this->Modified(); // nothing is chosen any more
  try
  {
    const std::string name = this->FileName ? this->FileName : "";
    const std::vector<std::string> files = FlipFree::DicomFilesOf(name);
    std::error_code ignored;
    if (files.empty() && !std::filesystem::is_directory(name, ignored))
    {
      throw FlipFree::FileProblem(FlipFree::FileProblem::Kind::Missing,
        "'" + name + "' is not a folder. Give the folder of DICOM files.");
    }
    this->Found->Folder = FlipFree::ReadDicomFolder(name, files, FlipFree::DicomByLibraries(),
      FlipFree::MonitorOf(this, 0, 1));
    if (FlipFree::IsAborted(this))
    {
      return false;
    }
    FlipFree::RequireDicomVolumes(this->Found->Folder);
    return true;
  }
  catch (const std::exception& error)
  {
    this->Fail(error, nullptr);
    return false;
  }
}

const FlipFree::DicomVolume* vtkMedicalImageReader::SeriesAt(int index)
{
  return index >= 0 && index < this->GetNumberOfSeries()
    ? &this->Found->Folder.Volumes[static_cast<std::size_t>(index)]
    : nullptr;
}

int vtkMedicalImageReader::GetNumberOfSeries()
{
  return static_cast<int>(this->Found->Folder.Volumes.size());
}

std::string vtkMedicalImageReader::GetSeriesUID(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? volume->Identifier() : std::string();
}

std::string vtkMedicalImageReader::GetSeriesNumber(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? volume->SeriesNumber : std::string();
}

std::string vtkMedicalImageReader::GetSeriesDescription(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? volume->Description : std::string();
}

std::string vtkMedicalImageReader::GetSeriesModality(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? volume->Modality : std::string();
}

std::string vtkMedicalImageReader::GetSeriesProblem(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? volume->Problem : std::string();
}

int vtkMedicalImageReader::GetSeriesNumberOfSlices(int index)
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  return volume ? static_cast<int>(volume->Frames.size()) : 0;
}

void vtkMedicalImageReader::GetSeriesSpacing(int index, double spacing[3])
{
  const FlipFree::DicomVolume* const volume = this->SeriesAt(index);
  const bool isKnown = volume && volume->Problem.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = isKnown ? volume->Geometry.Spacing[axis] : 0;
  }
}

const char* vtkMedicalImageReader::GetChosenSeriesUID()
{
  return this->Found->Chosen ? this->Found->ChosenUID.c_str() : nullptr;
}

void vtkMedicalImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "SeriesUID: " << (this->SeriesUID ? this->SeriesUID : "(the greatest)") << "\n";
  os << indent << "Segment: " << (this->Segment ? this->Segment : "(none)") << "\n";
  os << indent << "NumberOfSeries: " << this->GetNumberOfSeries() << "\n";
}
