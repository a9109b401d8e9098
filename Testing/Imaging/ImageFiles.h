/// Reading and writing single files in the tests of formats.
#ifndef FlipFreeImageFiles_h
#define FlipFreeImageFiles_h

#include "ExampleImages.h"

#include "vtkErrorCode.h"
#include "vtkMedicalImageReader.h"
#include "vtkMedicalImageWriter.h"

namespace ImageFiles
{

inline const std::string Endings[] = { ".nii", ".nii.gz", ".nrrd", ".mha", ".mhd" };

inline int Write(vtkImageData* image, const std::string& name, bool compress = true)
{
  vtkNew<vtkMedicalImageWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetUseCompression(compress);
  return writer->Write();
}

inline vtkSmartPointer<vtkImageData> Read(const std::string& name)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::NoError);
  vtkSmartPointer<vtkImageData> image = reader->GetOutput();
  return image;
}

inline void ExpectRefusal(const std::string& name, const std::vector<std::string>& words)
{
  SCOPED_TRACE(name);
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  ExampleImages::ExpectRefusal(reader, words, [&reader]() { reader->Update(); });
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(reader->GetErrorCode(), vtkErrorCode::NoError);
}

inline void ExpectWriteRefusal(vtkImageData* image, const std::string& name,
  const std::vector<std::string>& words)
{
  SCOPED_TRACE(name);
  vtkNew<vtkMedicalImageWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  ExampleImages::ExpectRefusal(writer, words, [&writer]() { EXPECT_EQ(writer->Write(), 0); });
}

} // namespace ImageFiles

#endif
