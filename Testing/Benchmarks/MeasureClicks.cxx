// Corrects every row of a list of cases by simulated clicks, as the field measures interactive
// methods: after each run the next click goes to the deepest voxel of the largest connected error,
// inside if it is missed, outside if it is too much, moved by up to two voxels at random.
//
//   MeasureClicks [--data DIR] [--cases FILE] [--only TEXT] [--clicks N] [--seed S] [--details]
//                 [--questions] [--locality] [--surface-dice] [--preview]
//                 [--bad-starts N]
//
// Prints a line of Dice scores per row, after 0, 1, 2, ... clicks, and the seconds per click; then
// per organ the median, the 10th percentile and the least by number of clicks, and the clicks that
// 0.90, 0.95 and 0.97 take. With --locality, also how far each click moves the surface beyond 30
// mm, or twice its distance from the surface, of the click and of what is connected to the
// mended place. A click that no surface of one piece can obey is refused with an error, which is
// printed; the row keeps the scores that it had. An inside point must not remove voxels, nor an
// outside point add any, but for those along the boundary; clicks that do are printed, too. With
// --questions, the truthful answers to the first question of each result take the place of clicks.
// How often results were wrong about what they ask is printed in any case. With --preview, each
// click is previewed first: how long that takes, and the Dice score of the voxels that it names
// with those that change.
//
// With --bad-starts, each row is started from N random seeds, and only those whose result is below
// 0.8 are corrected.
//
// The areas under the curves of Dice, and with --surface-dice of the surface Dice at 2 mm, over the
// clicks without the start are those of the challenge Foundation Models for Interactive 3D
// Biomedical Image Segmentation (CVPR 2025): by trapezoids, so of five clicks 4 at most.
#include "CaseList.h"
#include "OrganMasks.h"
#include "Statistics.h"
#include "SurfaceDice.h"

#include "GrayImageAdapter.h"
#include "LabelAdapter.h"

#include "Deformation/DeformingOrgan.h"
#include "Deformation/VolumeSegmentation.h"
#include "Geometry/DistanceQuery.h"
#include "Geometry/WindingNumber.h"
#include "Image/DistanceTransform.h"
#include "Intensity/LeakControl.h"
#include "Stopwatch.h"

#include "vtkImageData.h"
#include "vtkSMPTools.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

using namespace FlipFree;

namespace
{

struct Options
{
  std::string Data = DefaultDataFolder();
  std::string Cases = "development.csv"; ///< in that folder
  std::string Only;
  int Clicks = 5;
  int Seed = 1;
  int Threads = 0;
  bool Details = false;   ///< a line per click: the surface, the foreground, what is wrong
  bool Questions = false; ///< answered in place of clicks
  bool SurfaceDice = false;
  bool Preview = false;  ///< before each click
  int BadStarts = 0;     ///< random seeds per row, of which bad ones are corrected
  bool Locality = false; ///< a line per click: what it moves where it should not
};

// The largest part of a mask that is connected by faces, and how many voxels it has.
std::size_t LargestPart(const BitMask& mask, std::vector<unsigned char>& part)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  std::vector<int> number(geometry.NumberOfVoxels(), 0);
  mask.ForEach([&](std::size_t voxel) { number[voxel] = -1; });
  const std::array<std::ptrdiff_t, 3> step{ { 1, geometry.Dimensions[0],
    static_cast<std::ptrdiff_t>(geometry.Dimensions[0]) * geometry.Dimensions[1] } };
  int parts = 0;
  int largest = 0;
  std::size_t most = 0;
  std::vector<std::size_t> front;
  for (std::size_t first = 0; first < number.size(); ++first)
  {
    if (number[first] >= 0)
    {
      continue;
    }
    number[first] = ++parts;
    front.assign(1, first);
    for (std::size_t next = 0; next < front.size(); ++next)
    {
      std::size_t rest = front[next];
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto index = static_cast<int>(rest % geometry.Dimensions[axis]);
        rest /= geometry.Dimensions[axis];
        const auto visit = [&](std::size_t voxel)
        {
          if (number[voxel] < 0)
          {
            number[voxel] = parts;
            front.push_back(voxel);
          }
        };
        if (index > 0)
        {
          visit(front[next] - step[axis]);
        }
        if (index + 1 < geometry.Dimensions[axis])
        {
          visit(front[next] + step[axis]);
        }
      }
    }
    if (front.size() > most)
    {
      most = front.size();
      largest = parts;
    }
  }
  part.assign(number.size(), 0);
  std::transform(number.begin(), number.end(), part.begin(),
    [=](int of) { return static_cast<unsigned char>(of == largest && largest > 0); });
  return most;
}

