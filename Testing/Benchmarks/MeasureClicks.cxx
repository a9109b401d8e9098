// Corrects every row of a list of cases by simulated clicks, as the field measures interactive
// methods: after each run the next click goes to the deepest voxel of the largest connected error,
// inside if it is missed, outside if it is too much, moved by up to two voxels at random.
//
//   MeasureClicks [--data DIR] [--cases FILE] [--only TEXT] [--clicks N] [--seed S]
//
// Prints a line of Dice scores per row, after 0, 1, 2, ... clicks, and the seconds per click; then
// per organ the median, the 10th percentile and the least by number of clicks, and the clicks that
// 0.90, 0.95 and 0.97 take.
#include "CaseList.h"
#include "Statistics.h"

#include "GrayImageAdapter.h"
#include "LabelAdapter.h"

#include "Deformation/VolumeSegmentation.h"
#include "Image/DistanceTransform.h"
#include "Stopwatch.h"

#include "vtkImageData.h"
#include "vtkSMPTools.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <vector>

using namespace FlipFree;
namespace FlipFree { extern BitMask LastForeground; extern bool MaskOnly;
extern double PeakRule, PeakPart, VGain, VDecay, VHalf, LikeSeed, Bridge, InLike, OutLike, InMax, DepthScale, Base, Gain, Decay, Area, HardPart, DomainScale, DomainLeast, MinBlock,
       SpreadFloor, ZCut, Links, OutBase, OutGain, OutDecay, CoreDepth, OutArea, DecayLength, NeckRatio, NeckBase, NeckGain, NeckArea, MaxReach, ShellPart, ShellZ, FirstBall; }
#include <fstream>
#include <sstream>
const std::map<std::string, double*> Tunables{{"Depth",&DepthScale},{"InLike",&InLike},{"VGain",&VGain},{"PeakRule",&PeakRule},{"PeakPart",&PeakPart},{"VDecay",&VDecay},{"VHalf",&VHalf},{"LikeSeed",&LikeSeed},{"Bridge",&Bridge},{"OutLike",&OutLike},{"InMax",&InMax},{"Base",&Base},{"Gain",&Gain},{"Decay",&Decay},{"Area",&Area},{"Hard",&HardPart},{"DomainScale",&DomainScale},{"DomainLeast",&DomainLeast},{"Block",&MinBlock},{"Floor",&SpreadFloor},{"Z",&ZCut},{"Links",&Links},{"OutBase",&OutBase},{"OutGain",&OutGain},{"OutDecay",&OutDecay},{"Core",&CoreDepth},{"OutArea",&OutArea},{"DecayLength",&DecayLength},{"NeckRatio",&NeckRatio},{"NeckBase",&NeckBase},{"NeckGain",&NeckGain},{"NeckArea",&NeckArea},{"MaxReach",&MaxReach},{"ShellPart",&ShellPart},{"ShellZ",&ShellZ},{"FirstBall",&FirstBall}};

