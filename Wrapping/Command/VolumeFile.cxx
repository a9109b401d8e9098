#include "VolumeFile.h"

#include "Failure.h"
#include "Messages.h"
#include "Run.h"
#include "UnreadableFile.h"

#include "Exchange/DicomReading.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMedicalImageReader.h"
#include "vtkMedicalImageWriter.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <cstdlib>
#include <filesystem>
#include <limits>

namespace Command
{

const std::vector<std::string>& VolumeEndings()
{
  static const std::vector<std::string> endings{ ".nii.gz", ".nii", ".nrrd", ".mha" };
  return endings;
}

namespace
{

void Read(vtkMedicalImageReader* reader, const std::string& name)
{
  reader->SetFileName(name.c_str());
  const SilentLibraries silent;
  Run(reader, "reading");
}

} // namespace

bool MayHoldSeries(const std::string& name)
{
  std::error_code ignored;
  return std::filesystem::is_directory(name, ignored) || !FlipFree::DicomFilesOf(name).empty();
}

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name, const std::string& seriesUID)
{
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored))
  {
    throw UnreadableFile(name);
  }
  if (!seriesUID.empty() && !MayHoldSeries(name))
  {
    throw WrongUsage("--series selects a series of a DICOM folder, but '" + name +
      "' is a file. Omit the option, or give the folder.");
  }
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetSeriesUID(seriesUID.c_str());
  Read(reader, name);
  return reader->GetOutput();
}

ChosenLabels ReadLabels(const std::string& name, const std::string& label)
{
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored))
  {
    throw UnreadableFile(name);
  }
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetSegment(label.c_str());
  Read(reader, name);
  return { reader->GetOutput(), reader->GetSegmentLabel() };
}

bool IsLabel(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool isNumber = *end == '\0';
  const bool isValue = text.find_first_not_of("0123456789") == std::string::npos &&
    number <= std::numeric_limits<int>::max();
  return !text.empty() && (!isNumber || isValue);
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