// The next click; false if there is no error to click at.
bool NextClick(const BitMask& found, const BitMask& reference, std::mt19937& random,
  PointConstraint& click)
{
  BitMask missed = reference;
  missed.Remove(found);
  BitMask much = found;
  much.Remove(reference);
  BitMask error = missed;
  error.Unite(much);
  const VoxelBox box = error.Bounds().Widened({ { 1, 1, 1 } }, WholeBox(error.GetGeometry()));
  std::vector<unsigned char> part;
  std::vector<unsigned char> other;
  const BitMask missedPart = missed.Cropped(box);
  const BitMask muchPart = much.Cropped(box);
  const std::size_t ofMissed = LargestPart(missedPart, part);
  const std::size_t ofMuch = LargestPart(muchPart, other);
  if (ofMissed + ofMuch == 0)
  {
    return false;
  }
  click.Kind = ofMissed >= ofMuch ? ConstraintKind::Inside : ConstraintKind::Outside;
  if (ofMuch > ofMissed)
  {
    part.swap(other);
  }
  BitMask bits(missedPart.GetGeometry());
  const auto& size = bits.GetGeometry().Dimensions;
  for (std::size_t voxel = 0; voxel < part.size(); ++voxel)
  {
    if (part[voxel])
    {
      const std::size_t row = voxel / size[0];
      bits.Insert(static_cast<int>(voxel % size[0]), static_cast<int>(row % size[1]),
        static_cast<int>(row / size[1]));
    }
  }
  bits = bits.Cropped(bits.Bounds().Widened({ { 1, 1, 1 } }, WholeBox(bits.GetGeometry())));
  part.assign(bits.GetGeometry().NumberOfVoxels(), 0);
  bits.ForEach([&](std::size_t voxel) { part[voxel] = 1; });
  const ImageGeometry& geometry = bits.GetGeometry();
  const std::vector<float> depth = SquaredDistance(part, geometry, 0, SMPFor, NeverStop);
  const std::size_t deepest = std::max_element(depth.begin(), depth.end()) - depth.begin();
  const std::array<int, 3> index{ { static_cast<int>(deepest % geometry.Dimensions[0]),
    static_cast<int>(deepest / geometry.Dimensions[0] % geometry.Dimensions[1]),
    static_cast<int>(deepest / geometry.Dimensions[0] / geometry.Dimensions[1]) } };
  // A hand is not exact, but stays in the error that it sees.
  for (int attempt = 0; attempt < 20; ++attempt)
  {
    std::array<int, 3> moved = index;
    for (int& place : moved)
    {
      place += static_cast<int>(random() % 5) - 2;
    }
    if (geometry.Contains(moved[0], moved[1], moved[2]) &&
      part[geometry.Offset(moved[0], moved[1], moved[2])])
    {
      click.Point = geometry.ToPhysical(Eigen::Vector3d(moved[0], moved[1], moved[2]));
      return true;
    }
  }
  click.Point = geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
  return true;
}

bool IsOrgan(const DoubtfulPart& part, const BitMask& reference)
{
  const std::array<int, 3> voxel = NearestVoxel(reference.GetGeometry(), part.Place);
  return reference(voxel[0], voxel[1], voxel[2]);
}

