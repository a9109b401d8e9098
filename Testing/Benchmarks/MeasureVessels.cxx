// development version
#include "CaseList.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "Statistics.h"
#include "Vessel/TubeOccupancy.h"
#include "Vessel/VesselSegmentation.h"
#include "Image/ImageInterpolation.h"
#include "Stopwatch.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

using namespace FlipFree;

struct Row { std::string Name, Role, Image, Labels; int Label; PointList Points; std::vector<double> Radii; };

std::vector<Row> ReadTubes(const std::string& file)
{
  std::vector<Row> rows; std::ifstream stream(file); std::string line; std::getline(stream, line);
  while (std::getline(stream, line))
  {
    std::vector<std::string> f; std::istringstream parts(line);
    for (std::string x; std::getline(parts, x, ',');) f.push_back(x);
    Row row; row.Name = f[0]; row.Role = f[1]; row.Image = f[3]; row.Labels = f[4]; row.Label = std::stoi(f[5]);
    const int n = f[14].empty() ? 2 : 3; row.Points.resize(n, 3);
    for (int p = 0; p < n; ++p) { for (int a = 0; a < 3; ++a) row.Points(p, a) = std::stod(f[6 + 4 * p + a]); row.Radii.push_back(std::stod(f[9 + 4 * p])); }
    rows.push_back(row);
  }
  return rows;
}

