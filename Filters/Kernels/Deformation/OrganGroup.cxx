#include "Deformation/OrganGroup.h"

#include "Deformation/DeformationLoop.h"
#include "Error.h"
#include "Evidence/OrganDivision.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "MessageText.h"
#include "Stopwatch.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace FlipFree
{
namespace
{

// Of the work: until all foregrounds are found.
constexpr double ForegroundsEnd = 0.5;

bool IsWithin(const VoxelBox& box, const std::array<int, 3>& voxel)
{
  bool within = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    within = within && box.Begin[axis] <= voxel[axis] && voxel[axis] < box.End[axis];
  }
  return within;
}

void RequireSettings(const OrganSegmentationSettings& method)
{
  if (!method.Step.Guard || !method.Feature.Carving)
  {
    throw Error(ErrorCode::OutOfRange,
      "several organs are segmented together under the guard, and with carving; switch {Guard} and "
      "{Carving} on, or segment them one by one");
  }
}

} // namespace

struct OrganGroup::Member
{
  Member(std::size_t index, const SeededOrgan& organ, const GrayVolume& volume,
    const std::string& volumeName, const VolumeSegmentationSettings& settings,
    const Threading& threading)
    : Index(index)
    , Name(organ.Name)
    , Seed(organ.Seed)
    , Segmenter(volume, volumeName, organ.Seed, nullptr, settings, threading)
  {
  }

  const std::size_t Index; // in the order of the caller
  const std::string Name;
  const SeedSphere Seed;
  VolumeSegmenter Segmenter;

  // Of the current call.
  ConstraintList Constraints;
  ConstraintList OfOthers; // outside points
  OrganSegmenter* Levels = nullptr;
  double SmoothedBefore = 0;

  DeformingOrgan& Organ() const { return this->Levels->GetOrgan(); }
  ConstraintList All() const
  {
    ConstraintList all = this->Constraints;
    all.insert(all.end(), this->OfOthers.begin(), this->OfOthers.end());
    return all;
  }

  // Refers to the group's.
  IterationObserver ObserverOf(const GroupObserver& observer) const
  {
    return [&observer, index = this->Index](const ContourMesh& mesh, const PointList& points,
             const CorrespondenceField& field, const IterationRecord& record)
    { observer(index, mesh, points, field, record); };
  }

  // Returns call(). Errors get the organ's name in front.
  template <typename Call>
  auto Naming(const Call& call) const
  {
    try
    {
      return call();
    }
    catch (const Error& error)
    {
      throw Error(error.GetCode(), Quoted(this->Name) + ": " + error.GetText());
    }
  }
};

OrganGroup::OrganGroup(const GrayVolume& volume, const std::string& name,
  std::vector<SeededOrgan> organs, std::vector<FixedSurface> fixed,
  const VolumeSegmentationSettings& settings, const Threading& threading)
  : Geometry(volume.Geometry)
  , Name(name)
  , Fixed(std::move(fixed))
  , Threads(threading)
{
  std::vector<std::string> names;
  names.reserve(organs.size());
  for (const SeededOrgan& organ : organs)
  {
    names.push_back(organ.Name);
  }
  RequireDistinctNames(names);
  RequireSettings(settings.Method);
  for (std::size_t index = 0; index < organs.size(); ++index)
  {
    const SeededOrgan& organ = organs[index];
    this->Members.push_back(NamingSurface(Quoted(organ.Name),
      [&] { return std::make_unique<Member>(index, organ, volume, name, settings, threading); }));
  }
  std::sort(this->Members.begin(), this->Members.end(),
    [](const auto& one, const auto& two)
    {
      const auto keyOf = [](const Member& member)
      {
        const Eigen::Vector3d& center = member.Seed.Center;
        return std::make_tuple(center[0], center[1], center[2], member.Seed.Radius);
      };
      return keyOf(*one) < keyOf(*two);
    });
  this->RequirePointsApart(std::vector<ConstraintList>(this->Members.size()));
  std::vector<OrganStart> starts;
  for (const auto& member : this->Members)
  {
    const SeedSphere sphere{ member->Seed.Center + settings.StartCenterOffset,
      settings.StartScale * member->Seed.Radius };
    starts.push_back({ member->Name, member->Seed, sphere, member->Segmenter.StartWithin({}) });
  }
  RequireStartsApart(starts, this->Fixed, this->Threads.For);
}

OrganGroup::~OrganGroup() = default;

void OrganGroup::RequirePointsApart(const std::vector<ConstraintList>& constraints) const
{
  std::vector<KnownOrgan> known;
  for (const auto& member : this->Members)
  {
    known.push_back({ member->Name, member->Seed, constraints[member->Index] });
  }
  FlipFree::RequirePointsApart(known, this->Fixed, 1e-3 * this->Geometry.Spacing.minCoeff());
}