// The truthful answer to the first question; false if there is none.
bool NextAnswer(const std::vector<DoubtfulPart>& questions, const BitMask& reference,
  PointConstraint& click)
{
  if (questions.empty())
  {
    return false;
  }
  click.Point = questions.front().Place;
  click.Kind =
    IsOrgan(questions.front(), reference) ? ConstraintKind::Inside : ConstraintKind::Outside;
  return true;
}

// Millimeters; an error no deeper than this is one of the rim.
constexpr double Rim = 2.5;

// What is wrong: missed and too much, at the reference's rim and beyond, in percent of it.
std::string ErrorsOf(const BitMask& found, const BitMask& reference)
{
  BitMask both = found;
  both.Unite(reference);
  const VoxelBox box = both.Bounds().Widened({ { 9, 9, 9 } }, WholeBox(found.GetGeometry()));
  const BitMask is = found.Cropped(box);
  const BitMask wanted = reference.Cropped(box);
  const ImageGeometry& geometry = wanted.GetGeometry();
  std::vector<unsigned char> inside(geometry.NumberOfVoxels(), 0);
  wanted.ForEach([&](std::size_t voxel) { inside[voxel] = 1; });
  const std::vector<float> in = SquaredDistance(inside, geometry, 0, SMPFor, NeverStop);
  const std::vector<float> out = SquaredDistance(inside, geometry, 1, SMPFor, NeverStop);
  const auto partOf =
    [&](const BitMask& from, const BitMask& less, const std::vector<float>& away, bool rim)
  {
    BitMask error = from;
    error.Remove(less);
    std::size_t count = 0;
    error.ForEach([&](std::size_t voxel) { count += (away[voxel] <= Rim * Rim) == rim ? 1 : 0; });
    return 100.0 * static_cast<double>(count) / static_cast<double>(wanted.Count());
  };
  char text[200];
  std::snprintf(text, sizeof text, "missed %.1f %% at the rim, %.1f %% beyond; too much %.1f, %.1f",
    partOf(wanted, is, in, true), partOf(wanted, is, in, false), partOf(is, wanted, out, true),
    partOf(is, wanted, out, false));
  return text;
}

// Of what has changed, what is connected to a place.
BitMask MendedPlace(const BitMask& changed, const Eigen::Vector3d& point)
{
  BitMask mended = changed;
  const std::array<int, 3> own = NearestVoxel(mended.GetGeometry(), point);
  mended.Insert(own[0], own[1], own[2]);
  KeepConnected(mended, { mended.GetGeometry().Offset(own[0], own[1], own[2]) }, NeverStop);
  return mended;
}

// A vertex that is no farther from the mended place than this, in millimeters, belongs to it.
constexpr double OfMended = 5;

struct Motion
{
  double Mean = 0; ///< of the vertices beyond, in millimeters
  double Most = 0;
  int Vertices = 0;
  std::size_t Voxels = 0; ///< that change beyond
};

// How far a click has moved the surface where the promise of locality says that it stays.
Motion MotionBeyond(const OrganSurface& before, const OrganSurface& after, const BitMask& changed,
  const BitMask& mended, const Eigen::Vector3d& point)
{
  const double away =
    DistanceQuery(before.Points, before.Mesh.Triangles).DistancesOf(point.transpose())[0];
  const double domain = std::max(30.0, 2 * away);
  const Eigen::VectorXd moved =
    DistanceQuery(before.Points, before.Mesh.Triangles).DistancesOf(after.Points);
  const ImageGeometry& geometry = mended.GetGeometry();
  std::vector<unsigned char> inside(geometry.NumberOfVoxels(), 0);
  mended.ForEach([&](std::size_t voxel) { inside[voxel] = 1; });
  const std::vector<float> squared = SquaredDistance(inside, geometry, 1, SMPFor, NeverStop);
  Motion motion;
  BitMask elsewhere = changed;
  elsewhere.Remove(mended);
  elsewhere.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      for (int i = begin; i < end; ++i)
      {
        const bool isFar = (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm() > domain;
        motion.Voxels += isFar ? 1 : 0;
      }
    });
  for (Eigen::Index vertex = 0; vertex < after.Points.rows(); ++vertex)
  {
    const Eigen::Vector3d at = after.Points.row(vertex).transpose();
    const std::array<int, 3> voxel = NearestVoxel(geometry, at);
    if ((at - point).norm() > domain &&
      squared[geometry.Offset(voxel[0], voxel[1], voxel[2])] > OfMended * OfMended)
    {
      ++motion.Vertices;
      motion.Mean += moved[vertex];
      motion.Most = std::max(motion.Most, moved[vertex]);
    }
  }
  motion.Mean /= std::max(1, motion.Vertices);
  return motion;
}

