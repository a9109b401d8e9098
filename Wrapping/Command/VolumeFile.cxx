#include "VolumeFile.h"

#include "Failure.h"
#include "Messages.h"
#include "Run.h"
#include "UnreadableFile.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMedicalImageReader.h"
#include "vtkMedicalImageWriter.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <filesystem>

namespace Command
{

const std::vector<std::string>& VolumeEndings()
{
  static const std::vector<std::string> endings{ ".nii.gz", ".nii", ".nrrd", ".mha" };
  return endings;
}

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name, const std::string& seriesUID)
{
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(name, ignored);
  if (!folder && !std::filesystem::exists(name, ignored))
  {
    throw UnreadableFile(name);
  }
  if (!folder && !seriesUID.empty())
  {
    throw WrongUsage("--series selects a series of a DICOM folder, but '" + name +
      "' is a file. Omit the option, or give the folder.");
  }
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->SetSeriesUID(seriesUID.c_str());
  const SilentLibraries silent;
  Run(reader, "reading");
  return reader->GetOutput();
}

std::string SeriesOf(vtkImageData* image)
{
  auto* const uid =
    vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray("SeriesUID"));
  return uid && uid->GetNumberOfValues() == 1 ? uid->GetValue(0) : std::string();
}

std::string InputTitle(const std::string& name, const std::string& seriesUID)
{
  return name + (seriesUID.empty() ? "" : ", series " + seriesUID);
}

void WriteVolume(const std::string& name, vtkImageData* image)
{
  vtkNew<vtkMedicalImageWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  const SilentLibraries silent;
  Run(writer, "writing", {}, [&writer]() { writer->Write(); });
}

} // namespace Command
