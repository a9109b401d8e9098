#include "SegmentGroup.h"

#include "Failure.h"
#include "FilterSettings.h"
#include "ImageAdapter.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Snapshot.h"
#include "Summary.h"
#include "SurfaceFile.h"
#include "SurfaceOrigin.h"
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

void PrintReport(vtkFlipFreeOrganGroup* group, const std::string& input, double readingSeconds)
{
  vtkTable* const table = group->GetTable();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto number = [&](const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    const OrganSummary organ{ input, VolumeInMilliliters(group->GetSurface(static_cast<int>(row))),
      static_cast<int>(number("Iterations")), table->GetValueByName(row, "StopReason").ToString(),
      static_cast<int>(number("SelfIntersections")) };
    PrintSummary(GroupText(organ, table->GetValueByName(row, "Organ").ToString(),
      static_cast<int>(number("Label")), number("Confidence")));
  }
  StageSeconds seconds;
  group->GetStageSeconds(seconds.data());
  PrintSummary(GroupEndText(input, readingSeconds, seconds));
}

/// One run of the command.
class GroupRun
{
public:
  GroupRun(const SegmentPlan& plan, OutputFiles& outputs)
    : Plan(plan)
    , Given(plan.Given)
    , Outputs(outputs)
  {
    this->Names.Image = this->Given.Input;
    this->Names.Fixed = plan.Fixed;
    for (const GivenOrgan& organ : plan.Group)
    {
      this->Names.Organs.push_back(organ.Name);
      this->Names.Colors.push_back(organ.Color);
    }
  }

  void Read()
  {
    const auto start = std::chrono::steady_clock::now();
    this->Image = ReadVolume(this->Given.Input, this->Given.SeriesUID);
    const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
    this->ReadingSeconds = reading.count();
    this->Names.Series = SeriesOf(this->Image);
    if (this->Plan.From)
    {
      RequireImageOf(*this->Plan.From, this->Given.Input, FlipFree::GeometryOf(this->Image));
    }
    for (const std::string& fixed : this->Plan.Fixed)
    {
      this->Group->AddFixedData(ReadSurface(fixed));
    }
  }

  void Segment()
  {
    FlipFree::FilterSettings::Set(this->Group->GetParameters(), this->Given.Parameters.Settings());
    this->Group->SetLabelValue(this->Given.Label);
    this->Group->SetInputData(this->Image);
    for (const GivenOrgan& organ : this->Plan.Group)
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
    for (std::size_t organ = 0; organ < this->Plan.Group.size(); ++organ)
    {
      if (this->Group->GetStopReason(static_cast<int>(organ)) ==
        vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
      {
        throw Failure("'" + this->Given.Input + "': No segmentation: '" +
          this->Plan.Group[organ].Name + "': " + NoBoundaryText);
      }
    }
  }

  void Write()
  {
    for (std::size_t organ = 0; organ < this->Plan.Group.size(); ++organ)
    {
      this->WriteOrgan(static_cast<int>(organ),
        WithFilesOf(this->Plan.Group[organ].FileName(), this->Given));
    }
    this->WriteIfNamed(this->Given.SessionOut,
      [this](const std::string& name)
      {
        WriteText(name,
          SessionText(name,
            { NamedProvenance(ProvenanceOf(this->Group->GetSurface(0)), this->Names) }));
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

  void WriteOrgan(int organ, const SegmentRequest& files)
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

  const SegmentPlan& Plan;
  const SegmentRequest& Given;
  OutputFiles& Outputs;
  OriginNames Names;
  vtkSmartPointer<vtkImageData> Image;
  double ReadingSeconds = 0;
  vtkNew<vtkFlipFreeOrganGroup> Group;
};

} // namespace

void SegmentGroup(const SegmentPlan& plan, OutputFiles& outputs)
{
  GroupRun run(plan, outputs);
  vtkSMPTools::Initialize(plan.Given.Threads);
  run.Read();
  run.Segment();
  run.Write();
  if (!plan.Given.Quiet)
  {
    run.Report();
  }
}

} // namespace Command