void PrintMotion(const std::string& row, const PointConstraint& click, const Motion& motion)
{
  std::printf("  %s moves %s by %.3f mm in the mean, at most %.2f mm, at %d vertices; "
              "%zu voxels change there\n",
    NameOf(click).c_str(), row.c_str(), motion.Mean, motion.Most, motion.Vertices, motion.Voxels);
}

// How many voxels a click has moved to the other side than its own, deeper than the voxels along
// the boundary.
std::size_t CountAgainst(bool inside, const BitMask& before, const BitMask& after)
{
  const BitMask& from = inside ? before : after;
  BitMask against = from;
  against.Remove(inside ? after : before);
  if (against.Count() == 0)
  {
    return 0;
  }
  const VoxelBox box = against.Bounds().Widened({ { 2, 2, 2 } }, WholeBox(from.GetGeometry()));
  const BitMask part = from.Cropped(box);
  const std::vector<float> depth = SquaredDistance(part, false, SMPFor, NeverStop);
  const double voxel = from.GetGeometry().Spacing.maxCoeff();
  std::size_t count = 0;
  against.Cropped(box).ForEach(
    [&](std::size_t offset) { count += depth[offset] > 1.01 * voxel * voxel ? 1 : 0; });
  return count;
}

// Millimeters.
constexpr double SurfaceTolerance = 2;

struct Row
{
  std::vector<double> Scores;        ///< after 0, 1, 2, ... clicks
  std::vector<double> SurfaceScores; ///< surface Dice, if asked for
  std::vector<double> Seconds;       ///< of each run after a click
  std::vector<double> PreviewSeconds;
  std::vector<double> PreviewDice; ///< of what changes, by the preview and by the run
  int Disobeyed = 0;
  int Refused = 0;                            ///< with an error
  std::vector<std::pair<double, bool>> Asked; ///< at first: the margin, and whether it was wrong
  int NotMonotone = 0; ///< clicks that moved voxels to the other side, off the boundary
};

// Counts what the surface does not obey, looked at from scratch.
int CountDisobeyed(const ConstraintList& clicks, const OrganSurface& organ)
{
  return static_cast<int>(std::count_if(clicks.begin(), clicks.end(),
    [&](const PointConstraint& click)
    {
      return WindingNumber(organ.Points, organ.Mesh.Triangles, click.Point) !=
        (click.Kind == ConstraintKind::Inside ? 1 : 0);
    }));
}

// The second call is timed: of the first, the next points along the mouse's way have something.
std::optional<BitMask> PreviewOf(VolumeSegmenter& segmenter, const ConstraintList& clicks,
  const PointConstraint& next, std::vector<double>& seconds)
{
  segmenter.Preview(clicks, next, NeverStop);
  Stopwatch watch;
  const std::optional<std::vector<VoxelRun>> changed = segmenter.Preview(clicks, next, NeverStop);
  if (!changed)
  {
    return std::nullopt;
  }
  seconds.push_back(watch.Lap());
  return MaskOfRuns(*changed, segmenter.GetGeometry());
}

