// One segmentation by one of the compared methods, with its one setting, as a process of its own,
// so that its time and memory can be measured from outside: reads the image, segments, and writes
// what is asked for.
//
//   RunMethod METHOD IMAGE --seed X Y Z --radius R [--labels FILE] [--surface FILE.vtp]
//             [--convergence FILE.csv] [--threads N]
//
// Prints the number of iterations, the seconds of reading, those of the segmentation, and the
// peak memory so far in MB. Ends with 1 if the method found nothing, and with 2 if that is not
// the method's fault: an image that cannot be read, a seed outside it, memory that does not
// suffice, results that cannot be written.
#include "CaseList.h"

#include "vtkBaselineSegmentation.h"
#include "vtkCallbackCommand.h"
#include "vtkDelimitedTextWriter.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkGVFSnake.h"
#include "vtkGraphCutSegmentation.h"
#include "vtkImageData.h"
#include "vtkLevelSetSegmentation.h"
#include "vtkMedicalImageWriter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRegionGrowing.h"
#include "vtkSMPTools.h"
#include "vtkSimplexMeshSegmentation.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkXMLPolyDataWriter.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr int NothingFound = 1;
constexpr int NotTheMethodsFault = 2;

struct Options
{
  std::string Method;
  std::string Image;
  std::array<double, 3> Seed{};
  double Radius = 0;
  std::string Labels;
  std::string Surface;
  std::string Convergence;
  int Threads = 0;
};

struct Run
{
  vtkSmartPointer<vtkAlgorithm> Filter;
  std::function<int()> Iterations;
};

// Input and seed, which both kinds of filters take alike.
template <typename TFilter>
vtkSmartPointer<TFilter> Prepare(vtkImageData* image, const Options& options)
{
  auto filter = vtkSmartPointer<TFilter>::New();
  filter->SetInputData(image);
  filter->SetSeedCenter(options.Seed.data());
  filter->SetSeedRadius(options.Radius);
  return filter;
}

using Configure = std::function<Run(vtkImageData*, const Options&)>;

Configure FlipFree(void (*preset)(vtkFlipFreeSegmentation*))
{
  return [preset](vtkImageData* image, const Options& options)
  {
    auto filter = Prepare<vtkFlipFreeSegmentation>(image, options);
    preset(filter);
    return Run{ filter,
      [filter]() { return static_cast<int>(filter->GetConvergence()->GetNumberOfRows()); } };
  };
}

template <typename TFilter>
Configure Baseline(void (*mode)(TFilter*))
{
  return [mode](vtkImageData* image, const Options& options)
  {
    auto filter = Prepare<TFilter>(image, options);
    mode(filter);
    return Run{ filter, [filter]() { return filter->GetNumberOfIterations(); } };
  };
}

const std::map<std::string, Configure>& Methods()
{
  static const std::map<std::string, Configure> methods = {
    { "flipfree", FlipFree([](vtkFlipFreeSegmentation*) {}) },
    { "published",
      FlipFree([](vtkFlipFreeSegmentation* filter) { filter->UsePublishedParameters(); }) },
    { "naive", FlipFree([](vtkFlipFreeSegmentation* filter) { filter->UseNaiveParameters(); }) },
    { "level-set-threshold",
      Baseline<vtkLevelSetSegmentation>(
        [](vtkLevelSetSegmentation* filter) { filter->SetSpeedToThreshold(); }) },
    { "level-set-geodesic",
      Baseline<vtkLevelSetSegmentation>(
        [](vtkLevelSetSegmentation* filter) { filter->SetSpeedToGeodesic(); }) },
    { "graph-cut-slices",
      Baseline<vtkGraphCutSegmentation>(
        [](vtkGraphCutSegmentation* filter) { filter->SetModeToSlices(); }) },
    { "graph-cut-volume",
      Baseline<vtkGraphCutSegmentation>(
        [](vtkGraphCutSegmentation* filter) { filter->SetModeToVolume(); }) },
    { "region-growing", Baseline<vtkRegionGrowing>([](vtkRegionGrowing*) {}) },
    { "simplex-mesh", Baseline<vtkSimplexMeshSegmentation>([](vtkSimplexMeshSegmentation*) {}) },
    { "gvf-snake", Baseline<vtkGVFSnake>([](vtkGVFSnake*) {}) },
  };
  return methods;
}

