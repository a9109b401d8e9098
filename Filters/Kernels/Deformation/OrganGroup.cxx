#include "Deformation/OrganGroup.h"

#include "Deformation/JointDeformation.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Intensity/OrganDivision.h"
#include "Mesh/MeshUnion.h"
#include "MessageText.h"
#include "Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace FlipFree
{
namespace
{

DeformableSurface UnionOf(const std::vector<const DeformableSurface*>& surfaces)
{
  DeformableSurface all;
  all.Points.resize(0, 3);
  for (const DeformableSurface* surface : surfaces)
  {
    AppendMesh(surface->Mesh, all.Mesh);
    AppendPoints(surface->Points, all.Points);
  }
  return all;
}

// Of embedded surfaces. Exact.
bool MeetOrNest(const std::vector<const DeformableSurface*>& surfaces,
  const ParallelFor& parallelFor)
{
  const DeformableSurface all = UnionOf(surfaces);
  return CountSelfIntersections(all.Points, all.Mesh.Faces, parallelFor) > 0 ||
    !NoneIsWithinAnother(surfaces);
}

std::vector<PointConstraint> SpheresOf(const SeedSphere& seed, const ConstraintList& constraints)
{
  std::vector<PointConstraint> spheres{ { ConstraintKind::Seed, seed.Center, seed.Radius } };
  std::copy_if(constraints.begin(), constraints.end(), std::back_inserter(spheres),
    [](const PointConstraint& constraint) { return constraint.Kind == ConstraintKind::Seed; });
  return spheres;
}

std::string TextOf(const PointConstraint& sphere)
{
  return "the sphere of " + std::to_string(std::lround(sphere.Radius)) + " mm at " +
    FlipFree::TextOf(sphere.Point) + " mm";
}

bool IsWithin(const VoxelBox& box, const std::array<int, 3>& voxel)
{
  bool within = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    within = within && box.Begin[axis] <= voxel[axis] && voxel[axis] < box.End[axis];
  }
  return within;
}

// What is known of an organ before it is segmented.
struct KnownOrgan
{
  std::string Name;
  std::vector<PointConstraint> Spheres; // of the seeds
  ConstraintList Points;
};

void RequireSpheresApart(const KnownOrgan& one, const KnownOrgan& two)
{
  for (const PointConstraint& sphere : one.Spheres)
  {
    for (const PointConstraint& other : two.Spheres)
    {
      if ((sphere.Point - other.Point).norm() < sphere.Radius + other.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          "the seeds of " + one.Name + " and " + two.Name + " overlap: " + TextOf(sphere) +
            " and " + TextOf(other) + "; move them apart, or lower a radius");
      }
    }
  }
}

void RequireNoPointInSpheres(const KnownOrgan& one, const KnownOrgan& two)
{
  for (const PointConstraint& sphere : one.Spheres)
  {
    for (const PointConstraint& point : two.Points)
    {
      if (point.Kind != ConstraintKind::Outside &&
        (sphere.Point - point.Point).norm() < sphere.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(point) + " of " + two.Name + " lies in the seed of " + one.Name +
            "; move one of them, or lower the radius");
      }
    }
  }
}

void RequirePlacesApart(const KnownOrgan& one, const KnownOrgan& two, double same)
{
  for (const PointConstraint& point : one.Points)
  {
    for (const PointConstraint& other : two.Points)
    {
      if (point.Kind == ConstraintKind::Inside &&
        (other.Kind == ConstraintKind::Inside || other.Kind == ConstraintKind::Boundary) &&
        (point.Point - other.Point).norm() <= same)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(point) + " of " + one.Name + " and " + NameOf(other) + " of " + two.Name +
            " are at one place; take one of them away");
      }
    }
  }
}

bool Contains(const FixedSurface& fixed, const Eigen::Vector3d& point)
{
  return WindingNumber(fixed.Surface.Points, fixed.Surface.Mesh.Triangles, point) != 0;
}

void RequireSphereOutside(const FixedSurface& fixed, const PointConstraint& sphere,
  const std::string& organ)
{
  const SurfacePlace nearest =
    ClosestPlace(fixed.Surface.Points, fixed.Surface.Mesh.Triangles, sphere.Point);
  if ((nearest.Point - sphere.Point).norm() < sphere.Radius || Contains(fixed, sphere.Point))
  {
    throw Error(ErrorCode::OutOfRange,
      "a seed of " + organ + ", " + TextOf(sphere) + ", meets " + fixed.Name +
        ", which stays as it is; move the seed, or lower its radius");
  }
}

