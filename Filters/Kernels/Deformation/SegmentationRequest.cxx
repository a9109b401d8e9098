#include "Deformation/SegmentationRequest.h"

#include "Deformation/OrganGroup.h"
#include "Deformation/Provenance.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/StartMask.h"
#include "Error.h"
#include "Image/GridCheck.h"
#include "MessageText.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr int GreatestLabel = 255; // label maps are of bytes

std::vector<double> KeyOf(const SeedSphere& seed, bool fills,
  const VolumeSegmentationSettings& settings)
{
  std::vector<double> key(seed.Center.begin(), seed.Center.end());
  key.push_back(seed.Radius);
  key.push_back(fills ? 1 : 0);
  for (const Parameter<VolumeSegmentationSettings>& parameter : SegmentationParameters())
  {
    const std::vector<double> values = parameter.Get(settings);
    key.insert(key.end(), values.begin(), values.end());
  }
  return key;
}

void RequireLabelsFor(const std::vector<NamedOrgan>& organs, int first)
{
  if (first + static_cast<int>(organs.size()) > GreatestLabel + 1)
  {
    throw Error(ErrorCode::OutOfRange,
      "labels go up to " + std::to_string(GreatestLabel) + ", which leaves none for " +
        Quoted(organs.back().Name) + "; lower {LabelValue}, or remove organs");
  }
}

// Takes the largest seed from the constraints.
SeedSphere TakeSeed(const std::string& organ, ConstraintList& constraints)
{
  const auto first = std::find_if(constraints.begin(), constraints.end(),
    [](const PointConstraint& constraint) { return constraint.Kind == ConstraintKind::Seed; });
  if (first == constraints.end())
  {
    throw Error(ErrorCode::OutOfRange,
      Quoted(organ) + " has no seed; give a sphere that lies within it");
  }
  SeedSphere seed{ first->Point, first->Radius };
  constraints.erase(first);
  TakeLargestSeed(seed, constraints);
  return seed;
}

} // namespace

OrganSession::OrganSession(GrayVolume volume, std::string name, Threading threading)
  : Volume(std::move(volume))
  , Name(std::move(name))
  , Threads(std::move(threading))
{
}

void OrganSession::StartFrom(GivenSurface surface)
{
  this->Release();
  this->Start = std::move(surface);
}

SeedSphere OrganSession::FillLabel(const LabelVolume& labels, int label)
{
  this->Release(); // its memory is needed
  this->Filled.reset();
  RequireVoxels(this->Volume.Geometry, this->Name);
  StartMask start = StartMaskOf(labels, label, this->Volume.Geometry, this->Name);
  const SeedSphere ball = LargestBallIn(start.Voxels, this->Threads.For);
  this->Filled = FilledLabel{ labels.Name, label,
    std::make_shared<const BitMask>(std::move(start.Voxels)), start.Outside, ball };
  return this->Filled->Ball;
}

void OrganSession::Release()
{
  this->Kept.reset();
  this->MadeOf.clear();
}

VolumeSegmenter& OrganSession::Prepare(const SeedSphere& seed, bool fills,
  const VolumeSegmentationSettings& settings)
{
  std::vector<double> key = KeyOf(seed, fills, settings);
  if (this->Kept && key == this->MadeOf)
  {
    return *this->Kept;
  }
  this->Release(); // before another one takes memory
  RequireNumbers(settings);
  RequireVoxels(this->Volume.Geometry, this->Name);
  std::optional<DeformableSurface> start;
  if (this->Start)
  {
    start = MakeStartSurface(*this->Start, settings.Method.Step.Guard, this->Threads.For);
  }
  this->Kept.emplace(this->Volume, this->Name, seed, start ? &*start : nullptr, settings,
    this->Threads);
  if (fills)
  {
    this->Kept->SetForeground(this->Filled->Mask, this->Filled->Name);
  }
  this->MadeOf = std::move(key);
  return *this->Kept;
}

