#include "Vessel/VesselPath.h"

#include "Error.h"
#include "Image/BoxReading.h"
#include "Image/ImageInterpolation.h"
#include "Intensity/Modality.h"
#include "MessageText.h"
#include "Vessel/MinimalPaths.h"
#include "Vessel/Polyline.h"
#include "Vessel/SectionSupport.h"
#include "Vessel/StyleChoice.h"
#include "Vessel/VesselImage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double LeastDistance = 3;    // between two points, mm
constexpr double ProlongDistance = 15; // of a point from a path's end that prolongs it, mm
constexpr double LineDeviation = 2;    // smoothing of paths before sections are fitted, in sections
// A path over a stretch of this length, in mm, without the vessel's gray values is none.
constexpr double LongestGap = 40;
constexpr double GapSpeed = 0.004;
constexpr double LargestRadius = 45;  // mm; no vessel's mean, but what outlines run away to
constexpr double LeastSupport = 0.25; // below it, an outline is that of nothing
// The mean support over a stretch below which it is doubtful whether a path is in the vessel.
constexpr double FaintSupport = 0.7;
constexpr double FaintLength = 40; // mm
// Where the next path should not run: faint over a shorter length, mm.
constexpr double StraySupport = 0.6;
constexpr double StrayLength = 15;
// Gray values other than Hounsfield units are scaled so that most of them span what they do in CT.
constexpr double SpanInCT = 250;

void RequirePoints(const ImageGeometry& geometry, const PointList& points, const std::string& name)
{
  if (points.rows() < 2)
  {
    throw Error(ErrorCode::OutOfRange,
      "a vessel needs two points or more, not " + std::to_string(points.rows()) +
        "; give one at either end");
  }
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    const Eigen::Vector3d index = geometry.ToIndex(points.row(point).transpose());
    bool inside = index.allFinite();
    for (int axis = 0; axis < 3; ++axis)
    {
      inside = inside && index[axis] >= -0.5 && index[axis] <= geometry.Dimensions[axis] - 0.5;
    }
    if (!inside)
    {
      throw Error(ErrorCode::OutOfRange,
        "the point " + TextOf(points.row(point)) + " mm lies outside " + name +
          "; put it into the vessel, in LPS millimeters");
    }
    for (Eigen::Index other = 0; other < point; ++other)
    {
      if ((points.row(point) - points.row(other)).norm() < LeastDistance)
      {
        throw Error(ErrorCode::OutOfRange,
          "the points " + TextOf(points.row(other)) + " and " + TextOf(points.row(point)) +
            " mm are closer than " + std::to_string(static_cast<int>(LeastDistance)) +
            " mm; keep one of them");
      }
    }
  }
}

double Quantile(std::vector<float> values, double part)
{
  const auto place =
    values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// In which a thin vessel may be so few voxels that only its points tell of its contrast.
double SpanOf(const FloatImage& image, const PointList& points)
{
  constexpr double spanOverContrast = 2.5; // in CT, of vessels with contrast medium
  constexpr double ball = 1.5;             // mm
  const double median = Quantile(image.Voxels, 0.5);
  double contrast = 0;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    double sum = 0;
    const auto voxels = VoxelsInSphere(image.Geometry, { points.row(point).transpose(), ball });
    for (const std::size_t voxel : voxels)
    {
      sum += image.Voxels[voxel];
    }
    contrast = voxels.empty()
      ? contrast
      : std::max(contrast, std::abs(sum / static_cast<double>(voxels.size()) - median));
  }
  return std::max(Quantile(image.Voxels, 0.9) - Quantile(image.Voxels, 0.1),
    spanOverContrast * contrast);
}

void ScaleToCT(const PointList& points, FloatImage& image)
{
  const double span = SpanOf(image, points);
  const auto scale = static_cast<float>(span > 0 ? SpanInCT / span : 1);
  for (float& value : image.Voxels)
  {
    value *= scale;
  }
}

PointList Snap(const ImageView<float>& image, const PointList& points, double distance)
{
  PointList snapped = points;
  for (Eigen::Index point = 0; point < points.rows() && distance > 0; ++point)
  {
    float brightest = -std::numeric_limits<float>::infinity();
    for (const std::size_t voxel :
      VoxelsInSphere(image.Geometry, { points.row(point).transpose(), distance }))
    {
      if (image.Data[voxel] > brightest)
      {
        brightest = image.Data[voxel];
        snapped.row(point) = image.Geometry.ToPhysical(IndexOf(image.Geometry, voxel));
      }
    }
  }
  return snapped;
}