void RequireOutside(const FixedSurface& fixed, const KnownOrgan& organ)
{
  for (const PointConstraint& point : organ.Points)
  {
    if (point.Kind != ConstraintKind::Outside && Contains(fixed, point.Point))
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf(point) + " of " + organ.Name + " lies in " + fixed.Name +
          ", which stays as it is; move the point");
    }
    if (point.Kind == ConstraintKind::Seed)
    {
      RequireSphereOutside(fixed, point, organ.Name);
    }
  }
}

void RequireNames(const std::vector<SeededOrgan>& organs)
{
  if (organs.empty())
  {
    throw Error(ErrorCode::OutOfRange, "there is no organ; give each a name and a seed");
  }
  std::vector<std::string> names;
  names.reserve(organs.size());
  for (const SeededOrgan& organ : organs)
  {
    names.push_back(organ.Name);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (names.front().empty() || twice != names.end())
  {
    throw Error(ErrorCode::OutOfRange,
      names.front().empty() ? "an organ has no name; give each one of its own"
                            : "two organs are named " + *twice + "; give each a name of its own");
  }
}

void RequireSettings(const OrganSegmentationSettings& method)
{
  if (!method.Step.Guard || !method.Feature.Carving)
  {
    throw Error(ErrorCode::OutOfRange,
      "several organs are segmented together under the guard, and with carving; switch Guard and "
      "Carving on, or segment them one by one");
  }
}

} // namespace

struct OrganGroup::Member
{
  std::size_t Index; // in the order of the caller
  std::string Name;
  SeedSphere Seed;
  SeedSphere Start;
  VolumeSegmenter Segmenter;

  // Of the present call.
  ConstraintList Constraints;
  ConstraintList OfOthers;                                    // outside points
  std::vector<std::pair<std::string, std::string>> Renamings; // of these, in messages
  OrganSegmenter* Levels = nullptr;
  double SmoothedBefore = 0;

  DeformingOrgan& Organ() const { return this->Levels->GetOrgan(); }
  ConstraintList All() const
  {
    ConstraintList all = this->Constraints;
    all.insert(all.end(), this->OfOthers.begin(), this->OfOthers.end());
    return all;
  }

  // Returns call(). Errors get the organ's name in front, and points of others are called as the
  // user gave them.
  template <typename Call>
  auto Naming(const Call& call) const
  {
    try
    {
      return call();
    }
    catch (const Error& error)
    {
      throw Error(error.GetCode(), this->Name + ": " + this->Renamed(error.what()));
    }
    catch (const std::invalid_argument& error) // such as a voxel that is not finite
    {
      throw std::invalid_argument(this->Name + ": " + error.what());
    }
  }

