#include "VolumeFile.h"

#include "Messages.h"
#include "Run.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMedicalImageReader.h"
#include "vtkMedicalImageWriter.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace Command
{

namespace
{

void Read(vtkMedicalImageReader* reader, const std::string& name)
{
  reader->SetFileName(name.c_str());
  const SilentLibraries silent;
  Run(reader, "reading");
}

} // namespace

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name, const std::string& seriesUID)
{
  RequireVolume(name, seriesUID);
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetSeriesUID(seriesUID.c_str());
  Read(reader, name);
  return reader->GetOutput();
}

ChosenLabels ReadLabels(const std::string& name, const std::string& label)
{
  RequireVolume(name, "");
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetSegment(label.c_str());
  Read(reader, name);
  return { reader->GetOutput(), reader->GetSegmentLabel() };
}

std::string SeriesOf(vtkImageData* image)
{
  auto* const uid =
    vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray("SeriesUID"));
  return uid && uid->GetNumberOfValues() == 1 ? uid->GetValue(0) : std::string();
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
