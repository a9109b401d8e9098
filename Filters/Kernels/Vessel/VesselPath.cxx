#include "Vessel/VesselPath.h"

#include "Error.h"
#include "Image/BoxReading.h"
#include "Intensity/Modality.h"
#include "Vessel/ScaleToCT.h"
#include "Vessel/StyleChoice.h"
#include "Vessel/VesselPoints.h"

#include <functional>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

VesselImage ImageAround(const GrayVolume& volume, const PointList& points, const VesselStyle& style,
  Modality modality, const VesselPathSettings& settings, const ParallelFor& parallelFor)
{
  const VoxelBox box = BoxAroundPoints(volume.Geometry, points, style.Margin);
  volume.RequireFinite(box);
  FloatImage voxels = ReadBox(volume.Read, volume.Geometry, box, parallelFor);
  if (modality == Modality::MR)
  {
    ScaleToCT(points, voxels);
  }
  return MakeVesselImage(std::move(voxels), settings.SmoothingDeviation, style.GridSpacing,
    parallelFor);
}

// A vessel of another style, where the image supports it by more than `least`; one without branches
// where the monitor stopped it.
std::optional<VesselTree> SeekOther(const std::function<VesselTree()>& trace, double least)
{
  try
  {
    VesselTree other = trace();
    if (other.Branches.empty() || other.Support > least)
    {
      return other;
    }
  }
  catch (const Error&) // no path, or voxels far away that are not finite
  {
  }
  return std::nullopt;
}

// Thin, wide, or wide and far away, without a wall.
VesselTree FindVessel(const GrayVolume& volume, const PointList& points, const PointList& outside,
  const VesselPathSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const Modality modality = ResolveModality(Modality::Automatic, volume.Read, volume.Geometry);
  constexpr double thinRadius = 3;
  constexpr double wideRadius = 10;
  constexpr double insideScale = 0.6; // what the wide style takes for the radius, of that found
  const auto searchAs = [&](const VesselStyle& style, double radius)
  {
    return VesselSearch(style, points, outside, radius,
      ImageAround(volume, points, style, modality, settings, parallelFor), parallelFor);
  };
  const Monitor first = PartOf(monitor, 0, 0.3);
  const Monitor second = PartOf(monitor, 0.3, 0.5);
  const Monitor third = PartOf(monitor, 0.5, 0.8);
  const Monitor fourth = PartOf(monitor, 0.8, 1);
  const bool isKnown = settings.Radius > 0;
  const bool isWide = isKnown && settings.Radius >= settings.WideRadius;
  const double knownInside = insideScale * settings.Radius;
  const double knownThin = isKnown ? settings.Radius : thinRadius;
  VesselSearch search =
    isWide ? searchAs(settings.Wide, knownInside) : searchAs(settings.Thin, knownThin);
  VesselTree found;
  std::optional<Error> noPath;
  try
  {
    found = search.Seek(first);
  }
  catch (const Error& error)
  {
    if (isKnown && !isWide)
    {
      throw;
    }
    noPath = error;
  }
  const auto isStopped = [&] { return !noPath && found.Branches.empty(); };
  if (isStopped())
  {
    return found;
  }
  double least = noPath ? DoubtfulSupport : found.Support; // support of one farther away
  bool isThin = !noPath && !isWide;
  if (!isKnown && MayBeWide(found.Radius, settings.WideRadius))
  {
    const double radius =
      insideScale * (found.Radius >= settings.WideRadius ? found.Radius : wideRadius);
    const std::optional<VesselTree> wide =
      SeekOther([&] { return searchAs(settings.Wide, radius).Seek(second); },
        LeastSupportOfWide(found.Radius, found.Support, settings.WideRadius));
    if (wide)
    {
      found = *wide;
      least = found.Support + ClearlyMore;
      isThin = false;
    }
  }
  if (isThin && search.IsDoubtful(found))
  {
    found = search.SeekBetter(found, third);
    least = found.Support;
  }
  if (isStopped() || (isKnown && !isWide) || (!noPath && !search.IsDoubtful(found)))
  {
    return found;
  }
  const std::optional<VesselTree> far = SeekOther(
    [&] {
      return searchAs(settings.Far, isWide ? knownInside : insideScale * wideRadius).Seek(fourth);
    },
    least);
  if (!far && noPath)
  {
    throw Error(*noPath);
  }
  return far.value_or(found);
}

} // namespace

VesselTree TraceVessel(const GrayVolume& volume, const std::string& name, const PointList& points,
  const PointList& outside, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor)
{
  RequirePoints(volume.Geometry, points, name);
  VesselTree tree = FindVessel(volume, points, outside, settings, threading.For, monitor);
  for (VesselBranch& branch : tree.Branches)
  {
    branch.Sections.Radii.array() += settings.WallThickness;
  }
  return tree;
}

} // namespace FlipFree