  std::string Renamed(std::string message) const
  {
    for (const auto& [from, to] : this->Renamings)
    {
      const std::size_t found = message.find(from);
      if (found != std::string::npos)
      {
        return message.replace(found, from.size(), to);
      }
    }
    return message;
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
  RequireNames(organs);
  RequireSettings(settings.Method);
  for (std::size_t index = 0; index < organs.size(); ++index)
  {
    const SeededOrgan& organ = organs[index];
    const SeedSphere start{ organ.Seed.Center + settings.StartCenterOffset,
      settings.StartScale * organ.Seed.Radius };
    this->Members.push_back(NamingSurface(organ.Name,
      [&]
      {
        return std::make_unique<Member>(Member{ index, organ.Name, organ.Seed, start,
          VolumeSegmenter(volume, name, organ.Seed, nullptr, settings, threading), {}, {}, {},
          nullptr, 0 });
      }));
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
  this->RequireStartsApart();
}

OrganGroup::~OrganGroup() = default;

// The start spheres and the fixed surfaces.
void OrganGroup::RequireStartsApart() const
{
  for (auto one = this->Members.begin(); one != this->Members.end(); ++one)
  {
    for (auto two = one + 1; two != this->Members.end(); ++two)
    {
      const SeedSphere& start = (*one)->Start;
      const SeedSphere& other = (*two)->Start;
      if ((start.Center - other.Center).norm() < start.Radius + other.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          "the start spheres of " + (*one)->Name + " and " + (*two)->Name +
            " overlap; lower StartScale, or move the seeds apart");
      }
    }
    const DeformableSurface start = (*one)->Segmenter.StartWithin({});
    for (const FixedSurface& surface : this->Fixed)
    {
      if (MeetOrNest({ &start, &surface.Surface }, this->Threads.For))
      {
        throw Error(ErrorCode::OutOfRange,
          "the start sphere of " + (*one)->Name + " meets " + surface.Name +
            ", which stays as it is; move the seed, or lower its radius");
      }
      RequireSphereOutside(surface, SpheresOf((*one)->Seed, {}).front(), (*one)->Name);
    }
  }
  for (auto one = this->Fixed.begin(); one != this->Fixed.end(); ++one)
  {
    for (auto two = one + 1; two != this->Fixed.end(); ++two)
    {
      if (MeetOrNest({ &one->Surface, &two->Surface }, this->Threads.For))
      {
        throw Error(ErrorCode::SelfIntersecting,
          one->Name + " and " + two->Name +
            " meet; of surfaces that stay as they are, none may "
            "meet another or lie in it");
      }
    }
  }
}

// The seeds and points of different organs, and those of each from the fixed surfaces.
void OrganGroup::RequirePointsApart(const std::vector<ConstraintList>& constraints) const
{
  const double same = 1e-3 * this->Geometry.Spacing.minCoeff();
  const auto knownOf = [&](const std::unique_ptr<Member>& member)
  {
    const ConstraintList& points = constraints[member->Index];
    return KnownOrgan{ member->Name, SpheresOf(member->Seed, points), points };
  };
  for (const auto& member : this->Members)
  {
    const KnownOrgan one = knownOf(member);
    for (const auto& other : this->Members)
    {
      if (other != member)
      {
        const KnownOrgan two = knownOf(other);
        RequireSpheresApart(one, two);
        RequireNoPointInSpheres(one, two);
        RequirePlacesApart(one, two, same);
      }
    }
    for (const FixedSurface& surface : this->Fixed)
    {
      RequireOutside(surface, one);
    }
  }
}

// What is certain of the other organs, as far as this one can reach.
void OrganGroup::FindPointsOfOthers(Member& member) const
{
  member.OfOthers.clear();
  member.Renamings.clear();
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
        const PointConstraint outside{ ConstraintKind::Outside, point.Point, 0 };
        member.OfOthers.push_back(outside);
        const std::string given = point.Kind == ConstraintKind::Seed
          ? "the seed at " + TextOf(point.Point) + " mm"
          : NameOf(point);
        member.Renamings.emplace_back(NameOf(outside),
          given + " of " + other->Name + ", which must lie outside " + member.Name + ",");
      }
    }
  }
}

BitMask OrganGroup::FixedVoxels(const ImageGeometry& region) const
{
  BitMask voxels(region);
  for (const FixedSurface& surface : this->Fixed)
  {
    for (const VoxelRun& run : VoxelizeSurface(surface.Surface.Points,
           surface.Surface.Mesh.Triangles, region, this->Threads.For))
    {
      voxels.InsertRun(run.Begin, run.End, run.J, run.K);
    }
  }
  return voxels;
}

// Makes the foregrounds disjoint, also with the fixed surfaces.
bool OrganGroup::Divide(const Monitor& monitor)
{
  std::vector<OrganClaim> claims;
  for (const auto& member : this->Members)
  {
    GrowingForeground& foreground = member->Organ().GetForeground();
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
    const ImageGeometry& region = foreground.GetMask().GetGeometry();
    claims.push_back({ foreground.GetMask(), foreground.GetImage(),
      member->Segmenter.GetBox().Begin, member->Seed, member->Constraints,
      member->Segmenter.GetNoise(), this->Fixed.empty() ? BitMask() : this->FixedVoxels(region) });
  }
  const Modality modality = this->Members.front()->Organ().GetForeground().GetModality();
  if (!DivideClaims(claims, modality, this->Threads.For, monitor))
  {
    return false;
  }
  for (std::size_t index = 0; index < claims.size(); ++index)
  {
    this->Members[index]->Organ().SettleForeground(claims[index].Mask);
  }
  return true;
}

