#include "SegmentGroup.h"

#include "Failure.h"
#include "OutputFile.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Snapshot.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "vtkFlipFreeOrganGroup.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <chrono>
#include <cstdio>

namespace Command
{
namespace
{

void AddOrgan(const GivenOrgan& organ, vtkFlipFreeOrganGroup* group)
{
  const char* const name = organ.Name.c_str();
  group->AddOrgan(name, organ.Seed[0], organ.Seed[1], organ.Seed[2], organ.Radius);
  for (const CorrectionPoint& point : organ.Points)
  {
    const auto [x, y, z] = point.Place;
    if (point.Kind == "inside")
    {
      group->AddInsidePoint(name, x, y, z);
    }
    else if (point.Kind == "outside")
    {
      group->AddOutsidePoint(name, x, y, z);
    }
    else if (point.Kind == "seed")
    {
      group->AddSeed(name, x, y, z, point.Radius);
    }
    else
    {
      group->AddBoundaryPoint(name, x, y, z);
    }
  }
}

/// The outputs of one organ.
struct OrganFiles
{
  std::string Surface;
  std::string Convergence;
  std::string Snapshot;

  OrganFiles(const Segmentation& given, const GivenOrgan& organ)
    : Surface(NameFor(organ.FileName(), given.Surface))
    , Convergence(NameFor(organ.FileName(), given.Convergence))
    , Snapshot(NameFor(organ.FileName(), given.Snapshot))
  {
  }
};

void Write(vtkFlipFreeOrganGroup* group, int organ, vtkImageData* image, const OrganFiles& files,
  const OriginNames& names, OutputFiles& outputs)
{
  const auto write =
    [&outputs](const std::string& name, const std::function<void(const std::string&)>& how)
  {
    if (!name.empty())
    {
      outputs.Write(name, how);
    }
  };
  write(files.Surface,
    [&](const std::string& name) { WriteSurface(name, group->GetSurface(organ), names); });
  write(files.Convergence,
    [&](const std::string& name) { WriteTable(name, group->GetConvergence(organ)); });
  write(files.Snapshot,
    [&](const std::string& name) { WriteSnapshot(name, image, group->GetSurface(organ)); });
}

void Report(vtkFlipFreeOrganGroup* group, const std::string& input, double readingSeconds)
{
  vtkTable* const table = group->GetTable();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto number = [&](const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    std::printf("%s, %s: label %.0f, volume %.1f ml, %.0f iterations, %s, %.0f "
                "self-intersections, confidence %s\n",
      input.c_str(), table->GetValueByName(row, "Organ").ToString().c_str(), number("Label"),
      VolumeInMilliliters(group->GetSurface(static_cast<int>(row))), number("Iterations"),
      table->GetValueByName(row, "StopReason").ToString().c_str(), number("SelfIntersections"),
      ConfidenceText(number("Confidence")).c_str());
  }
  double seconds[4];
  group->GetStageSeconds(seconds);
  std::printf("%s: organs do not meet; reading %.2f s, smoothing %.2f s, feature %.2f s, "
              "deformation %.2f s, label map %.2f s\n",
    input.c_str(), readingSeconds, seconds[0], seconds[1], seconds[2], seconds[3]);
  std::fflush(stdout);
}

} // namespace

void SegmentGroup(const Segmentation& segmentation, const std::vector<GivenOrgan>& organs,
  const std::vector<std::string>& fixedSurfaces, const Session* session)
{
  vtkNew<vtkFlipFreeOrganGroup> group;
  segmentation.Parameters.Apply(group->GetParameters());
  group->SetLabelValue(segmentation.Label);
  std::vector<std::string> inputs{ segmentation.Input };
  inputs.insert(inputs.end(), fixedSurfaces.begin(), fixedSurfaces.end());
  OutputFiles outputs;
  std::vector<OrganFiles> files;
  for (const GivenOrgan& organ : organs)
  {
    AddOrgan(organ, group);
    files.emplace_back(segmentation, organ);
    for (const std::string* name :
      { &files.back().Surface, &files.back().Convergence, &files.back().Snapshot })
    {
      if (!name->empty())
      {
        outputs.Announce(*name, inputs);
      }
    }
  }
  for (const std::string* name : { &segmentation.Labels, &segmentation.SessionOut })
  {
    if (!name->empty())
    {
      outputs.Announce(*name, inputs);
    }
  }
  if (!segmentation.Snapshot.empty())
  {
    RequireDisplay();
  }
  vtkSMPTools::Initialize(segmentation.Threads);

  const auto start = std::chrono::steady_clock::now();
  const vtkSmartPointer<vtkImageData> image =
    ReadVolume(segmentation.Input, segmentation.SeriesUID);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  if (session)
  {
    RequireImageOf(*session, segmentation.Input, image);
  }
  group->SetInputData(image);
  for (const std::string& fixed : fixedSurfaces)
  {
    group->AddFixedData(ReadSurface(fixed));
  }
  try
  {
    Run(group, "segmenting", SegmentParameters::Names());
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + segmentation.Input + "': " + failure.what());
  }
  OriginNames names;
  names.Image = segmentation.Input;
  names.Fixed = fixedSurfaces;
  for (const GivenOrgan& organ : organs)
  {
    names.Organs.push_back(organ.Name);
    names.Colors.push_back(organ.Color);
  }
  for (std::size_t organ = 0; organ < organs.size(); ++organ)
  {
    const auto index = static_cast<int>(organ);
    if (group->GetStopReason(index) == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
    {
      throw Failure("'" + segmentation.Input + "', " + organs[organ].Name +
        ": no boundary of the organ was found, so nothing is written.");
    }
    Write(group, index, image, files[organ], names, outputs);
  }
  if (!segmentation.SessionOut.empty())
  {
    const std::string text = NamedProvenance(ProvenanceOf(group->GetSurface(0)), names);
    outputs.Write(segmentation.SessionOut,
      [&text](const std::string& name) { WriteSession(name, { text }); });
  }
  if (!segmentation.Labels.empty())
  {
    outputs.Write(segmentation.Labels,
      [&](const std::string& name)
      {
        NameSegments(group->GetLabelMap(), segmentation.Label, names);
        WriteVolume(name, group->GetLabelMap());
      });
  }
  outputs.Commit();
  if (!segmentation.Quiet)
  {
    Report(group, segmentation.Input, reading.count());
  }
}

} // namespace Command