OrganAnswer OrganSession::Segment(const OrganRequest& request, const Monitor& monitor,
  const IterationObserver& observer)
{
  const bool fills = !request.Seed;
  if (fills && this->Filled && this->Start)
  {
    throw Error(ErrorCode::OutOfRange,
      this->Start->Name + " and " + this->Filled->Name +
        " cannot both be the start; leave one of them out");
  }
  if (fills && !this->Filled)
  {
    throw Error(ErrorCode::SeedWithoutVoxels,
      "there is neither a seed nor a label to fill; give one of them");
  }
  OrganAnswer answer;
  ConstraintList constraints = request.Constraints;
  answer.Seed = fills ? this->Filled->Ball : *request.Seed;
  if (!fills)
  {
    TakeLargestSeed(answer.Seed, constraints);
  }
  const IterationObserver unseen = [](const ContourMesh&, const PointList&,
                                     const CorrespondenceField&, const IterationRecord&) {};
  const bool isSeen = observer && request.Settings.KeepHistory;
  answer.Result = this->Prepare(answer.Seed, fills, request.Settings)
                    .Segment(constraints, monitor, isSeen ? observer : unseen);
  if (fills && this->Filled->Outside > 0)
  {
    answer.Result.Warnings.push_back(PercentOf(this->Filled->Outside) + " of " +
      this->Filled->Name + " lie outside " + this->Name +
      " and are left out; give an image that holds the whole organ.");
  }
  this->Constraints = constraints;
  OrganProvenance origin;
  origin.Seed = answer.Seed;
  origin.Constraints = std::move(constraints);
  origin.HasStartSurface = this->Start.has_value();
  origin.StartLabel = fills ? this->Filled->Label : -1;
  answer.Provenance = ProvenanceOf(origin, request.Settings, this->Volume.Geometry);
  return answer;
}

std::optional<std::vector<VoxelRun>> OrganSession::Preview(const PointConstraint& point,
  const Monitor& monitor)
{
  return this->Kept ? this->Kept->Preview(this->Constraints, point, monitor) : std::nullopt;
}

GroupAnswer SegmentGroup(const GrayVolume& volume, const std::string& name,
  const GroupRequest& request, const Threading& threading, const Monitor& monitor)
{
  RequireNumbers(request.Settings);
  RequireVoxels(volume.Geometry, name);
  RequireLabelsFor(request.Organs, request.Settings.LabelValue);
  std::vector<SeededOrgan> organs;
  std::vector<ConstraintList> constraints;
  std::vector<OrganProvenance> origins;
  for (const NamedOrgan& organ : request.Organs)
  {
    constraints.push_back(organ.Constraints);
    organs.push_back({ organ.Name, TakeSeed(organ.Name, constraints.back()) });
    origins.push_back({ organ.Name, organs.back().Seed, constraints.back() });
  }
  std::vector<FixedSurface> fixed;
  for (const GivenSurface& surface : request.Fixed)
  {
    fixed.push_back({ surface.Name, MakeFixedSurface(surface, threading.For) });
  }
  // Seeds of a group are not properties.
  const QuantityNames words{ { "SeedRadius", "its radius" }, { "SeedCenter", "its seed" } };
  GroupAnswer answer;
  try
  {
    OrganGroup group(volume, name, std::move(organs), std::move(fixed), request.Settings,
      threading);
    answer.Results = group.Segment(constraints, monitor,
      [](std::size_t, const ContourMesh&, const PointList&, const CorrespondenceField&,
        const IterationRecord&) {});
  }
  catch (const Error& error)
  {
    throw Error(error.GetCode(), WithWords(error.GetText(), words));
  }
  for (VolumeSegmentation& result : answer.Results)
  {
    for (std::string& warning : result.Warnings)
    {
      warning = WithWords(warning, words);
    }
  }
  answer.Provenance =
    ProvenanceOf(origins, request.Fixed.size(), request.Settings, volume.Geometry);
  return answer;
}

} // namespace FlipFree