constexpr double BadStart = 0.8; // Dice

// From one seed; nothing for a start that is not bad, where only these are wanted.
std::optional<Row> MeasureRow(const Case& row, vtkImageData* image, const BitMask& reference,
  const SeedSphere& seed, const Options& options)
{
  VolumeSegmenter segmenter(GrayVolumeOf(image, row.Image), row.Image, seed, nullptr, {},
    SMPThreading());
  std::mt19937 random(options.Seed);
  ConstraintList clicks;
  Row result;
  std::string kinds;
  VolumeSegmentation former;
  BitMask formerFound;
  std::optional<BitMask> previewed;
  for (int click = 0; click <= options.Clicks; ++click)
  {
    Stopwatch watch;
    VolumeSegmentation run;
    try
    {
      run = segmenter.Segment(clicks, NeverStop,
        [](const auto&, const auto&, const auto&, const auto&) {});
    }
    catch (const Error& refusal)
    {
      if (clicks.empty())
      {
        throw;
      }
      std::printf("  %s: %s\n", row.Name.c_str(), refusal.what());
      ++result.Refused;
      break;
    }
    if (click > 0)
    {
      result.Seconds.push_back(watch.Lap());
    }
    result.Disobeyed += CountDisobeyed(clicks, run.Organ);
    const BitMask found = MaskOfRuns(run.Voxels, reference.GetGeometry());
    result.Scores.push_back(DiceOf(found, reference));
    if (options.BadStarts > 0 && result.Scores.front() >= BadStart)
    {
      return std::nullopt;
    }
    if (options.SurfaceDice)
    {
      result.SurfaceScores.push_back(SurfaceDiceOf(found, reference, SurfaceTolerance));
    }
    if (click == 0)
    {
      for (const DoubtfulPart& part : run.Questions)
      {
        result.Asked.emplace_back(part.Margin, part.IsIncluded != IsOrgan(part, reference));
      }
    }
    PointConstraint next;
    if (click > 0)
    {
      const std::size_t against =
        CountAgainst(clicks.back().Kind == ConstraintKind::Inside, formerFound, found);
      result.NotMonotone += against > 0 ? 1 : 0;
      if (against > 0)
      {
        std::printf("  %s: %s moves %zu voxels the other way\n", row.Name.c_str(),
          NameOf(clicks.back()).c_str(), against);
      }
    }
    if (previewed)
    {
      result.PreviewDice.push_back(DiceOf(*previewed, DifferenceOf(formerFound, found)));
    }
    if (options.Locality)
    {
      if (click > 0)
      {
        const PointConstraint& last = clicks.back();
        const BitMask changed = DifferenceOf(formerFound, found);
        PrintMotion(row.Name, last,
          MotionBeyond(former.Organ, run.Organ, changed, MendedPlace(changed, last.Point),
            last.Point));
      }
    }
    formerFound = found;
    if (options.Details)
    {
      BitMask foreground(reference.GetGeometry());
      foreground.Insert(segmenter.Prepare(clicks).GetOrgan().GetForeground().GetMask(),
        segmenter.GetBox().Begin);
      std::printf("  %d: %.3f, the foreground %.3f, %s\n", click, result.Scores.back(),
        DiceOf(foreground, reference), ErrorsOf(found, reference).c_str());
    }
    if (!(options.Questions ? NextAnswer(run.Questions, reference, next)
                            : NextClick(found, reference, random, next)))
    {
      break;
    }
    if (options.Details && click < options.Clicks)
    {
      std::printf("  %s\n", NameOf(next).c_str());
    }
    if (options.Preview && click < options.Clicks)
    {
      previewed = PreviewOf(segmenter, clicks, next, result.PreviewSeconds);
    }
    former = std::move(run);
    kinds += next.Kind == ConstraintKind::Inside ? '+' : '-';
    clicks.push_back(next);
  }
  result.Scores.resize(options.Clicks + 1, result.Scores.back());
  if (options.SurfaceDice)
  {
    result.SurfaceScores.resize(options.Clicks + 1, result.SurfaceScores.back());
  }
  std::printf("| %-26s |", row.Name.c_str());
  for (const double score : result.Scores)
  {
    std::printf(" %.3f |", score);
  }
  std::printf(" %s | %d |\n", kinds.substr(0, options.Clicks).c_str(), result.Disobeyed);
  std::fflush(stdout);
  return result;
}