namespace
{

struct Options
{
  std::string Data = "../shared/data";
  std::string Cases = "development.csv"; ///< in that folder
  std::string Only;
  std::string Half;
  int Clicks = 5;
  int Seed = 1;
  int Threads = 0;
};

double DiceOf(const BitMask& a, const BitMask& b)
{
  BitMask both = a;
  both.Intersect(b);
  return 2.0 * static_cast<double>(both.Count()) / static_cast<double>(a.Count() + b.Count());
}

// The largest part of a mask that hangs together by faces, and how many voxels it has.
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
  {
    const auto& size = bits.GetGeometry().Dimensions;
    std::size_t voxel = 0;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i, ++voxel)
          if (part[voxel]) bits.Insert(i, j, k);
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

BitMask MaskOfRuns(const std::vector<VoxelRun>& runs, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  for (const VoxelRun& run : runs)
  {
    mask.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  return mask;
}

std::vector<double> MeasureRow(const Case& row, const Options& options, std::vector<double>& seconds)
{
  const auto image = ReadVolume(options.Data + "/" + row.Image);
  const auto labels = ReadVolume(options.Data + "/" + row.Labels);
  const BitMask reference = MaskOf(labels, row.Label, row.Labels);
  const SeedSphere seed{ Eigen::Vector3d(row.Seed.data()), row.Radius };
  VolumeSegmenter segmenter(
    GrayVolumeOf(image, row.Image), row.Image, seed, nullptr, {}, SMPThreading());
  if (const char* file = std::getenv("TUNE"))
  {
    MaskOnly = true;
    std::ifstream in(file);
    std::string line;
    std::map<std::string,double> defaults;
    for (auto& t : Tunables) defaults[t.first] = *t.second;
    while (std::getline(in, line))
    {
      for (auto& t : Tunables) *t.second = defaults[t.first];
      std::istringstream words(line); std::string word;
      while (words >> word) { auto e = word.find('='); *Tunables.at(word.substr(0,e)) = std::stod(word.substr(e+1)); }
      std::mt19937 random(options.Seed);
      ConstraintList clicks;
      std::printf("T %s | %s |", row.Name.c_str(), line.c_str());
      for (int click = 0; click <= options.Clicks; ++click)
      {
        segmenter.Segment(clicks, NeverStop, [](const auto&, const auto&, const auto&, const auto&) {});
        BitMask whole(reference.GetGeometry());
        const Eigen::Vector3d f = reference.GetGeometry().ToIndex(LastForeground.GetGeometry().Origin);
        whole.Insert(LastForeground, {{(int)std::lround(f[0]),(int)std::lround(f[1]),(int)std::lround(f[2])}});
        std::printf(" %.4f", DiceOf(whole, reference));
        PointConstraint next;
        if (!NextClick(whole, reference, random, next)) break;
        clicks.push_back(next);
      }
      {
        BitMask found(reference.GetGeometry());
        const Eigen::Vector3d f = reference.GetGeometry().ToIndex(LastForeground.GetGeometry().Origin);
        found.Insert(LastForeground, {{(int)std::lround(f[0]),(int)std::lround(f[1]),(int)std::lround(f[2])}});
        BitMask u = reference; u.Unite(found);
        const VoxelBox box = u.Bounds().Widened({{2,2,2}}, WholeBox(u.GetGeometry()));
        BitMask r = reference.Cropped(box), m = found.Cropped(box);
        std::vector<unsigned char> bytes(r.GetGeometry().NumberOfVoxels(),0);
        r.ForEach([&](std::size_t v){bytes[v]=1;});
        auto in = SquaredDistance(bytes, r.GetGeometry(), 0, SMPFor, NeverStop);
        auto out = SquaredDistance(bytes, r.GetGeometry(), 1, SMPFor, NeverStop);
        double h[2][4]{}; double total = r.Count();
        std::vector<unsigned char> mb(bytes.size(),0); m.ForEach([&](std::size_t v){mb[v]=1;});
        for (std::size_t v=0;v<bytes.size();++v) if (bytes[v]!=mb[v]) { double d=std::sqrt(bytes[v]?in[v]:out[v]); h[bytes[v]][d<=1.6?0:d<=3?1:d<=6?2:3]+=1; }
        std::printf(" | missed %.1f %.1f %.1f %.1f much %.1f %.1f %.1f %.1f", 100*h[1][0]/total,100*h[1][1]/total,100*h[1][2]/total,100*h[1][3]/total,100*h[0][0]/total,100*h[0][1]/total,100*h[0][2]/total,100*h[0][3]/total);
      }
      std::printf("\n"); std::fflush(stdout);
    }
    for (auto& t : Tunables) *t.second = defaults[t.first];
    return std::vector<double>(options.Clicks + 1, 0);
  }
  std::mt19937 random(options.Seed);
  ConstraintList clicks;
  std::vector<double> scores;
  std::string text;
  std::vector<double> masks;
  for (int click = 0; click <= options.Clicks; ++click)
  {
    Stopwatch watch;
    VolumeSegmentation result;
    try
    {
      result = segmenter.Segment(
        clicks, NeverStop, [](const auto&, const auto&, const auto&, const auto&) {});
    }
    catch (const std::exception& error)
    {
      std::printf("%s, click %d: %s\n", row.Name.c_str(), click, error.what());
      scores.push_back(scores.empty() ? 0 : scores.back());
      continue;
    }
    if (click > 0)
    {
      seconds.push_back(watch.Lap());
    }
    const BitMask found = MaskOfRuns(result.Voxels, reference.GetGeometry());
    scores.push_back(DiceOf(found, reference));
    BitMask whole(reference.GetGeometry());
    {
      const Eigen::Vector3d f = reference.GetGeometry().ToIndex(LastForeground.GetGeometry().Origin);
      whole.Insert(LastForeground, {{(int)std::lround(f[0]),(int)std::lround(f[1]),(int)std::lround(f[2])}});
    }
    masks.push_back(DiceOf(whole, reference));
    PointConstraint next;
    if (!NextClick(found, reference, random, next))
    {
      break;
    }
    text += next.Kind == ConstraintKind::Inside ? '+' : '-';
    clicks.push_back(next);
  }
  scores.resize(options.Clicks + 1, scores.back());
  std::printf("| %-26s |", row.Name.c_str());
  for (double score : scores)
  {
    std::printf(" %.3f |", score);
  }
  std::printf(" %s |", text.c_str());
  for (double score : masks)
  {
    std::printf(" %.3f", score);
  }
  std::puts("");
  std::fflush(stdout);
  return scores;
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
  app.add_option("--threads", options.Threads, "number of threads");
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(options.Threads);

  std::map<std::string, std::vector<std::vector<double>>> scores;
  std::vector<double> seconds;
  for (const Case& row : ReadCases(options.Data + "/" + options.Cases))
  {
    if (row.Name.find(options.Only) != std::string::npos)
    {
      scores[row.Organ].push_back(MeasureRow(row, options, seconds));
    }
  }
  for (const auto& [organ, rows] : scores)
  {
    std::printf("| %s, %zu rows |", organ.c_str(), rows.size());
    for (int click = 0; click <= options.Clicks; ++click)
    {
      std::vector<double> at;
      for (const auto& row : rows)
      {
        at.push_back(row[click]);
      }
      std::sort(at.begin(), at.end());
      std::printf(" %.3f %.3f %.3f |", Median(at), at[at.size() / 10], at.front());
    }
    std::puts("");
  }
  std::printf("seconds per click: median %.2f\n", seconds.empty() ? 0 : Median(seconds));
  return 0;
}