// First guesses at the radii from the depth along the line.
Eigen::VectorXd FirstRadii(const FloatImage& depth, const PointList& line)
{
  Eigen::VectorXd along(line.rows());
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    along[place] =
      InterpolateClamped(depth.View(), depth.Geometry.ToIndex(line.row(place).transpose()));
  }
  Eigen::VectorXd sorted = along;
  std::nth_element(sorted.data(), sorted.data() + sorted.size() / 2, sorted.data() + sorted.size());
  return (1.15 * MedianAlong(along, 4)).cwiseMin(1.5 * sorted[sorted.size() / 2]).cwiseMax(1.0);
}

// Of all sections of a tree.
double MeanRadius(const VesselTree& tree)
{
  double sum = 0;
  Eigen::Index sections = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    sum += branch.Sections.MeanRadii().sum();
    sections += branch.Sections.Radii.rows();
  }
  return sum / static_cast<double>(std::max<Eigen::Index>(1, sections));
}

// Of all sections of a tree.
double MeanSupport(const VesselTree& tree)
{
  double sum = 0;
  Eigen::Index sections = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    sum += branch.Support.sum();
    sections += branch.Support.size();
  }
  return sum / static_cast<double>(std::max<Eigen::Index>(1, sections));
}

// Mean of all sections, by how well the image supports them.
double SupportedRadius(const VesselTree& tree)
{
  double sum = 0;
  double weights = 0;
  for (const VesselBranch& branch : tree.Branches)
  {
    const Eigen::VectorXd weight = branch.Support.cwiseAbs2();
    sum += weight.dot(branch.Sections.MeanRadii());
    weights += weight.sum();
  }
  return weights > 0 ? sum / weights : 0;
}