// From the row's own seed, or from random ones.
std::vector<Row> MeasureStarts(const Case& row, const Options& options)
{
  const auto image = ReadVolume(options.Data + "/" + row.Image);
  const auto labels = ReadVolume(options.Data + "/" + row.Labels);
  const BitMask reference = LabelVolumeOf(labels, row.Labels).MaskOf(row.Label);
  std::vector<RandomSeed> seeds{ { row.Seed, row.Radius } };
  if (options.BadStarts > 0)
  {
    seeds = RandomSeeds(labels, row.Label, row.Radius, options.BadStarts);
  }
  std::vector<Row> rows;
  for (const RandomSeed& seed : seeds)
  {
    const std::optional<Row> measured = MeasureRow(row, image, reference,
      { Eigen::Vector3d(seed.Center.data()), seed.Radius }, options);
    if (measured)
    {
      rows.push_back(*measured);
    }
  }
  return rows;
}

// The clicks that half of the rows need; "more" than were made.
std::string ClicksTo(double score, const std::vector<Row>& rows)
{
  std::vector<double> needed;
  for (const Row& row : rows)
  {
    const auto first = std::find_if(row.Scores.begin(), row.Scores.end(),
      [=](double reached) { return reached >= score; });
    needed.push_back(static_cast<double>(first - row.Scores.begin()));
  }
  const double median = Median(needed);
  return median < static_cast<double>(rows.front().Scores.size())
    ? std::to_string(static_cast<int>(median))
    : "more";
}

void PrintGroup(const std::string& name, const std::vector<Row>& rows)
{
  std::printf("| %s, %zu rows |", name.c_str(), rows.size());
  for (std::size_t click = 0; click < rows.front().Scores.size(); ++click)
  {
    std::vector<double> scores;
    for (const Row& row : rows)
    {
      scores.push_back(row.Scores[click]);
    }
    std::sort(scores.begin(), scores.end());
    std::printf(" %.3f %.3f %.3f |", Median(scores), scores[scores.size() / 10], scores.front());
  }
  std::printf(" %s, %s, %s |\n", ClicksTo(0.9, rows).c_str(), ClicksTo(0.95, rows).c_str(),
    ClicksTo(0.97, rows).c_str());
}

// Of the scores after the clicks, without the start; the mean of the rows.
void PrintCurve(const char* name, const std::map<std::string, std::vector<Row>>& groups,
  std::vector<double> Row::*scoresOf)
{
  double area = 0;
  double last = 0;
  int count = 0;
  for (const auto& [organ, rows] : groups)
  {
    for (const Row& row : rows)
    {
      const std::vector<double>& scores = row.*scoresOf;
      for (std::size_t click = 2; click < scores.size(); ++click)
      {
        area += 0.5 * (scores[click - 1] + scores[click]);
      }
      last += scores.back();
      ++count;
    }
  }
  std::printf("%s: area under the curve %.3f, at last %.3f, in the mean of %d rows\n", name,
    area / std::max(1, count), last / std::max(1, count), count);
}

