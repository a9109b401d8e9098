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
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <chrono>
#include <cstdio>
#include <functional>

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
    const auto& [x, y, z] = point.Place;
    switch (point.Kind)
    {
      case FlipFree::ConstraintKind::Outside:
        group->AddOutsidePoint(name, x, y, z);
        break;
      case FlipFree::ConstraintKind::Inside:
        group->AddInsidePoint(name, x, y, z);
        break;
      case FlipFree::ConstraintKind::Boundary:
        group->AddBoundaryPoint(name, x, y, z);
        break;
      case FlipFree::ConstraintKind::Seed:
        group->AddSeed(name, x, y, z, point.Radius);
        break;
    }
  }
}

/// The outputs of one organ.
struct OrganFiles
{
  std::string Surface;
  std::string Convergence;
  std::string Questions;
  std::string Snapshot;

  OrganFiles(const SegmentRequest& given, const GivenOrgan& organ)
    : Surface(NameFor(organ.FileName(), given.Surface))
    , Convergence(NameFor(organ.FileName(), given.Convergence))
    , Questions(NameFor(organ.FileName(), given.Questions))
    , Snapshot(NameFor(organ.FileName(), given.Snapshot))
  {
  }
};

void PrintReport(vtkFlipFreeOrganGroup* group, const std::string& input, double readingSeconds)
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

/// One run of the command.
class GroupRun
{
public:
  GroupRun(const SegmentRequest& request, const std::vector<GivenOrgan>& organs,
    const std::vector<std::string>& fixedSurfaces)
    : Given(request)
    , Organs(organs)
    , Fixed(fixedSurfaces)
  {
    this->Names.Image = request.Input;
    this->Names.Fixed = fixedSurfaces;
    for (const GivenOrgan& organ : organs)
    {
      this->Files.emplace_back(request, organ);
      this->Names.Organs.push_back(organ.Name);
      this->Names.Colors.push_back(organ.Color);
    }
  }

  /// Before the work is done.
  void AnnounceFiles()
  {
    std::vector<std::string> inputs = this->Given.Corrections.StrokeFiles();
    inputs.insert(inputs.end(), { this->Given.Input, this->Given.Session });
    inputs.insert(inputs.end(), this->Fixed.begin(), this->Fixed.end());
    const auto announce = [&](const char* option, const std::string& name)
    {
      if (!name.empty())
      {
        this->Outputs.Announce(option, name, inputs);
      }
    };
    announce("--labels", this->Given.Labels);
    announce("--save-session", this->Given.SessionOut);
    for (const OrganFiles& files : this->Files)
    {
      announce("--output", files.Surface);
      announce("--convergence", files.Convergence);
      announce("--questions", files.Questions);
      announce("--snapshot", files.Snapshot);
    }
    if (!this->Given.Snapshot.empty())
    {
      RequireDisplay();
    }
  }

  void Read(const Session* session)
  {
    const auto start = std::chrono::steady_clock::now();
    this->Image = ReadVolume(this->Given.Input, this->Given.SeriesUID);
    const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
    this->ReadingSeconds = reading.count();
    this->Names.Series = SeriesOf(this->Image);
    if (session)
    {
      RequireImageOf(*session, this->Given.Input, this->Image);
    }
    for (const std::string& fixed : this->Fixed)
    {
      this->Group->AddFixedData(ReadSurface(fixed));
    }
  }

  void Segment()
  {
    this->Given.Parameters.Apply(this->Group->GetParameters());
    this->Group->SetLabelValue(this->Given.Label);
    this->Group->SetInputData(this->Image);
    for (const GivenOrgan& organ : this->Organs)
    {
      AddOrgan(organ, this->Group);
    }
    try
    {
      Run(this->Group, "segmenting", QuantitiesOf(this->Given));
    }
    catch (const Failure& failure)
    {
      throw Failure("'" + this->Given.Input + "': " + failure.what());
    }
    for (std::size_t organ = 0; organ < this->Organs.size(); ++organ)
    {
      if (this->Group->GetStopReason(static_cast<int>(organ)) ==
        vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
      {
        throw Failure("'" + this->Given.Input + "': No segmentation: '" + this->Organs[organ].Name +
          "': " + NoBoundaryText);
      }
    }
  }

  void Write()
  {
    for (std::size_t organ = 0; organ < this->Organs.size(); ++organ)
    {
      this->WriteOrgan(static_cast<int>(organ), this->Files[organ]);
    }
    this->WriteIfNamed(this->Given.SessionOut,
      [this](const std::string& name)
      {
        WriteSession(name,
          { NamedProvenance(ProvenanceOf(this->Group->GetSurface(0)), this->Names) });
      });
    this->WriteIfNamed(this->Given.Labels,
      [this](const std::string& name)
      {
        NameSegments(this->Group->GetLabelMap(), this->Given.Label, this->Names);
        WriteVolume(name, this->Group->GetLabelMap());
      });
    this->Outputs.Commit();
  }

  void Report() const
  {
    PrintReport(this->Group, InputTitle(this->Given.Input, this->Names.Series),
      this->ReadingSeconds);
  }

private:
  void WriteIfNamed(const std::string& name, const std::function<void(const std::string&)>& how)
  {
    if (!name.empty())
    {
      this->Outputs.Write(name, how);
    }
  }

  void WriteOrgan(int organ, const OrganFiles& files)
  {
    vtkPolyData* const surface = this->Group->GetSurface(organ);
    this->WriteIfNamed(files.Surface,
      [&](const std::string& name) { WriteSurface(name, surface, this->Names); });
    this->WriteIfNamed(files.Convergence,
      [&](const std::string& name) { WriteTable(name, this->Group->GetConvergence(organ)); });
    this->WriteIfNamed(files.Questions,
      [&](const std::string& name) { WriteTable(name, this->Group->GetQuestions(organ)); });
    this->WriteIfNamed(files.Snapshot,
      [&](const std::string& name) { WriteSnapshot(name, this->Image, surface); });
  }

  const SegmentRequest& Given;
  const std::vector<GivenOrgan>& Organs;
  const std::vector<std::string>& Fixed;
  std::vector<OrganFiles> Files;
  OriginNames Names;
  OutputFiles Outputs;
  vtkSmartPointer<vtkImageData> Image;
  double ReadingSeconds = 0;
  vtkNew<vtkFlipFreeOrganGroup> Group;
};

} // namespace

void SegmentGroup(const SegmentRequest& request, const std::vector<GivenOrgan>& organs,
  const std::vector<std::string>& fixedSurfaces, const Session* session)
{
  GroupRun run(request, organs, fixedSurfaces);
  run.AnnounceFiles();
  vtkSMPTools::Initialize(request.Threads);
  run.Read(session);
  run.Segment();
  run.Write();
  if (!request.Quiet)
  {
    run.Report();
  }
}

} // namespace Command