// What is certain of the other organs, as far as this one can reach.
void OrganGroup::FindPointsOfOthers(Member& member) const
{
  member.OfOthers.clear();
  for (const auto& other : this->Members)
  {
    if (other.get() == &member)
    {
      continue;
    }
    ConstraintList certain = other->Constraints;
    certain.push_back({ ConstraintKind::Seed, other->Seed.Center, other->Seed.Radius });
    for (const PointConstraint& point : certain)
    {
      if ((point.Kind == ConstraintKind::Inside || point.Kind == ConstraintKind::Seed) &&
        IsWithin(member.Segmenter.GetBox(), NearestVoxel(this->Geometry, point.Point)))
      {
        // The user knows it as what it is to the other organ.
        const std::string given = point.Kind == ConstraintKind::Seed
          ? "the seed at " + TextOf(point.Point) + " mm"
          : NameOf(point);
        member.OfOthers.push_back({ ConstraintKind::Outside, point.Point, 0,
          given + " of " + Quoted(other->Name) + ", which must lie outside " + Quoted(member.Name) +
            "," });
      }
    }
  }
}

BitMask OrganGroup::FixedVoxels(const ImageGeometry& region) const
{
  BitMask voxels(region);
  for (const FixedSurface& surface : this->Fixed)
  {
    voxels.InsertRuns(VoxelizeSurface(surface.Surface.Points, surface.Surface.Mesh.Triangles,
      region, this->Threads.For));
  }
  return voxels;
}

// Makes the foregrounds disjoint, also with the fixed surfaces.
bool OrganGroup::Divide(const Monitor& monitor)
{
  std::vector<OrganClaim> claims;
  for (const auto& member : this->Members)
  {
    OrganForeground& foreground = member->Organ().GetForeground();
    ConstraintList points = member->Constraints;
    std::copy_if(member->OfOthers.begin(), member->OfOthers.end(), std::back_inserter(points),
      [&](const PointConstraint& point)
      {
        const auto voxel = NearestVoxel(foreground.GetMask().GetGeometry(), point.Point);
        return foreground.GetMask()(voxel[0], voxel[1], voxel[2]);
      });
    if (!member->Naming([&] { return member->Organ().CorrectForeground(points, monitor); }))
    {
      return false;
    }
    const ImageGeometry region = foreground.GetMask().GetGeometry();
    claims.push_back({ foreground.TakeMask(), foreground.GetImage(),
      member->Segmenter.GetBox().Begin, member->Segmenter.GetCore(), member->Constraints,
      member->Segmenter.GetNoise(), this->Fixed.empty() ? BitMask() : this->FixedVoxels(region) });
  }
  const Modality modality = this->Members.front()->Organ().GetForeground().GetModality();
  if (!DivideClaims(claims, modality, this->Threads.For, monitor))
  {
    return false;
  }
  for (std::size_t index = 0; index < claims.size(); ++index)
  {
    this->Members[index]->Organ().SettleForeground(std::move(claims[index].Mask));
  }
  return true;
}

bool OrganGroup::Run(const Monitor& monitor, const GroupObserver& observer)
{
  if (!this->FindForegrounds(monitor, observer))
  {
    return false;
  }
  for (const auto& member : this->Members)
  {
    this->FindPointsOfOthers(*member);
  }
  return this->Divide([&](double) { return monitor(ForegroundsEnd); }) &&
    this->Deform(monitor, observer);
}

// Each organ by itself: only where all have a foreground is it known what they contend for.
bool OrganGroup::FindForegrounds(const Monitor& monitor, const GroupObserver& observer)
{
  const auto count = static_cast<double>(this->Members.size());
  for (std::size_t index = 0; index < this->Members.size(); ++index)
  {
    Member& member = *this->Members[index];
    const Monitor part =
      FlipFree::PartOf(monitor, ForegroundsEnd * static_cast<double>(index) / count,
        ForegroundsEnd * static_cast<double>(index + 1) / count);
    const bool found = member.Naming(
      [&]
      {
        member.Levels = &member.Segmenter.Prepare(member.Constraints);
        member.Organ().SetName(Quoted(member.Name));
        member.SmoothedBefore = member.Organ().GetForeground().GetSmoothingSeconds();
        return member.Levels->FindForeground({}, part, member.ObserverOf(observer));
      });
    if (!found)
    {
      return false;
    }
  }
  return true;
}

// All surfaces together.
bool OrganGroup::Deform(const Monitor& monitor, const GroupObserver& observer)
{
  std::vector<DeformingSurface*> organs;
  for (const auto& member : this->Members)
  {
    const ConstraintList all = member->All();
    const DeformableSurface start = member->Segmenter.StartWithin(all);
    member->Naming(
      [&]
      {
        member->Levels->Begin(all, &start, OutsidePoints::FromTheStart,
          member->ObserverOf(observer));
        return true;
      });
    organs.push_back(&member->Organ());
  }
  std::vector<DeformableSurface> fixed;
  for (const FixedSurface& surface : this->Fixed)
  {
    fixed.push_back(surface.Surface);
  }
  return DeformationLoop(std::move(organs), std::move(fixed), this->Threads.For)
    .Run(FlipFree::PartOf(monitor, ForegroundsEnd, 1));
}

