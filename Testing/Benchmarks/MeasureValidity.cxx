// What the method leaves of self-intersections and flips, as published, without its flip avoidance,
// with the guard, and by default: over the phantoms and, where they are, the rows of cases.csv.
//
//   MeasureValidity [--data DIR] [--only TEXT]
//
// Self-intersections are the pairs of faces of the final surface, counted exactly; flipped
// corners are those whose normal turned by 90 degrees or more in a step, all steps together.
#include "CaseList.h"
#include "PhantomCases.h"
#include "SurfaceHistory.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPhantomSource.h"
#include "vtkPolyData.h"
#include "vtkSegmentationMetrics.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace
{

// A way to configure a filter whose input and seed are set.
struct Method
{
  const char* Name;
  std::function<void(vtkFlipFreeSegmentation*)> Configure;
};

const std::vector<Method> Methods = {
  { "naive", [](vtkFlipFreeSegmentation* filter) { filter->UseNaiveParameters(); } },
  { "published", [](vtkFlipFreeSegmentation* filter) { filter->UsePublishedParameters(); } },
  { "published, guarded",
    [](vtkFlipFreeSegmentation* filter)
    {
      filter->UsePublishedParameters();
      filter->GuardOn();
    } },
  { "default", [](vtkFlipFreeSegmentation*) {} },
};

void PrintCell(vtkFlipFreeSegmentation* filter, vtkImageData* reference, int label)
{
  filter->KeepHistoryOn();
  filter->Update();
  if (filter->GetSurface()->GetNumberOfPoints() == 0)
  {
    std::printf(" no surface | | |");
    return;
  }
  const auto history = FlipFree::HistoryOf(filter);
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(filter->GetLabelMap());
  metrics->SetReferenceData(reference);
  metrics->SetReferenceLabel(label);
  metrics->Update();
  std::printf(" %d | %d | %.3f |", filter->GetNumberOfSelfIntersections(),
    FlipFree::CountFlippedCorners(history), metrics->GetDice());
  std::fflush(stdout);
}

using MakeCase = std::function<void(vtkFlipFreeSegmentation*, vtkPhantomSource*)>;

void PrintPhantom(const char* name, const MakeCase& makeCase, int label, bool fromOutside)
{
  std::printf("| %s |", name);
  for (const Method& method : Methods)
  {
    vtkNew<vtkFlipFreeSegmentation> filter;
    vtkNew<vtkPhantomSource> phantom;
    makeCase(filter, phantom);
    const double reach = filter->GetSearchDistance();
    method.Configure(filter);
    if (fromOutside && !filter->GetSearch()->GetSearchInward())
    {
      // Read literally, Eq. 2 never gets to the object.
      filter->GetSearch()->SearchInwardOn();
      filter->SetSearchDistance(reach);
    }
    phantom->Update();
    PrintCell(filter, vtkImageData::SafeDownCast(phantom->GetOutputDataObject(1)), label);
  }
  std::printf("\n");
}

void PrintRow(const Case& row, const std::string& folder)
{
  const auto image = ReadVolume(folder + "/" + row.Image);
  const auto reference = ReadVolume(folder + "/" + row.Labels);
  std::printf("| %s |", row.Name.c_str());
  for (const Method& method : Methods)
  {
    vtkNew<vtkFlipFreeSegmentation> filter;
    filter->SetInputData(image);
    filter->SetSeedCenter(row.Seed.data());
    filter->SetSeedRadius(row.Radius);
    method.Configure(filter);
    PrintCell(filter, reference, row.Label);
  }
  std::printf("\n");
}

} // namespace

int main(int argc, char* argv[])
{
  std::string data = DefaultDataFolder();
  std::string only;
  CLI::App app("Counts the self-intersections and flips that each form of the method leaves.");
  app.add_option("--data", data, "folder with cases.csv")->capture_default_str();
  app.add_option("--only", only, "inputs whose name contains this text");
  CLI11_PARSE(app, argc, argv);

  std::printf("| input |");
  for (const Method& method : Methods)
  {
    std::printf(" %s: intersections | flipped corners | Dice |", method.Name);
  }
  std::printf("\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");

  struct PhantomCase
  {
    const char* Name;
    MakeCase Make;
    int Label;
    bool FromOutside;
  };
  const PhantomCase phantoms[] = {
    { "phantom cup, from outside", FlipFree::SegmentCup, vtkPhantomSource::OBJECT, true },
    { "phantom U-tube, from outside", FlipFree::SegmentUTube, vtkPhantomSource::OBJECT, true },
    { "phantom vessel", FlipFree::SegmentVessel, vtkPhantomSource::OBJECT, false },
    { "phantom abdomen, liver", FlipFree::SegmentLiver, vtkPhantomSource::LIVER, false },
  };
  for (const PhantomCase& phantom : phantoms)
  {
    if (std::string(phantom.Name).find(only) != std::string::npos)
    {
      PrintPhantom(phantom.Name, phantom.Make, phantom.Label, phantom.FromOutside);
    }
  }
  for (const Case& row : ReadCases(data + "/cases.csv"))
  {
    if (row.Name.find(only) != std::string::npos)
    {
      PrintRow(row, data);
    }
  }
  return 0;
}
