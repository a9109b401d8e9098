#include "Vessel/VesselSearch.h"

#include "Error.h"
#include "Image/ImageInterpolation.h"
#include "MessageText.h"
#include "Quantile.h"
#include "Vessel/MinimalPaths.h"
#include "Vessel/PointLikeness.h"
#include "Vessel/Polyline.h"
#include "Vessel/SectionSupport.h"
#include "Vessel/VesselPoints.h"

#include <algorithm>
#include <string>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double ProlongDistance = 15; // of a point from a path's end that prolongs it, mm
constexpr double LineDeviation = 2;    // smoothing of paths before sections are fitted, in sections
// A path over a stretch of this length, in mm, without the vessel's gray values is not the
// vessel's.
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

// First guesses at the radii from the depth along the line.
Eigen::VectorXd FirstRadii(const FloatImage& depth, const PointList& line)
{
  Eigen::VectorXd along(line.rows());
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    along[place] =
      InterpolateClamped(depth.View(), depth.Geometry.ToIndex(line.row(place).transpose()));
  }
  std::vector<double> values(along.data(), along.data() + along.size());
  return (1.15 * MedianAlong(along, 4)).cwiseMin(1.5 * TakeMedian(values)).cwiseMax(1.0);
}

// At the centers of sections, which may lie where no path enters.
Eigen::VectorXd SpeedAt(const FloatImage& speed, const VesselSections& sections, double floor)
{
  Eigen::VectorXd along(static_cast<Eigen::Index>(sections.Frames.size()));
  for (Eigen::Index section = 0; section < along.size(); ++section)
  {
    along[section] = std::max(floor,
      InterpolateClamped(speed.View(), speed.Geometry.ToIndex(sections.Frames[section].Origin)));
  }
  return along;
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

// As the user gave it where a path ends at a point, if not at the voxel that took its place; a
// branch begins on another path.
std::string NameOfEnd(const Eigen::RowVector3d& end, const PointList& snapped,
  const PointList& points)
{
  constexpr double rounded = 3; // mm; from a point to the nearest place of the grid
  Eigen::Index nearest = 0;
  const double square = (snapped.rowwise() - end).rowwise().squaredNorm().minCoeff(&nearest);
  return TextOf(square < rounded * rounded ? points.row(nearest) : end);
}

// `points`: what users know the ends of the line by.
void RequirePath(const FloatImage& speed, const PointList& line, const PointList& snapped,
  const PointList& points)
{
  if (LongestGapOf(speed, line) > LongestGap)
  {
    throw Error(ErrorCode::NoContrast,
      "no path through gray values like those at the points joins " +
        NameOfEnd(line.row(0), snapped, points) + " and " +
        NameOfEnd(line.row(line.rows() - 1), snapped, points) +
        " mm; put all points into the same vessel, and more of them along it");
  }
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
    const Eigen::VectorXd along = MeanAlong(branch.Support, sectionStep, StrayLength);
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

// An outline goes no further than the image has data.
void EndAtNoData(const VesselImage& image, VesselSections& sections)
{
  constexpr double step = 0.25; // mm
  constexpr double least = 0.5; // mm; so that a tube is left
  const ImageGeometry& cubes = image.Cubes.Geometry;
  const Eigen::Index rays = sections.Radii.cols();
  for (Eigen::Index section = 0; section < sections.Radii.rows() && !image.WithoutData.empty();
       ++section)
  {
    for (Eigen::Index ray = 0; ray < rays; ++ray)
    {
      const SectionFrame& frame = sections.Frames[section];
      const Eigen::Vector3d along =
        frame.Ray(2 * EIGEN_PI * static_cast<double>(ray) / static_cast<double>(rays));
      double& radius = sections.Radii(section, ray);
      for (double length = least; length < radius; length += step)
      {
        const auto [i, j, k] = NearestVoxel(cubes, frame.Origin + length * along);
        if (std::binary_search(image.WithoutData.begin(), image.WithoutData.end(),
              cubes.Offset(i, j, k)))
        {
          radius = length;
        }
      }
    }
  }
}

// Whether the image hardly shows the outline, or does not over a long stretch.
bool IsDoubtful(const VesselTree& tree, double sectionStep)
{
  return tree.Support < DoubtfulSupport ||
    std::any_of(tree.Branches.begin(), tree.Branches.end(),
      [&](const VesselBranch& branch)
      { return MeanAlong(branch.Support, sectionStep, FaintLength).minCoeff() < FaintSupport; });
}

} // namespace

VesselSearch::VesselSearch(const VesselStyle& style, const PointList& clicked,
  const PointList& outside, double radius, VesselImage image, const ParallelFor& parallelFor)
  : Style(style)
  , Clicked(clicked)
  , Outside(outside)
  , Radius(radius)
  , Image(std::move(image))
  , Parallel(parallelFor)
  , Scales(MakeSpeedScales(this->Image.Cubes, style.Speed, parallelFor))
{
}

VesselTree VesselSearch::Seek(const Monitor& monitor)
{
  this->Begin(this->Style.SnapDistance);
  return this->Trace(monitor);
}

VesselTree VesselSearch::SeekBetter(const VesselTree& found, const Monitor& monitor)
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
      this->CloseNoData();
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

bool VesselSearch::IsDoubtful(const VesselTree& tree) const
{
  return FlipFree::IsDoubtful(tree, this->Style.Sections.SectionStep);
}

void VesselSearch::Begin(double snapDistance)
{
  constexpr double ballScale = 0.7; // of the vessel's radius
  const FloatImage& cubes = this->Image.Cubes;
  this->Points = Snap(this->Image, this->Clicked, snapDistance);
  const VesselIntensities intensities =
    IntensitiesAtPoints(cubes.View(), this->Points, ballScale * this->Radius, this->Style.Speed);
  this->Depth.Geometry = cubes.Geometry;
  this->Depth.Voxels = DepthOf(cubes.View(), intensities, this->Parallel);
  this->Speed = MakeVesselSpeed(cubes, this->Scales, intensities, this->Depth.Voxels, this->Radius,
    this->Style.Speed, this->Parallel);
  SlowDown(this->Outside, this->Style.Speed.Floor, this->Speed);
  this->CloseNoData();
}

// No path enters it.
void VesselSearch::CloseNoData()
{
  for (const std::size_t cube : this->Image.WithoutData)
  {
    this->Depth.Voxels[cube] = 0;
    this->Speed.Voxels[cube] = 0;
  }
}

VesselTree VesselSearch::Trace(const Monitor& monitor) const
{
  const ImageView<float> own = this->Image.Own.View();
  VesselTree tree;
  for (const MinimalPath& path :
    JoinPoints(this->Speed.View(), this->Points, this->Clicked, ProlongDistance, monitor))
  {
    RequirePath(this->Speed, path.Line, this->Points, this->Clicked);
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
      path.Parent, {}, {} };
    EndAtNoData(this->Image, branch.Sections);
    branch.Support = SectionSupport(own, branch.Sections, this->Parallel);
    branch.Speed = SpeedAt(this->Speed, branch.Sections, this->Style.Speed.Floor);
    tree.Branches.push_back(std::move(branch));
  }
  tree.Radius = MeanRadius(tree);
  tree.Support = MeanSupport(tree);
  if (tree.Radius > LargestRadius || (!tree.Branches.empty() && tree.Support < LeastSupport))
  {
    throw Error(ErrorCode::NoContrast,
      "no vessel boundary was found around the path from " + TextOf(this->Clicked.row(0)) +
        " mm; put all points into the vessel, or set {Radius}");
  }
  tree.Unlike = PointsUnlike(own, tree, this->Points);
  return tree;
}

} // namespace FlipFree
