#include "Failure.h"
#include "Messages.h"
#include "Options.h"
#include "OutputFile.h"
#include "Phantom/PhantomVolume.h"
#include "ProgressBar.h"
#include "Run.h"
#include "Subcommands.h"
#include "VolumeFile.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPhantomSource.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <vector>

namespace Command
{
namespace
{

struct Phantom
{
  std::string Name;
  std::string Folder;
  std::array<int, 3> Dimensions{ { 0, 0, 0 } };
  std::array<double, 3> Spacing{ { 0, 0, 0 } };
  double Noise = 0;
  int RandomSeed = 0;
  int Lesions = 0;
  bool Quiet = false;
};

const std::map<std::string, int>& Shapes()
{
  static const std::map<std::string, int> shapes{
    { "sphere", vtkPhantomSource::SPHERE },
    { "cube", vtkPhantomSource::CUBE },
    { "cup", vtkPhantomSource::CUP },
    { "u-tube", vtkPhantomSource::U_TUBE },
    { "vessel", vtkPhantomSource::VESSEL },
    { "abdomen", vtkPhantomSource::ABDOMEN },
  };
  return shapes;
}

/// Those that may have a seed; the liver, which most start with, first.
std::vector<int> LabelsOf(int shape)
{
  if (shape != vtkPhantomSource::ABDOMEN)
  {
    return { vtkPhantomSource::OBJECT };
  }
  std::vector<int> labels{ vtkPhantomSource::LIVER };
  for (int label = 1; label <= vtkPhantomSource::PANCREAS; ++label)
  {
    if (label != vtkPhantomSource::LIVER)
    {
      labels.push_back(label);
    }
  }
  return labels;
}

/// What `flipfree trace` takes.
void PrintVesselEnds(vtkPhantomSource* source)
{
  double ends[6];
  if (source->GetVesselEnds(ends))
  {
    std::printf("object, from end to end: --point %.2f %.2f %.2f --point %.2f %.2f %.2f\n", ends[0],
      ends[1], ends[2], ends[3], ends[4], ends[5]);
  }
}

void PrintSeeds(vtkPhantomSource* source)
{
  const int shape = source->GetShape();
  for (const int label : LabelsOf(shape))
  {
    double seed[4];
    if (source->GetSeed(label, seed))
    {
      std::printf("%s (label %d): --seed %.2f %.2f %.2f --radius %.2f\n",
        FlipFree::NameOfPhantomLabel(shape, label), label, seed[0], seed[1], seed[2], seed[3]);
    }
  }
  double seed[4];
  double around[4];
  if (source->GetShape() != vtkPhantomSource::VESSEL && // too thin to be found from outside
    source->GetSeed(vtkPhantomSource::OBJECT, seed) && source->GetEnclosingSphere(around))
  {
    // The search lines reach the object. Until the end the surface also encloses background, so
    // the intensities must not be fitted again.
    std::printf("object, from outside: --seed %.2f %.2f %.2f --radius %.2f --start-scale %.3f "
                "--start-offset %.2f %.2f %.2f --search-distance %.0f --no-reestimate-intensities "
                "--no-leak-control --iterations 100 --levels 4\n",
      seed[0], seed[1], seed[2], seed[3], around[3] / seed[3], around[0] - seed[0],
      around[1] - seed[1], around[2] - seed[2], 2 * around[3]);
  }
  PrintVesselEnds(source);
  std::fflush(stdout);
}

/// Checks values of an option, one by one.
std::function<std::string(const std::string&)> MustBePositive(const char* values)
{
  return [values](const std::string& text)
  {
    double number = 0;
    const bool isNumber = CLI::detail::lexical_cast(text, number);
    return !isNumber || number > 0 // what is no number has a message of its own
      ? std::string()
      : text + " is not positive. Give " + values + ".";
  };
}

void Make(const Phantom& phantom)
{
  if (phantom.Quiet)
  {
    ProgressBar::Disable();
  }
  const auto shape = Shapes().find(phantom.Name);
  if (shape == Shapes().end())
  {
    throw WrongUsage("There is no phantom '" + phantom.Name +
      "'. Choose sphere, cube, cup, u-tube, vessel or abdomen.");
  }
  const OutputFolder made(phantom.Folder);
  const std::string stem = (std::filesystem::path(phantom.Folder) / phantom.Name).string();
  const std::string gray = stem + ".nii.gz";
  const std::string truth = stem + "-truth.nii.gz";
  OutputFiles outputs;
  outputs.Announce("--output", gray);
  outputs.Announce("--output", truth);

  vtkNew<vtkPhantomSource> source;
  source->SetShape(shape->second);
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
    PrintSeeds(source);
  }
}

} // namespace

void AddPhantomCommand(CLI::App& program)
{
  const auto phantom = std::make_shared<Phantom>();
  CLI::App* command = AddCommand(program, "phantom");
  AddOption(*command, "NAME", phantom->Name);
  AddOption(*command, "--output", phantom->Folder);
  AddOption(*command, "--size", phantom->Dimensions)->check(MustBePositive("--size NX NY NZ"));
  AddOption(*command, "--spacing", phantom->Spacing)
    ->check(MustBePositive("--spacing X Y Z, in mm"));
  AddOption(*command, "--noise", phantom->Noise);
  AddOption(*command, "--random-seed", phantom->RandomSeed);
  AddOption(*command, "--lesions", phantom->Lesions)->check(CLI::Range(0, 20));
  AddOption(*command, "--quiet", phantom->Quiet);
  command->callback([phantom]() { Make(*phantom); });
}

} // namespace Command
