#include "vtkMedicalImageReader.h"

#include "DicomSeries.h"
#include "ExecutionAdapter.h"
#include "ImageAdapter.h"
#include "PipelineAdapter.h"
#include "VolumeFile.h"

#include "vtkDataArray.h"
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

/// What FileName has turned out to be. No series: a single file.
struct vtkMedicalImageReader::Source
{
  std::vector<FlipFree::DicomSeries> Series;
  std::size_t Chosen = 0;
  FlipFree::VolumeHeader Header;
};

namespace
{

std::size_t ChooseSeries(const std::vector<FlipFree::DicomSeries>& list, const char* uid,
  const std::string& folder)
{
  if (!uid || !*uid)
  {
    return 0; // the one with most files
  }
  std::string known;
  for (std::size_t index = 0; index < list.size(); ++index)
  {
    if (list[index].UID == uid)
    {
      return index;
    }
    known += (index ? ", " : "") + list[index].UID;
  }
  throw FlipFree::ImageFileError(vtkErrorCode::FileNotFoundError,
    "The folder '" + folder + "' holds no series with the SeriesUID " + uid + ". It holds " +
      known + ".");
}

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
    std::error_code ignored;
    if (std::filesystem::is_directory(name, ignored))
    {
      found.Series = FlipFree::ListDicomSeries(name, FlipFree::MonitorOf(this, 0, 0.5));
      if (FlipFree::IsAborted(this))
      {
        return 0;
      }
      found.Chosen = ChooseSeries(found.Series, this->SeriesUID, name);
      std::string warning;
      found.Header = FlipFree::HeaderOfSeries(found.Series[found.Chosen], warning);
      if (!warning.empty())
      {
        vtkWarningMacro(<< warning);
      }
    }
    else
    {
      found.Header = FlipFree::HeaderOf(FlipFree::OpenVolumeFile(name), name);
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
  const FlipFree::Monitor monitor = FlipFree::MonitorOf(this, found.Series.empty() ? 0 : 0.5, 1);
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
    if (found.Series.empty())
    {
      const auto io = FlipFree::OpenVolumeFile(name);
      if (FlipFree::HeaderOf(io, name).NumberOfBytes() != found.Header.NumberOfBytes())
      {
        throw FlipFree::ImageFileError(vtkErrorCode::FileFormatError,
          "'" + name +
            "' has changed since its header was read. Call Modified() and update again.");
      }
      FlipFree::ReadVolumeFile(io, name, scalars, monitor);
    }
    else
    {
      const FlipFree::DicomSeries& series = found.Series[found.Chosen];
      FlipFree::ReadSeriesVoxels(series, found.Header, scalars->GetVoidPointer(0), monitor);
      vtkNew<vtkStringArray> uid;
      uid->SetName("SeriesUID");
      uid->InsertNextValue(series.UID);
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
  if (vtkImageData* stale = vtkImageData::GetData(outInfo))
  {
    stale->Initialize();
  }
  if (const auto* expected = dynamic_cast<const FlipFree::ImageFileError*>(&error))
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

int vtkMedicalImageReader::GetNumberOfSeries()
{
  return static_cast<int>(this->Found->Series.size());
}

const char* vtkMedicalImageReader::GetSeriesUID(int index)
{
  return index >= 0 && index < this->GetNumberOfSeries() ? this->Found->Series[index].UID.c_str()
                                                         : nullptr;
}

const char* vtkMedicalImageReader::GetSeriesDescription(int index)
{
  return index >= 0 && index < this->GetNumberOfSeries()
    ? this->Found->Series[index].Description.c_str()
    : nullptr;
}

int vtkMedicalImageReader::GetSeriesNumberOfFiles(int index)
{
  return index >= 0 && index < this->GetNumberOfSeries()
    ? static_cast<int>(this->Found->Series[index].Slices.size())
    : 0;
}

const char* vtkMedicalImageReader::GetChosenSeriesUID()
{
  return this->GetSeriesUID(static_cast<int>(this->Found->Chosen));
}

void vtkMedicalImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "SeriesUID: " << (this->SeriesUID ? this->SeriesUID : "(most files)") << "\n";
  os << indent << "NumberOfSeries: " << this->GetNumberOfSeries() << "\n";
}
