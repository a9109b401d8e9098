#include "Deformation/SegmentationSettings.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

StopReason ScheduleSettings::ReasonToStop(const std::vector<double>& distances, double voxel) const
{
  if (distances.back() < voxel * this->DistanceTolerance)
  {
    return StopReason::DistanceBelowTolerance;
  }
  if (this->ChangeTolerance < 0 || distances.size() <= ChangeSpan)
  {
    return StopReason::NotRun;
  }
  const double before = distances[distances.size() - 1 - ChangeSpan];
  return before - distances.back() < voxel * this->ChangeTolerance ? StopReason::Converged
                                                                   : StopReason::NotRun;
}

int ScheduleSettings::NumberOfLevels() const
{
  constexpr int minimumResolution = 2;
  int levels = this->Levels;
  while (levels > 1 && this->Resolution >> (levels - 1) < minimumResolution)
  {
    --levels;
  }
  return levels;
}

int ScheduleSettings::FirstResolution() const
{
  return this->Resolution >> (this->NumberOfLevels() - 1);
}

ScheduleSettings ScheduleSettings::From(int vertices) const
{
  const double wanted = 6.0 * this->Resolution * this->Resolution;
  const double refinements = std::round(std::log2(wanted / vertices) / 2);
  ScheduleSettings schedule = *this;
  schedule.Levels = std::min(this->Levels, 1 + static_cast<int>(std::max(0.0, refinements)));
  return schedule;
}

OrganSegmentationSettings PublishedSettings()
{
  OrganSegmentationSettings settings;
  settings.Schedule.Levels = 1;
  settings.Schedule.MaximumIterations = 150;
  settings.Feature.Intensity.Mixture.MinimumWeight = 0;
  settings.Feature.Intensity.NoiseWidening = 0;
  settings.Feature.ReestimateIntensities = false;
  settings.Feature.Carving = false;
  settings.Feature.Consensus = false;
  settings.Feature.ControlLeaks = false;
  settings.Targets.Correspondence.SearchDistance = 40;
  settings.Targets.Correspondence.RunLength = 0;
  settings.Targets.Correspondence.SearchInward = false;
  settings.Targets.Correspondence.EdgeWindow = 0;
  settings.Targets.Correspondence.ImageBoundaryDistance = 0;
  settings.Targets.NormalSmoothingIterations = 0;
  settings.Targets.OutlierStandardDeviations = 0;
  settings.Targets.MaximumDisplacement = 0;
  settings.Step.Guard = false;
  return settings;
}

OrganSegmentationSettings NaiveSettings()
{
  OrganSegmentationSettings settings = PublishedSettings();
  settings.Step.AvoidFlips = false;
  return settings;
}

OrganSegmentationSettings SettingsOfPreset(const std::string& name)
{
  return name == "published" ? PublishedSettings()
    : name == "naive"        ? NaiveSettings()
                             : OrganSegmentationSettings();
}

} // namespace FlipFree