std::map<std::string, std::function<void(VesselSegmentationSettings&, double)>> Setters = {
  {"wall", [](auto& s, double x) { s.Path.WallThickness = x; }},
  {"radius", [](auto& s, double x) { s.Path.Radius = x; }},
  {"wideradius", [](auto& s, double x) { s.Path.WideRadius = x; }},
  {"levels", [](auto& s, double x) { s.Levels = int(x); }},
  {"iterations", [](auto& s, double x) { s.MaximumIterations = int(x); }},
#define STYLE(W) \
  {#W ".body", [](auto& s, double x) { s.Path.W.Speed.BodyScale = x; }}, \
  {#W ".minbody", [](auto& s, double x) { s.Path.W.Speed.MinimumBody = x; }}, \
  {#W ".high", [](auto& s, double x) { s.Path.W.Speed.HighAllowance = x; }}, \
  {#W ".edge", [](auto& s, double x) { s.Path.W.Speed.EdgeStrength = x; }}, \
  {#W ".tophat", [](auto& s, double x) { s.Path.W.Speed.TopHat = x; }}, \
  {#W ".margin", [](auto& s, double x) { s.Path.W.Margin = x; }}, \
  {#W ".cap", [](auto& s, double x) { s.Path.W.Speed.MaximumCap = x; }}, \
  {#W ".snap", [](auto& s, double x) { s.Path.W.SnapDistance = x; }}, \
  {#W ".maxdev", [](auto& s, double x) { s.Path.W.Speed.MaximumDeviation = x; }}, \
  {#W ".dark", [](auto& s, double x) { s.Path.W.Sections.DarkLimit = x; }}, \
  {#W ".bright", [](auto& s, double x) { s.Path.W.Sections.BrightLimit = x; }}, \
  {#W ".beta", [](auto& s, double x) { s.Path.W.Sections.EdgeWeight = x; }}, \
  {#W ".gam", [](auto& s, double x) { s.Path.W.Sections.PriorWeight = x; }}, \
  {#W ".g", [](auto& s, double x) { s.Path.W.Sections.PriorFollow = x; }}, \
  {#W ".ls", [](auto& s, double x) { s.Path.W.Sections.AlongWeight = x; }}, \
  {#W ".lt", [](auto& s, double x) { s.Path.W.Sections.AroundWeight = x; }}, \
  {#W ".window", [](auto& s, double x) { s.Path.W.Sections.IntensityWindow = int(x); }}
  STYLE(Thin), STYLE(Wide)
};

int main(int argc, char** argv)
{
  std::string data = "/work/shared/data", only, preset, dump; std::vector<std::string> sets; bool given = false, mesh = false; double jitter = 0; int repeats = 1;
  CLI::App app; app.add_option("--data", data); app.add_option("--only", only); app.add_option("--preset", preset); app.add_option("--set", sets);
  app.add_flag("--given", given); app.add_flag("--mesh", mesh); app.add_option("--jitter", jitter); app.add_option("--repeats", repeats); app.add_option("--dump", dump);
  CLI11_PARSE(app, argc, argv);
  std::map<std::string, std::vector<double>> scores, whole;
  std::map<std::string, std::vector<double>> insides;
  vtkSmartPointer<vtkImageData> image, labels; std::string last;
  for (const Row& row : ReadTubes(data + "/tubes.csv"))
  {
    if (row.Name.find(only) == std::string::npos) continue;
    if (row.Image != last) { image = ReadVolume(data + "/" + row.Image); labels = ReadVolume(data + "/" + row.Labels); last = row.Image; }
    std::mt19937 random(7);
    for (int repeat = 0; repeat < repeats; ++repeat)
    {
    PointList points = row.Points;
    if (jitter > 0) { std::normal_distribution<double> n; for (int p = 0; p < points.rows(); ++p) { Eigen::RowVector3d d(n(random), n(random), n(random)); points.row(p) += jitter * d / d.norm(); } }
    VesselSegmentationSettings s; if (given) { std::vector<double> r = row.Radii; s.Path.Radius = Median(r); }
    for (const std::string& a : sets) { const auto e = a.find('='); Setters.at(a.substr(0, e))(s, std::stod(a.substr(e + 1))); }
    Stopwatch watch;
    const GrayVolume volume = GrayVolumeOf(image, "image");
    VesselTree tree; VesselSegmentation result;
    try { if (mesh) { result = SegmentVessel(volume, "the image", points, s, SMPThreading(), NeverStop); tree = result.Tree; }
      else tree = TraceVessel(volume, "the image", points, s.Path, SMPThreading(), NeverStop); }
    catch (const std::exception& e) { std::printf("%s: %s\n", row.Name.c_str(), e.what()); scores[row.Role].push_back(0); continue; }
    const double seconds = watch.Lap();
    FloatImage depth; depth.Geometry = volume.Geometry; depth.Voxels.assign(depth.Geometry.NumberOfVoxels(), -2.f);
    if (mesh) { FillRuns(result.Voxels, 2.f, volume.Geometry, depth.Voxels.data()); std::printf("[%d vertices, %zu iterations, %.2f %.2f %.2f %.2f s, reason %d, si %td] ", result.Surface.Mesh.NumberOfPoints(), result.Surface.Iterations.size(), result.StageSeconds[0], result.StageSeconds[1], result.StageSeconds[2], result.StageSeconds[3], int(result.Surface.Reason), result.Surface.SelfIntersections); }
    else for (const VesselBranch& b : tree.Branches) MergeTubeDepth(b.Sections, 2, b.Parent >= 0, false, depth);
    const BitMask reference = MaskOf(labels, row.Label, "reference");
    const auto& m = tree.Branches[0].Sections;
    const auto beyond = [&](const Eigen::Vector3d& x) {
      double best = 1e30; bool result = false;
      for (const VesselBranch& b : tree.Branches) { const auto& f = b.Sections.Frames; const std::size_t n = f.size();
        for (std::size_t k = 0; k < n; k += 1) { const double d = (x - f[k].Origin).squaredNorm(); if (d < best) { best = d;
          result = (k == 0 && b.Parent < 0 && (x - f[0].Origin).dot(f[0].Tangent) < 0) || (k + 1 == n && (x - f[k].Origin).dot(f[k].Tangent) > 0); } } }
      return result; };
    std::size_t both = 0, a = 0, b = 0, wb = 0;
    const auto& g = volume.Geometry;
    for (int k = 0; k < g.Dimensions[2]; ++k) for (int j = 0; j < g.Dimensions[1]; ++j) for (int i = 0; i < g.Dimensions[0]; ++i)
    {
      const bool in = depth.Voxels[g.Offset(i, j, k)] > 0; const bool ref = reference(i, j, k);
      if (!in && !ref) continue;
      wb += ref;
      const bool out = beyond(g.ToPhysical(Eigen::Vector3d(i, j, k)));
      if (out) continue;
      both += in && ref; a += in; b += ref;
    }
    double inside = 0, count = 0, sumR = 0;
    for (const VesselBranch& br : tree.Branches) for (std::size_t f = 0; f < br.Sections.Frames.size(); ++f)
    { const Eigen::Vector3d i = g.ToIndex(br.Sections.Frames[f].Origin); const int x = std::lround(i[0]), y = std::lround(i[1]), z = std::lround(i[2]);
      inside += g.Contains(x, y, z) && reference(x, y, z); ++count; sumR += br.Sections.Radii.row(f).mean(); }
    const double dice = 2. * both / (a + b);
    scores[row.Role].push_back(dice); whole[row.Role].push_back(2. * both / (a + wb)); insides[row.Role].push_back(inside / count);
    std::printf("%-14s dice %.3f whole %.3f inside %.3f  vol %+.2f len %.0f R %.1f (model %.1f) branches %zu  %.2f s\n", row.Name.c_str(), dice, 2. * both / (a + wb), inside / count, double(a) / b - 1,
      1.5 * m.Frames.size(), sumR / count, tree.Radius, tree.Branches.size(), seconds);
    std::fflush(stdout);
    if (!dump.empty()) { std::ofstream o(dump + "/" + row.Name + ".txt"); for (const auto& br : tree.Branches) for (std::size_t f = 0; f < br.Sections.Frames.size(); ++f) o << br.Sections.Frames[f].Origin.transpose() << " " << br.Sections.Radii.row(f).mean() << "\n"; }
    }
  }
  for (auto& s : scores) { std::sort(s.second.begin(), s.second.end()); auto& w = whole[s.first]; std::sort(w.begin(), w.end()); std::printf("== %-8s median %.3f least %.3f mean %.3f | whole median %.3f | inside median %.3f\n", s.first.c_str(), Median(s.second), s.second.front(), std::accumulate(s.second.begin(), s.second.end(), 0.) / s.second.size(), Median(w), Median(insides[s.first])); }
}
