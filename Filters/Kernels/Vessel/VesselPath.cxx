#include "Vessel/VesselPath.h"

#include "Error.h"
#include "Image/BoxReading.h"
#include "Vessel/ScaleToCT.h"
#include "Vessel/StyleChoice.h"
#include "Vessel/VesselPoints.h"

#include <functional>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

namespace FlipFree
{
namespace
{

// Where nothing is known of the vessel, in millimeters.
constexpr double UsualThinRadius = 3;
constexpr double UsualWideRadius = 10;
// What the wide style takes for the radius, of that found.
constexpr double InsideScale = 0.6;

// A vessel of another style, where it is the better one; one without branches where the monitor
// stopped it.
std::optional<VesselTree> SeekOther(const std::function<VesselTree()>& trace,
  const std::function<bool(const VesselTree&)>& isBetter)
{
  try
  {
    VesselTree other = trace();
    if (other.Branches.empty() || isBetter(other))
    {
      return other;
    }
  }
  catch (const Error&) // no path
  {
  }
  return std::nullopt;
}

// Thin, wide, or wide and far away, without a wall.
class VesselOfAnyStyle
{
public:
  VesselOfAnyStyle(const GrayVolume& volume, const PointList& points, const PointList& outside,
    const VesselPathSettings& settings, const ParallelFor& parallelFor)
    : Volume(volume)
    , Points(points)
    , Outside(outside)
    , Settings(settings)
    , Parallel(parallelFor)
    , OfModality(ResolveModality(settings.Modality, volume.Read, volume.Geometry))
    , IsKnown(settings.Radius > 0)
    , IsWide(this->IsKnown && settings.Radius >= settings.WideRadius)
    , Search(this->IsWide
          ? this->SearchAs(settings.Wide, InsideScale * settings.Radius)
          : this->SearchAs(settings.Thin, this->IsKnown ? settings.Radius : UsualThinRadius))
  {
  }

  // None where the monitor stopped it.
  VesselTree Find(const Monitor& monitor)
  {
    this->SeekFirst(PartOf(monitor, 0, 0.3));
    if (this->IsStopped())
    {
      return this->Found;
    }
    if (!this->IsKnown && MayBeWide(this->Found.Radius, this->Settings.WideRadius))
    {
      this->SeekWide(PartOf(monitor, 0.3, 0.5));
    }
    if (this->IsThin && this->Search.IsDoubtful(this->Found))
    {
      this->Found = this->Search.SeekBetter(this->Found, PartOf(monitor, 0.5, 0.8));
      this->Least = this->Found.Support;
    }
    if (this->IsStopped() || (this->IsKnown && !this->IsWide) ||
      (!this->NoPath && !this->Search.IsDoubtful(this->Found)))
    {
      return this->Found;
    }
    return this->SeekFar(PartOf(monitor, 0.8, 1));
  }

private:
  VesselSearch SearchAs(const VesselStyle& style, double radius) const
  {
    return VesselSearch(style, this->Points, this->Outside, radius, this->ImageAround(style),
      this->Parallel);
  }

  VesselImage ImageAround(const VesselStyle& style) const
  {
    const ImageGeometry& geometry = this->Volume.Geometry;
    const VoxelBox box = BoxAroundPoints(geometry, this->Points, style.Margin);
    FloatImage voxels = ReadBox(this->Volume.Read, geometry, box, this->Parallel);
    if (this->OfModality == Modality::MR)
    {
      ScaleToCT(this->Points, voxels);
    }
    return MakeVesselImage(std::move(voxels), this->Settings.SmoothingDeviation, style.GridSpacing,
      this->Parallel);
  }

  bool IsStopped() const { return !this->NoPath && this->Found.Branches.empty(); }

  void SeekFirst(const Monitor& monitor)
  {
    try
    {
      this->Found = this->Search.Seek(monitor);
    }
    catch (const Error& error)
    {
      if (this->IsKnown && !this->IsWide)
      {
        throw;
      }
      this->NoPath = error;
    }
    this->Least = this->NoPath ? DoubtfulSupport : this->Found.Support;
    this->IsThin = !this->NoPath && !this->IsWide;
  }

  void SeekWide(const Monitor& monitor)
  {
    const TracedStyle thin{ this->Found.Radius, this->Found.Support };
    const double least = this->Settings.WideRadius;
    const double radius = InsideScale * (thin.Radius >= least ? thin.Radius : UsualWideRadius);
    const std::optional<VesselTree> other =
      SeekOther([&] { return this->SearchAs(this->Settings.Wide, radius).Seek(monitor); },
        [&](const VesselTree& wide) {
          return IsWideRather({ wide.Radius, wide.Support }, thin, least);
        });
    if (other)
    {
      this->Found = *other;
      this->Least = this->Found.Support;
      this->IsThin = false;
    }
  }

  // Throws where there is no path at all.
  VesselTree SeekFar(const Monitor& monitor) const
  {
    const double radius = InsideScale * (this->IsWide ? this->Settings.Radius : UsualWideRadius);
    const std::optional<VesselTree> far =
      SeekOther([&] { return this->SearchAs(this->Settings.Far, radius).Seek(monitor); },
        [this](const VesselTree& other) { return other.Support > this->Least; });
    if (!far && this->NoPath)
    {
      throw Error(*this->NoPath);
    }
    return far.value_or(this->Found);
  }

  const GrayVolume& Volume;
  const PointList& Points;
  const PointList& Outside;
  const VesselPathSettings& Settings;
  const ParallelFor& Parallel;
  const Modality OfModality;
  const bool IsKnown; // the radius
  const bool IsWide;  // as far as is known
  VesselSearch Search;

  VesselTree Found;
  std::optional<Error> NoPath;
  double Least = 0; // what the support of one farther away must exceed
  bool IsThin = false;
};

// A negative thickness leaves a tube everywhere, or is an error.
void AddWall(double thickness, VesselSections& sections)
{
  constexpr double least = 0.5; // mm
  const double radius = sections.Radii.mean();
  if (thickness < 0 && radius + thickness < least)
  {
    std::ostringstream text;
    text << "a {WallThickness} of " << thickness << " mm leaves less than " << least
         << " mm of a branch with a mean radius of " << std::fixed << std::setprecision(1) << radius
         << " mm; raise {WallThickness}";
    throw Error(ErrorCode::OutOfRange, text.str());
  }
  sections.Radii =
    (sections.Radii.array() + thickness).max(sections.Radii.array().min(least)).matrix();
}

} // namespace

VesselTree TraceVessel(const GrayVolume& volume, const std::string& name, const PointList& points,
  const PointList& outside, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor)
{
  RequirePoints(volume, points, name);
  VesselTree tree =
    VesselOfAnyStyle(volume, points, outside, settings, threading.For).Find(monitor);
  for (VesselBranch& branch : tree.Branches)
  {
    AddWall(settings.WallThickness, branch.Sections);
  }
  return tree;
}

} // namespace FlipFree