// How often the result was wrong about what it asks, by the margin.
void PrintQuestions(const std::vector<std::pair<double, bool>>& asked, int rowsWithout)
{
  std::printf("questions: %zu, none in %d rows; decided wrongly:", asked.size(), rowsWithout);
  const double bounds[] = { -1e9, 0, 2.1, 6, 1e9 };
  for (int bin = 0; bin < 4; ++bin)
  {
    int count = 0;
    int wrong = 0;
    for (const auto& [margin, isWrong] : asked)
    {
      const bool isIn = bounds[bin] <= margin && margin < bounds[bin + 1];
      count += isIn ? 1 : 0;
      wrong += isIn && isWrong ? 1 : 0;
    }
    std::printf(bin < 3 ? " %d of %d below %g," : " %d of %d above\n", wrong, count,
      bounds[bin + 1]);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  CLI::App app("Measures corrections by simulated clicks over the rows of a list of cases.");
  app.add_option("--data", options.Data, "folder with volumes and lists")->capture_default_str();
  app.add_option("--cases", options.Cases, "list of cases in that folder")->capture_default_str();
  app.add_option("--only", options.Only, "rows whose name contains this text");
  app.add_option("--clicks", options.Clicks, "per row")->capture_default_str();
  app.add_option("--seed", options.Seed, "of the random numbers")->capture_default_str();
  app.add_flag("--details", options.Details, "what is wrong after each click");
  app.add_flag("--questions", options.Questions,
    "instead of clicks, truthful answers to the first question of each result");
  app.add_flag("--surface-dice", options.SurfaceDice, "also the surface Dice, at 2 mm");
  app.add_flag("--preview", options.Preview, "what each click is going to change");
  app.add_option("--bad-starts", options.BadStarts,
    "random seeds per row, of which those are corrected that start below 0.8");
  app.add_flag("--locality", options.Locality, "what a click moves beyond its domain");
  app.add_option("--threads", options.Threads, "number of threads");
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(options.Threads);

  std::map<std::string, std::vector<Row>> groups;
  std::vector<double> seconds;
  std::vector<double> previewSeconds;
  std::vector<double> previewDice;
  int disobeyed = 0;
  int refused = 0;
  int notMonotone = 0;
  std::vector<std::pair<double, bool>> asked;
  int rowsWithoutQuestions = 0;
  for (const Case& row : ReadCases(options.Data + "/" + options.Cases))
  {
    if (row.Name.find(options.Only) == std::string::npos)
    {
      continue;
    }
    for (const Row& result : MeasureStarts(row, options))
    {
      groups[row.Organ].push_back(result);
      seconds.insert(seconds.end(), result.Seconds.begin(), result.Seconds.end());
      previewSeconds.insert(previewSeconds.end(), result.PreviewSeconds.begin(),
        result.PreviewSeconds.end());
      previewDice.insert(previewDice.end(), result.PreviewDice.begin(), result.PreviewDice.end());
      disobeyed += result.Disobeyed;
      refused += result.Refused;
      notMonotone += result.NotMonotone;
      asked.insert(asked.end(), result.Asked.begin(), result.Asked.end());
      rowsWithoutQuestions += result.Asked.empty() ? 1 : 0;
    }
  }
  std::puts("Median, 10th percentile and least by number of clicks; clicks to 0.90, 0.95, 0.97");
  for (const auto& [name, rows] : groups)
  {
    PrintGroup(name, rows);
  }
  PrintCurve("Dice", groups, &Row::Scores);
  if (options.SurfaceDice)
  {
    PrintCurve("surface Dice at 2 mm", groups, &Row::SurfaceScores);
  }
  std::printf("seconds per click: median %.2f; clicks disobeyed: %d, refused: %d, moving "
              "voxels the other way: %d of %zu\n",
    seconds.empty() ? 0 : Median(seconds), disobeyed, refused, notMonotone, seconds.size());
  if (!previewDice.empty())
  {
    std::printf("previews: %zu, seconds: median %.3f, at most %.3f; Dice of what changes: median "
                "%.2f\n",
      previewSeconds.size(), Median(previewSeconds),
      *std::max_element(previewSeconds.begin(), previewSeconds.end()), Median(previewDice));
  }
  PrintQuestions(asked, rowsWithoutQuestions);
  return disobeyed == 0 ? 0 : 1;
}