// Should be impossible; counted exactly all the same, since users rely on it.
void OrganGroup::RequireDisjoint(const std::vector<VolumeSegmentation>& results) const
{
  std::vector<DeformableSurface> surfaces;
  std::size_t voxels = 0;
  BitMask united(this->Geometry);
  for (const VolumeSegmentation& result : results)
  {
    surfaces.push_back({ result.Organ.Mesh, result.Organ.Points });
    voxels += CountVoxels(result.Voxels);
    united.InsertRuns(result.Voxels);
  }
  std::vector<const DeformableSurface*> all;
  all.reserve(surfaces.size() + this->Fixed.size());
  for (const DeformableSurface& surface : surfaces)
  {
    all.push_back(&surface);
  }
  for (const FixedSurface& surface : this->Fixed)
  {
    all.push_back(&surface.Surface);
  }
  if (MeetOrNest(all, this->Threads.For) || united.Count() != voxels)
  {
    throw std::logic_error(
      "surfaces of two organs meet although every step was certified, which should be impossible; "
      "please report it with the image and the parameters");
  }
}

void OrganGroup::TakeConstraints(const std::vector<ConstraintList>& constraints)
{
  if (constraints.size() != this->Members.size())
  {
    throw Error(ErrorCode::OutOfRange,
      "there are " + std::to_string(constraints.size()) + " lists of constraints for " +
        std::to_string(this->Members.size()) + " organs; give each organ one, which may be empty");
  }
  for (const auto& member : this->Members)
  {
    member->Constraints = SortedConstraints(constraints[member->Index]);
    member->Naming(
      [&]
      {
        RequireConstraints(this->Geometry, member->Seed, member->Constraints, this->Name, {});
        return true;
      });
  }
  this->RequirePointsApart(constraints);
}

// What lies in another organ is not missed.
void OrganGroup::DropSettledQuestions(std::vector<VolumeSegmentation>& results) const
{
  for (VolumeSegmentation& result : results)
  {
    const auto isSettled = [&](const DoubtfulPart& part)
    {
      const std::array<int, 3> voxel = NearestVoxel(this->Geometry, part.Place);
      return !part.IsIncluded &&
        (std::any_of(results.begin(), results.end(),
           [&](const VolumeSegmentation& other) { return HasVoxel(other.Voxels, voxel); }) ||
          std::any_of(this->Fixed.begin(), this->Fixed.end(),
            [&](const FixedSurface& fixed) {
              return WindingNumber(fixed.Surface.Points, fixed.Surface.Mesh.Triangles,
                       part.Place) != 0;
            }));
    };
    result.Questions.erase(
      std::remove_if(result.Questions.begin(), result.Questions.end(), isSettled),
      result.Questions.end());
  }
}

// The surface of a member, its voxels, and what may be wrong with it; all seconds but those of the
// deformation, which all members share.
VolumeSegmentation OrganGroup::Finish(Member& member) const
{
  Stopwatch watch;
  VolumeSegmentation result;
  OrganSurface& organ = result.Organ;
  organ = std::move(member.Organ().GetSurface());
  organ.SmoothingSeconds =
    member.Organ().GetForeground().GetSmoothingSeconds() - member.SmoothedBefore;
  organ.FeatureSeconds -= organ.SmoothingSeconds;
  organ.SelfIntersections =
    CountSelfIntersections(organ.Points, organ.Mesh.Faces, this->Threads.For);
  result.StageSeconds[0] = organ.SmoothingSeconds;
  result.StageSeconds[1] = organ.FeatureSeconds;
  watch.Lap();
  member.Naming(
    [&]
    {
      member.Segmenter.Complete(member.Constraints, result);
      return true;
    });
  result.StageSeconds[3] = watch.Lap();
  return result;
}

std::vector<VolumeSegmentation> OrganGroup::Segment(const std::vector<ConstraintList>& constraints,
  const Monitor& monitor, const GroupObserver& observer)
{
  this->TakeConstraints(constraints);
  const RememberingMonitor remembering(monitor);
  Stopwatch watch;
  const bool done = this->Run(remembering.Get(), observer) && !remembering.HasStopped();
  double seconds = watch.Lap();
  std::vector<VolumeSegmentation> results(this->Members.size());
  for (const auto& member : this->Members)
  {
    VolumeSegmentation& result = results[member->Index];
    if (done)
    {
      result = this->Finish(*member);
      seconds -= result.StageSeconds[0] + result.StageSeconds[1];
      continue;
    }
    result.Organ.Reason = StopReason::Aborted;
    member->Levels = nullptr;
    member->Segmenter.Release(); // it may be half smoothed
  }
  for (VolumeSegmentation& result : results)
  {
    result.StageSeconds[2] = seconds / static_cast<double>(results.size());
  }
  if (done)
  {
    this->RequireDisjoint(results);
    this->DropSettledQuestions(results);
  }
  return results;
}

} // namespace FlipFree