// Lets a line begin on the plane across it through a point near its begin: shortens or prolongs it.
void BeginAt(const Eigen::RowVector3d& point, PointList& line)
{
  constexpr Eigen::Index places = 8; // more than a point is snapped by
  const Eigen::Index looked = std::min<Eigen::Index>(places, line.rows() - 2);
  Eigen::Index nearest = 0;
  (line.topRows(looked).rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  if (nearest > 0)
  {
    line = PointList(line.bottomRows(line.rows() - nearest));
    return;
  }
  const Eigen::RowVector3d outward = (line.row(0) - line.row(1)).normalized();
  const double beyond = (point - line.row(0)).dot(outward);
  constexpr double least = 0.01; // mm; nearer, two points would be one but for rounding
  if (beyond > least)
  {
    PointList longer(line.rows() + 1, 3);
    longer << line.row(0) + beyond * outward, line;
    line = longer;
  }
}

// A path leads to where its points were snapped; the vessel ends where they were clicked.
void EndAtPoints(const PointList& snapped, const PointList& clicked, bool hasParent,
  PointList& line)
{
  for (int end = hasParent ? 1 : 0; end < 2; ++end)
  {
    Eigen::Index nearest = 0;
    const Eigen::RowVector3d place = line.row(end == 0 ? 0 : line.rows() - 1);
    (snapped.rowwise() - place).rowwise().squaredNorm().minCoeff(&nearest);
    if (end == 1)
    {
      line = PointList(line.colwise().reverse());
    }
    BeginAt(clicked.row(nearest), line);
    if (end == 1)
    {
      line = PointList(line.colwise().reverse());
    }
  }
}

// The longest stretch of a path without the vessel's gray values, in mm.
double LongestGapOf(const FloatImage& speed, const PointList& line)
{
  double longest = 0;
  double now = 0;
  for (Eigen::Index place = 1; place < line.rows(); ++place)
  {
    const bool isGap = InterpolateClamped(speed.View(),
                         speed.Geometry.ToIndex(line.row(place).transpose())) < GapSpeed;
    now = isGap ? now + (line.row(place) - line.row(place - 1)).norm() : 0;
    longest = std::max(longest, now);
  }
  return longest;
}

void RequirePath(const FloatImage& speed, const PointList& line)
{
  if (LongestGapOf(speed, line) > LongestGap)
  {
    throw Error(ErrorCode::NoContrast,
      "no path through gray values like those at the points joins " + TextOf(line.row(0)) +
        " and " + TextOf(line.row(line.rows() - 1)) +
        " mm; put all points into the same vessel, and more of them on its way");
  }
}

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

// As slow as where nothing is like the vessel, but no obstacle.
void SlowDown(const PointList& places, double floor, FloatImage& speed)
{
  constexpr double distance = 3; // mm
  for (Eigen::Index place = 0; place < places.rows(); ++place)
  {
    for (const std::size_t voxel :
      VoxelsInSphere(speed.Geometry, { places.row(place).transpose(), distance }))
    {
      speed.Voxels[voxel] = static_cast<float>(floor);
    }
  }
}

// Lets the next path avoid places at which the outline is that of nothing; false if there are none.
bool AvoidStrays(const VesselTree& tree, double sectionStep, double floor, FloatImage& speed)
{
  constexpr double slower = 0.1;
  constexpr double farthest = 8; // mm
  std::vector<std::size_t> strays;
  for (const VesselBranch& branch : tree.Branches)
  {
    const Eigen::VectorXd along = SupportAlong(branch.Support, sectionStep, StrayLength);
    const Eigen::VectorXd radii = branch.Sections.MeanRadii();
    for (Eigen::Index section = 0; section < along.size(); ++section)
    {
      if (along[section] < StraySupport)
      {
        const std::vector<std::size_t> voxels = VoxelsInSphere(speed.Geometry,
          { branch.Sections.Frames[section].Origin, std::min(farthest, radii[section]) });
        strays.insert(strays.end(), voxels.begin(), voxels.end());
      }
    }
  }
  std::sort(strays.begin(), strays.end());
  strays.erase(std::unique(strays.begin(), strays.end()), strays.end());
  for (const std::size_t voxel : strays)
  {
    speed.Voxels[voxel] =
      static_cast<float>(std::max(floor, slower * static_cast<double>(speed.Voxels[voxel])));
  }
  return !strays.empty();
}

// Whether the image hardly shows the outline, or does not over a long stretch.
bool IsDoubtful(const VesselTree& tree, double sectionStep)
{
  return tree.Support < DoubtfulSupport ||
    std::any_of(tree.Branches.begin(), tree.Branches.end(),
      [&](const VesselBranch& branch)
      { return SupportAlong(branch.Support, sectionStep, FaintLength).minCoeff() < FaintSupport; });
}

// The search for a vessel of one style: first as it is clicked, and where that is doubtful again.
class VesselSearch
{
public:
  VesselSearch(const VesselStyle& style, const PointList& clicked, const PointList& outside,
    double radius, VesselImage image, const ParallelFor& parallelFor)
    : Style(style)
    , Clicked(clicked)
    , Outside(outside)
    , Radius(radius)
    , Image(std::move(image))
    , Parallel(parallelFor)
  {
  }

  /// Nothing where the monitor stopped it.
  VesselTree Seek(const Monitor& monitor)
  {
    this->Begin(this->Style.SnapDistance);
    return this->Trace(monitor);
  }

  /// Where a first result is doubtful, other paths: away from where the image showed no outline,
  /// and from the points as they are clicked, since what is brightest near them may be something
  /// else. The first one that is not doubtful is taken, or that with the highest support. Nothing
  /// where the monitor stopped it.
  VesselTree SeekBetter(const VesselTree& found, const Monitor& monitor)
  {
    constexpr int searches = 2; // away from strays
    VesselTree best = found;
    double least = found.Support;
    VesselTree last = found;
    for (const bool isSnapped : { true, false })
    {
      for (int search = isSnapped ? 0 : -1; search < searches; ++search)
      {
        if (search < 0)
        {
          this->Begin(0);
        }
        else if (!AvoidStrays(last, this->Style.Sections.SectionStep, this->Style.Speed.Floor,
                   this->Speed))
        {
          break;
        }
        try
        {
          last = this->Trace(monitor);
        }
        catch (const Error&) // no path, or nothing around it
        {
          break;
        }
        if (last.Branches.empty())
        {
          return last;
        }
        if (last.Support > least)
        {
          best = last;
          least = last.Support;
          if (!this->IsDoubtful(best))
          {
            return best;
          }
        }
      }
    }
    return best;
  }

  bool IsDoubtful(const VesselTree& tree) const
  {
    return FlipFree::IsDoubtful(tree, this->Style.Sections.SectionStep);
  }

private:
  // From points that are snapped so far: where a vessel through them may run.
  void Begin(double snapDistance)
  {
    constexpr double ballScale = 0.7; // of the vessel's radius
    const FloatImage& cubes = this->Image.Cubes;
    this->Points = Snap(cubes.View(), this->Clicked, snapDistance);
    const VesselIntensities intensities =
      IntensitiesAtPoints(cubes.View(), this->Points, ballScale * this->Radius, this->Style.Speed);
    this->Depth.Geometry = cubes.Geometry;
    this->Depth.Voxels = DepthOf(cubes.View(), intensities, this->Parallel);
    this->Speed = MakeVesselSpeed(cubes, intensities, this->Depth.Voxels, this->Radius,
      this->Style.Speed, this->Parallel);
    SlowDown(this->Outside, this->Style.Speed.Floor, this->Speed);
  }

  // The paths that join the points, and the outline around them.
  VesselTree Trace(const Monitor& monitor) const
  {
    const ImageView<float> own = this->Image.Own.View();
    VesselTree tree;
    for (const MinimalPath& path :
      JoinPoints(this->Speed.View(), this->Points, ProlongDistance, monitor))
    {
      RequirePath(this->Speed, path.Line);
      PointList line = path.Line;
      for (int round = 0; round < 2; ++round)
      {
        line = ResampleLine(SmoothLine(line, LineDeviation), this->Style.Sections.SectionStep);
      }
      EndAtPoints(this->Points, this->Clicked, path.Parent >= 0, line);
      if (!monitor(0.8))
      {
        return {};
      }
      CrossSectionSettings sections = this->Style.Sections;
      sections.LentRadius = SupportedRadius(tree);
      VesselBranch branch{ FitSections(own, line, FirstRadii(this->Depth, line), sections,
                             this->Parallel),
        path.Parent, {} };
      branch.Support = SectionSupport(own, branch.Sections, this->Parallel);
      tree.Branches.push_back(std::move(branch));
    }
    tree.Radius = MeanRadius(tree);
    tree.Support = MeanSupport(tree);
    if (tree.Radius > LargestRadius || (!tree.Branches.empty() && tree.Support < LeastSupport))
    {
      throw Error(ErrorCode::NoContrast,
        "no boundary of a vessel is found around the path from " + TextOf(this->Points.row(0)) +
          " mm; put all points into the vessel, or set Radius");
    }
    return tree;
  }

  const VesselStyle& Style;
  const PointList& Clicked;
  const PointList& Outside;
  double Radius;
  VesselImage Image;
  const ParallelFor& Parallel;
  PointList Points;
  FloatImage Depth;
  FloatImage Speed;
};

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
  catch (const std::invalid_argument&) // no path, or voxels far away that are not finite
  {
  }
  return std::nullopt;
}

} // namespace

