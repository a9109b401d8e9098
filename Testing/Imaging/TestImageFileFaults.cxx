// What cannot be written or read to its end: the former file stays, or none.
#include "ImageFiles.h"

#include "vtkCallbackCommand.h"

#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <unistd.h>

namespace
{

using ImageFiles::ExpectWriteRefusal;
using ImageFiles::Read;
using ImageFiles::Write;

TEST(TestImageFileFaults, WriterRefusesWhatItCannotWrite)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ExpectWriteRefusal(image, "", { "FileName" });
  ExpectWriteRefusal(image, folder / "image.png", { "image.png", "extension" });
  ExpectWriteRefusal(image, folder / "missing/image.nrrd", { "missing", "Create" });
  ExpectWriteRefusal(image, "/proc/image.nii.gz", { "/proc", "permissions" });
  ExampleImages::WriteBytes(folder / "file", "");
  ExpectWriteRefusal(image, folder / "file/image.nii.gz", { "file" });

  vtkNew<vtkImageData> empty;
  ExpectWriteRefusal(empty, folder / "image.nrrd", { "port 0", "empty" });
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 3, 3);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "port 0", "no scalars" });
  bare->AllocateScalars(VTK_SHORT, 3);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "port 0", "3 components" });
  bare->AllocateScalars(VTK_BIT, 1);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "bit" });
  std::filesystem::create_directory(folder / "taken.nrrd");
  ExpectWriteRefusal(image, folder / "taken.nrrd", { "taken.nrrd" });
  EXPECT_EQ(folder.NumberOfFiles(), 2);
}

TEST(TestImageFileFaults, FolderWithoutPermission)
{
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "The superuser may write everywhere.";
  }
  ExampleImages::Folder folder;
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_read);
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ExpectWriteRefusal(image, folder / "closed/image.nii.gz", { "closed", "permissions" });
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
}

TEST(TestImageFileFaults, FullDiskLeavesTheFormerFile)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(40, 65536);

  // To the writer, a limit on the size of files looks like a disk that has become full.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
  rlimit limited = unlimited;
  for (const rlim_t limit : { 0, 100, 50000, 120000 })
  {
    for (const std::string& ending : ImageFiles::Endings)
    {
      for (const bool compress : { true, false })
      {
        SCOPED_TRACE(ending + " in " + std::to_string(limit));
        ExampleImages::WriteBytes(folder / ("image" + ending), "former");
        const auto files = folder.NumberOfFiles();
        vtkNew<vtkMedicalImageWriter> writer;
        ExampleImages::Errors errors(writer);
        writer->SetInputData(image);
        writer->SetFileName((folder / ("image" + ending)).c_str());
        writer->SetUseCompression(compress);
        limited.rlim_cur = limit;
        setrlimit(RLIMIT_FSIZE, &limited);
        const int written = writer->Write();
        setrlimit(RLIMIT_FSIZE, &unlimited);
        if (limit == 120000 && written) // noise, packed, may just fit
        {
          ExampleImages::ExpectSameVoxels(Read(folder / ("image" + ending)), image);
          continue;
        }
        EXPECT_EQ(errors.Count(), 1);
        EXPECT_NE(errors.Message().find("full"), std::string::npos) << errors.Message();
        EXPECT_EQ(ExampleImages::ReadBytes(folder / ("image" + ending)), "former");
        EXPECT_EQ(folder.NumberOfFiles(), files);
      }
    }
  }
}

void AbortSoon(vtkObject* caller, unsigned long, void*, void*)
{
  vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
}

TEST(TestImageFileFaults, AbortReadingAndWriting)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii.gz"), 1);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(AbortSoon);

  vtkNew<vtkMedicalImageReader> reader;
  ExampleImages::Errors errors(reader);
  reader->SetFileName((folder / "image.nii.gz").c_str());
  reader->AddObserver(vtkCommand::ProgressEvent, abort);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.Count(), 0);

  vtkNew<vtkMedicalImageWriter> writer;
  ExampleImages::Errors writerErrors(writer);
  writer->SetInputData(image);
  writer->SetFileName((folder / "copy.nii.gz").c_str());
  writer->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_EQ(writerErrors.Count(), 0);
  EXPECT_EQ(folder.NumberOfFiles(), 1);
}

} // namespace