bool OrganGroup::Run(const Monitor& monitor, const GroupObserver& observer)
{
  const double half = 0.5;
  const auto count = static_cast<double>(this->Members.size());
  const auto observerOf = [&observer](const Member& member) -> IterationObserver
  {
    return [&observer, index = member.Index](const ContourMesh& mesh, const PointList& points,
             const CorrespondenceField& field, const IterationRecord& record)
    { observer(index, mesh, points, field, record); };
  };
  for (std::size_t index = 0; index < this->Members.size(); ++index)
  {
    Member& member = *this->Members[index];
    const Monitor part = FlipFree::PartOf(monitor, half * static_cast<double>(index) / count,
      half * static_cast<double>(index + 1) / count);
    const bool found = member.Naming(
      [&]
      {
        member.Levels = &member.Segmenter.Prepare(member.Constraints);
        member.Organ().SetName(member.Name);
        member.Renamings.clear();
        member.SmoothedBefore = member.Organ().GetForeground().GetSmoothingSeconds();
        return member.Levels->FindForeground({}, part, observerOf(member));
      });
    if (!found)
    {
      return false;
    }
  }
  for (const auto& member : this->Members)
  {
    this->FindPointsOfOthers(*member);
  }
  if (!this->Divide([&](double) { return monitor(half); }))
  {
    return false;
  }
  std::vector<DeformingOrgan*> organs;
  for (const auto& member : this->Members)
  {
    const ConstraintList all = member->All();
    const DeformableSurface start = member->Segmenter.StartWithin(all);
    member->Naming(
      [&]
      {
        member->Levels->Begin(all, &start, OutsidePoints::FromTheStart, observerOf(*member));
        return true;
      });
    organs.push_back(&member->Organ());
  }
  std::vector<DeformableSurface> fixed;
  for (const FixedSurface& surface : this->Fixed)
  {
    fixed.push_back(surface.Surface);
  }
  return JointDeformation(std::move(organs), std::move(fixed), this->Threads.For)
    .Run(FlipFree::PartOf(monitor, half, 1));
}

// By construction. Exact.
void OrganGroup::RequireDisjoint(const std::vector<VolumeSegmentation>& results) const
{
  std::vector<DeformableSurface> surfaces;
  std::size_t voxels = 0;
  BitMask united(this->Geometry);
  for (const VolumeSegmentation& result : results)
  {
    surfaces.push_back({ result.Organ.Mesh, result.Organ.Points });
    voxels += CountVoxels(result.Voxels);
    for (const VoxelRun& run : result.Voxels)
    {
      united.InsertRun(run.Begin, run.End, run.J, run.K);
    }
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

std::vector<VolumeSegmentation> OrganGroup::Segment(const std::vector<ConstraintList>& constraints,
  const Monitor& monitor, const GroupObserver& observer)
{
  if (constraints.size() != this->Members.size())
  {
    throw std::invalid_argument("there are " + std::to_string(constraints.size()) +
      " lists of constraints for " + std::to_string(this->Members.size()) +
      " organs; give each organ one, which may be empty");
  }
  for (const auto& member : this->Members)
  {
    member->Constraints = SortedConstraints(constraints[member->Index]);
    member->Naming(
      [&]
      {
        RequireConstraints(this->Geometry, member->Seed, member->Constraints, this->Name);
        return true;
      });
  }
  this->RequirePointsApart(constraints);
  bool stopped = false;
  const Monitor ask = [&](double fraction)
  {
    stopped = stopped || !monitor(fraction);
    return !stopped;
  };
  Stopwatch watch;
  const bool done = this->Run(ask, observer) && !stopped;
  std::vector<VolumeSegmentation> results(this->Members.size());
  double seconds = watch.Lap();
  for (const auto& member : this->Members)
  {
    VolumeSegmentation& result = results[member->Index];
    if (!done)
    {
      result.Organ.Reason = StopReason::Aborted;
      continue;
    }
    OrganSurface& organ = result.Organ;
    organ = std::move(member->Organ().GetSurface());
    organ.SmoothingSeconds =
      member->Organ().GetForeground().GetSmoothingSeconds() - member->SmoothedBefore;
    organ.FeatureSeconds -= organ.SmoothingSeconds;
    organ.SelfIntersections =
      CountSelfIntersections(organ.Points, organ.Mesh.Faces, this->Threads.For);
    result.StageSeconds[0] = organ.SmoothingSeconds;
    result.StageSeconds[1] = organ.FeatureSeconds;
    seconds -= organ.SmoothingSeconds + organ.FeatureSeconds;
    watch.Lap();
    member->Naming(
      [&]
      {
        member->Segmenter.Judge(member->Constraints, result);
        return true;
      });
    result.StageSeconds[3] = watch.Lap();
  }
  for (VolumeSegmentation& result : results)
  {
    result.StageSeconds[2] = seconds / static_cast<double>(results.size());
  }
  if (done)
  {
    this->RequireDisjoint(results);
  }
  return results;
}

} // namespace FlipFree