VesselStyle ThinVessel()
{
  VesselStyle style;
  style.SnapDistance = 5;
  style.Margin = 38;
  style.Speed.Bright = true;
  style.Speed.HighAllowance = 40;
  style.Speed.MaximumCap = 3;
  style.Speed.TopHat = 7.5;
  style.Speed.Tube = 10;
  style.Sections.EdgeWeight = 15;
  style.Sections.PriorWeight = 0.1;
  style.Sections.PriorFollow = 0.5;
  style.Sections.AlongWeight = 0.08;
  style.Sections.AroundWeight = 0.15;
  style.Sections.IntensityWindow = 8;
  return style;
}

VesselStyle WideVessel()
{
  VesselStyle style;
  style.Speed.BodyScale = 1.5;
  style.Sections.DarkLimit = 60;
  style.Sections.BrightLimit = 22;
  style.Sections.EdgeWeight = 12;
  style.Sections.PriorWeight = 0.03;
  style.Sections.PriorFollow = 0.25;
  style.Sections.AlongWeight = 0.08;
  style.Sections.AroundWeight = 0.15;
  return style;
}

VesselStyle FarVessel()
{
  VesselStyle style = WideVessel();
  style.Margin = 120;
  style.GridSpacing = 2.5;
  return style;
}

namespace
{

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
