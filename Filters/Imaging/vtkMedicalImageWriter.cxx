#include "vtkMedicalImageWriter.h"

#include "ExecutionAdapter.h"
#include "ImageAdapter.h"
#include "SegmentFields.h"
#include "VolumeFileWriter.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

vtkStandardNewMacro(vtkMedicalImageWriter);

namespace
{

/// The scalars that can be written, or an ImageFileError.
vtkDataArray* RequireScalars(vtkImageData* image)
{
  const auto refuse = [](const std::string& message)
  { throw FlipFree::ImageFileError(vtkErrorCode::UnknownError, message); };
  if (!image || image->GetNumberOfPoints() == 0)
  {
    refuse("The image on input port 0 is empty. Connect an image with voxels.");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars)
  {
    refuse("The image on input port 0 has no scalars. Make one of its point arrays the scalars.");
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    refuse("The scalars of the image on input port 0 have " +
      std::to_string(scalars->GetNumberOfComponents()) +
      " components, but only one is supported. Extract one component.");
  }
  if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints() ||
    !scalars->HasStandardMemoryLayout())
  {
    refuse("The scalars of the image on input port 0 are not one plain array with a value for each "
           "voxel. Copy them into one.");
  }
  return scalars;
}

} // namespace

vtkMedicalImageWriter::vtkMedicalImageWriter() = default;

vtkMedicalImageWriter::~vtkMedicalImageWriter()
{
  this->SetFileName(nullptr);
}

int vtkMedicalImageWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkMedicalImageWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw FlipFree::ImageFileError(vtkErrorCode::NoFileNameError,
        "No FileName is set. Give the file to write.");
    }
    vtkImageData* image = vtkImageData::SafeDownCast(this->GetInput());
    vtkDataArray* scalars = RequireScalars(image);
    const FlipFree::VolumeHeader header{ FlipFree::GeometryOf(image), scalars->GetDataType() };
    const FlipFree::FileFields fields = FlipFree::IsSegmentation(this->FileName)
      ? FlipFree::SegmentFieldsOf(image, this->FileName)
      : FlipFree::FileFields();
    if (!FlipFree::WriteVolumeFile(this->FileName, header, scalars, fields, this->UseCompression,
          FlipFree::MonitorOf(this)))
    {
      this->SetErrorCode(vtkErrorCode::UserError); // aborted: no message, but Write() returns 0
    }
  }
  catch (const FlipFree::FileProblem& problem)
  {
    this->SetErrorCode(FlipFree::ErrorCodeOf(problem.GetKind()));
    vtkErrorMacro(<< problem.what());
  }
  catch (const FlipFree::ImageFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro(<< "'" << this->FileName << "' cannot be written (" << FlipFree::MessageOf(error)
                  << "). Check the folder and the available memory.");
  }
}

void vtkMedicalImageWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "UseCompression: " << this->UseCompression << "\n";
}