std::vector<std::string> NamesOfMethods()
{
  std::vector<std::string> names;
  for (const auto& method : Methods())
  {
    names.push_back(method.first);
  }
  return names;
}

template <typename TWriter>
void Write(vtkDataObject* result, const std::string& file)
{
  vtkNew<TWriter> writer;
  writer->SetInputDataObject(result);
  writer->SetFileName(file.c_str());
  // The writers of VTK's own formats return 1 whatever happened.
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw std::runtime_error(
      file + " cannot be written; is there room, and a folder of that name?");
  }
}

void WriteResults(vtkAlgorithm* filter, const Options& options)
{
  if (!options.Labels.empty())
  {
    Write<vtkMedicalImageWriter>(filter->GetOutputDataObject(1), options.Labels);
  }
  if (!options.Surface.empty())
  {
    Write<vtkXMLPolyDataWriter>(filter->GetOutputDataObject(0), options.Surface);
  }
  if (!options.Convergence.empty() && filter->GetNumberOfOutputPorts() > 2)
  {
    Write<vtkDelimitedTextWriter>(filter->GetOutputDataObject(2), options.Convergence);
  }
}

// Updates, prints the errors that the filter and its executive report, and returns them.
std::vector<std::string> ErrorsOfUpdate(vtkAlgorithm* filter)
{
  std::vector<std::string> errors;
  vtkNew<vtkCallbackCommand> collect;
  collect->SetClientData(&errors);
  collect->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* message)
    {
      static_cast<std::vector<std::string>*>(client)->emplace_back(
        static_cast<const char*>(message));
      std::fputs(static_cast<const char*>(message), stderr);
    });
  filter->AddObserver(vtkCommand::ErrorEvent, collect);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, collect);
  filter->Update();
  filter->RemoveObserver(collect);
  filter->GetExecutive()->RemoveObserver(collect);
  return errors;
}

// Whether the method found nothing in a valid input, by the messages of the baselines and of
// FlipFree. The executive's errors follow the filter's and add nothing.
bool IsTheMethodsVerdict(const std::vector<std::string>& errors)
{
  const auto says = [&errors](const char* text)
  { return errors.front().find(text) != std::string::npos; };
  return errors.empty() || says("No segmentation: nothing was found") ||
    says("No segmentation: the seed has no contrast to its surroundings");
}

// Returns what the program ends with.
int Segment(const Options& options)
{
  vtkSMPTools::Initialize(options.Threads);
  const double begin = vtkTimerLog::GetUniversalTime();
  const auto image = ReadVolume(options.Image);
  if (image->GetNumberOfPoints() == 0)
  {
    return NotTheMethodsFault; // the reader has said why
  }
  const double read = vtkTimerLog::GetUniversalTime();
  const Run run = Methods().at(options.Method)(image, options);
  const std::vector<std::string> errors = ErrorsOfUpdate(run.Filter);
  const double end = vtkTimerLog::GetUniversalTime();
  auto* surface = vtkPolyData::SafeDownCast(run.Filter->GetOutputDataObject(0));
  if (surface->GetNumberOfPoints() == 0)
  {
    return IsTheMethodsVerdict(errors) ? NothingFound : NotTheMethodsFault;
  }
  std::printf("%d %.3f %.3f %.1f\n", run.Iterations(), read - begin, end - read,
    PeakMemory() / 1e6);
  WriteResults(run.Filter, options);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
try
{
  Options options;
  CLI::App app("Segments an organ by one of the methods that are compared.");
  app.add_option("method", options.Method, "the method")
    ->required()
    ->check(CLI::IsMember(NamesOfMethods()));
  app.add_option("image", options.Image, "the volume")->required();
  app.add_option("--seed", options.Seed, "center of the seed sphere, LPS mm")->required();
  app.add_option("--radius", options.Radius, "its radius, mm")->required();
  app.add_option("--labels", options.Labels, "file that takes the label map");
  app.add_option("--surface", options.Surface, "file that takes the surface");
  app.add_option("--convergence", options.Convergence, "file that takes FlipFree's iterations");
  app.add_option("--threads", options.Threads, "number of threads");
  CLI11_PARSE(app, argc, argv);
  return Segment(options);
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "RunMethod: %s\n", error.what());
  return NotTheMethodsFault;
}
