#include "OtherRequests.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Subcommands.h"
#include "VolumeFile.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPhantomSource.h"

#include <filesystem>
#include <string>

namespace Command
{
void MakePhantom(const PhantomRequest& phantom)
{
  if (phantom.Quiet)
  {
    ProgressBar::Disable();
  }
  const int shape = SettingsOf(phantom).Shape;
  const OutputFolder made(phantom.Folder);
  const std::string stem = (std::filesystem::path(phantom.Folder) / phantom.Name).string();
  const std::string gray = stem + ".nii.gz";
  const std::string truth = stem + "-truth.nii.gz";
  OutputFiles outputs;
  outputs.Announce("--output", gray);
  outputs.Announce("--output", truth);

  vtkNew<vtkPhantomSource> source;
  source->SetShape(shape); // the kernels number them alike
  source->SetDimensions(phantom.Dimensions[0], phantom.Dimensions[1], phantom.Dimensions[2]);
  source->SetSpacing(phantom.Spacing[0], phantom.Spacing[1], phantom.Spacing[2]);
  source->SetNoiseStandardDeviation(phantom.Noise);
  source->SetRandomSeed(phantom.RandomSeed);
  source->SetNumberOfLesions(phantom.Lesions);
  Run(source, "drawing");
  outputs.Write(gray, [&](const std::string& name) { WriteVolume(name, source->GetOutput()); });
  outputs.Write(truth, [&](const std::string& name) { WriteVolume(name, source->GetLabelMap()); });
  outputs.Commit();
  if (!phantom.Quiet)
  {
    PrintSummary(PhantomText(phantom));
  }
}

} // namespace Command
