// Runs the segmentation of vessels over every row of DIR/tubes.csv, or of another such table, one
// setting for all, and prints a table: overlap with the reference label between the planes across
// the path at its ends (with those parts of the label alone that hold a point, by faces),
// confidence, volume, how much of the centerline lies within the reference, mean radius, vertices,
// seconds, self-intersections; and a line per kind of vessel and half of the volumes (halves.csv),
// with how well the confidence tells poor results.
//
//   MeasureVessels [--data DIR] [--cases FILE] [--only TEXT] [--radius R] [--wall-thickness T]
//                  [--jitter MM] [--repeats N] [--halves FILE] [--surfaces DIR]
//                  [--methods NAME ...] [--set NAME=VALUE ...]
//
// With --jitter, every point is moved by so much in a random direction, anew for each of the
// repeats. With --methods, other methods follow on each row, from the same points and between
// the same planes (VesselMethods.h), and a table compares them with FlipFree; --set varies their
// parameters.
#include "CaseList.h"
#include "Statistics.h"
#include "VesselMethods.h"

#include "vtkCellArray.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSegmentationMetrics.h"
#include "vtkTimerLog.h"
#include "vtkXMLPolyDataWriter.h"

#include <CLI/CLI.hpp>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

namespace
{

using Filter = vtkFlipFreeVesselSegmentation;

struct Options
{
  std::string Data = DefaultDataFolder();
  std::string Cases = "tubes.csv";
  std::string Only;
  std::string Surfaces;
  std::string Halves = "Testing/Benchmarks/halves.csv";
  double Radius = 0;
  double WallThickness = 0;
  double Jitter = 0;
  int Repeats = 1;
  std::vector<std::string> Methods; // beside FlipFree
  std::vector<std::string> Parameters;
};

struct Tube
{
  std::string Name;
  std::string Organ;
  std::string Image;
  std::string Labels;
  int Label = 0;
  std::vector<Eigen::Vector3d> Points;
};

std::vector<Tube> ReadTubes(const std::string& file)
{
  constexpr std::size_t firstPoint = 6; // each of x, y, z and a radius
  constexpr std::size_t mostPoints = 3;
  std::vector<Tube> tubes;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line))
  {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ',');)
    {
      fields.push_back(field);
    }
    Tube tube{ fields[0], fields[1], fields[3], fields[4], std::stoi(fields[5]), {} };
    for (std::size_t point = 0; point < mostPoints; ++point)
    {
      const std::size_t x = firstPoint + 4 * point;
      if (!fields[x].empty())
      {
        tube.Points.emplace_back(std::stod(fields[x]), std::stod(fields[x + 1]),
          std::stod(fields[x + 2]));
      }
    }
    tubes.push_back(tube);
  }
  return tubes;
}

// The points of the centerline, and the planes in which it ends.
class Course
{
public:
  explicit Course(vtkPolyData* lines)
  {
    for (vtkIdType line = 0; line < lines->GetNumberOfLines(); ++line)
    {
      vtkNew<vtkIdList> places;
      lines->GetLines()->GetCellAtId(line, places);
      const vtkIdType last = places->GetNumberOfIds() - 1;
      for (vtkIdType place = 0; place <= last; ++place)
      {
        const auto at = [&](vtkIdType other)
        { return Eigen::Vector3d(lines->GetPoint(places->GetId(other))); };
        this->Points.push_back(at(place));
        // Outward at an end. A branch begins within its parent, not at a plane.
        Eigen::Vector3d outward = Eigen::Vector3d::Zero();
        if (place == last)
        {
          outward = at(last) - at(last - 1);
        }
        else if (place == 0 && line == 0)
        {
          outward = at(0) - at(1);
        }
        this->Outward.push_back(outward);
      }
    }
  }

  bool IsBeyondEnds(const Eigen::Vector3d& point) const
  {
    std::size_t nearest = 0;
    for (std::size_t place = 1; place < this->Points.size(); ++place)
    {
      if ((this->Points[place] - point).squaredNorm() <
        (this->Points[nearest] - point).squaredNorm())
      {
        nearest = place;
      }
    }
    return (point - this->Points[nearest]).dot(this->Outward[nearest]) > 0;
  }

  std::vector<Eigen::Vector3d> Points;

private:
  std::vector<Eigen::Vector3d> Outward;
};

struct Overlap
{
  double Dice = 0;
  double VolumeDifference = 0;
  double Inside = 0; ///< part of the centerline
};

// What methods are compared by. What found nothing has no distance.
struct Score
{
  double Dice = 0;
  double Distance = std::nan(""); ///< average symmetric surface distance, mm
  double Seconds = std::nan("");
  double Confidence = 0;
  double TimesFlipFree = std::nan("");
};

// The parts of a label that hold one of the points, as 1. A part that is connected to them only
// beyond the image, as an ascending aorta below its arch may, is another vessel here.
vtkSmartPointer<vtkImageData> PartsWith(const std::vector<Eigen::Vector3d>& points,
  vtkImageData* labels, int label)
{
  auto parts = vtkSmartPointer<vtkImageData>::New();
  parts->CopyStructure(labels);
  parts->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* const to = static_cast<unsigned char*>(parts->GetScalarPointer());
  std::fill_n(to, parts->GetNumberOfPoints(), static_cast<unsigned char>(0));
  vtkDataArray* const from = labels->GetPointData()->GetScalars();
  int size[3];
  labels->GetDimensions(size);
  std::vector<vtkIdType> front;
  for (const Eigen::Vector3d& point : points)
  {
    front.push_back(labels->FindPoint(point.x(), point.y(), point.z()));
  }
  const vtkIdType steps[3] = { 1, size[0], static_cast<vtkIdType>(size[0]) * size[1] };
  while (!front.empty())
  {
    const vtkIdType voxel = front.back();
    front.pop_back();
    if (voxel < 0 || to[voxel] != 0 || from->GetTuple1(voxel) != label)
    {
      continue;
    }
    to[voxel] = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto place = static_cast<int>(voxel / steps[axis] % size[axis]);
      front.push_back(place > 0 ? voxel - steps[axis] : -1);
      front.push_back(place + 1 < size[axis] ? voxel + steps[axis] : -1);
    }
  }
  return parts;
}

Overlap MeasureOverlap(vtkImageData* found, vtkImageData* labels, int label, const Course& course)
{
  double both = 0;
  double segmentation = 0;
  double reference = 0;
  for (vtkIdType voxel = 0; voxel < labels->GetNumberOfPoints(); ++voxel)
  {
    const bool isFound = found->GetPointData()->GetScalars()->GetTuple1(voxel) != 0;
    const bool isReference = labels->GetPointData()->GetScalars()->GetTuple1(voxel) == label;
    if ((isFound || isReference) && !course.IsBeyondEnds(Eigen::Vector3d(labels->GetPoint(voxel))))
    {
      both += isFound && isReference;
      segmentation += isFound;
      reference += isReference;
    }
  }
  double inside = 0;
  for (const Eigen::Vector3d& point : course.Points)
  {
    const vtkIdType voxel = labels->FindPoint(point.x(), point.y(), point.z());
    inside += voxel >= 0 && labels->GetPointData()->GetScalars()->GetTuple1(voxel) == label;
  }
  return { 2 * both / (segmentation + reference), segmentation / reference - 1,
    inside / static_cast<double>(course.Points.size()) };
}

// Between the end planes, too; of the label maps' surfaces.
double MeanDistance(vtkImageData* found, vtkImageData* labels, const Course& course)
{
  const auto between = [&course](vtkImageData* mask)
  {
    auto kept = vtkSmartPointer<vtkImageData>::New();
    kept->CopyStructure(mask);
    kept->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    auto* const to = static_cast<unsigned char*>(kept->GetScalarPointer());
    for (vtkIdType voxel = 0; voxel < mask->GetNumberOfPoints(); ++voxel)
    {
      to[voxel] = mask->GetPointData()->GetScalars()->GetTuple1(voxel) != 0 &&
        !course.IsBeyondEnds(Eigen::Vector3d(mask->GetPoint(voxel)));
    }
    return kept;
  };
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(between(found));
  metrics->SetReferenceData(between(labels));
  metrics->SetReferenceLabel(1);
  metrics->Update();
  return metrics->GetASD();
}

// Moves points in random directions, the same each time.
std::vector<Eigen::Vector3d> Jittered(std::vector<Eigen::Vector3d> points, double distance,
  std::mt19937& random)
{
  for (Eigen::Vector3d& point : points)
  {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    const Eigen::Vector3d direction(x, y, normal(random));
    point += distance * direction.normalized();
  }
  return points;
}

// Per volume A or B: settings are chosen on one and reported on the other.
std::map<std::string, std::string> ReadHalves(const std::string& file)
{
  std::map<std::string, std::string> halves;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t comma = line.find(',');
    halves[line.substr(0, comma)] = comma < line.size() ? line.substr(comma + 1) : "";
  }
  return halves;
}

double MeanRadius(vtkPolyData* centerline)
{
  vtkDataArray* const radii = centerline->GetPointData()->GetArray("Radius");
  double sum = 0;
  for (vtkIdType point = 0; point < radii->GetNumberOfTuples(); ++point)
  {
    sum += radii->GetTuple1(point);
  }
  return sum / static_cast<double>(radii->GetNumberOfTuples());
}

void Write(vtkPolyData* data, const std::string& file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.c_str());
  writer->Write();
}

// `name`: of the files of the surface and its centerline.
Score MeasureTube(const Tube& tube, const std::vector<Eigen::Vector3d>& points, vtkImageData* image,
  vtkImageData* labels, const Options& options, const std::string& name, Filter* filter)
{
  filter->SetInputData(image);
  filter->SetRadius(options.Radius);
  filter->SetWallThickness(options.WallThickness);
  for (const Eigen::Vector3d& point : points)
  {
    filter->AddPoint(point.x(), point.y(), point.z());
  }
  const double begin = vtkTimerLog::GetUniversalTime();
  filter->Update();
  const double seconds = vtkTimerLog::GetUniversalTime() - begin;
  if (filter->GetSurface()->GetNumberOfPoints() == 0)
  {
    std::printf("| %-14s | no surface |\n", tube.Name.c_str());
    return {};
  }
  const Course course(filter->GetCenterline());
  const Overlap overlap = MeasureOverlap(filter->GetLabelMap(), labels, 1, course);
  std::printf("| %-14s | %.3f | %.2f | %+.2f | %.3f | %4.1f | %5d | %.2f | %d |\n",
    tube.Name.c_str(), overlap.Dice, filter->GetConfidence(), overlap.VolumeDifference,
    overlap.Inside, MeanRadius(filter->GetCenterline()),
    static_cast<int>(filter->GetSurface()->GetNumberOfPoints()), seconds,
    filter->GetNumberOfSelfIntersections());
  std::fflush(stdout);
  if (!options.Surfaces.empty())
  {
    std::filesystem::create_directories(options.Surfaces);
    Write(filter->GetSurface(), options.Surfaces + "/" + name + ".vtp");
    Write(filter->GetCenterline(), options.Surfaces + "/" + name + "-line.vtp");
  }
  Score score{ overlap.Dice, std::nan(""), seconds, filter->GetConfidence(), 1 };
  if (!options.Methods.empty())
  {
    score.Distance = MeanDistance(filter->GetLabelMap(), labels, course);
  }
  return score;
}

// Another method on what FlipFree has segmented.
Score MeasureMethod(const std::string& name, const Tube& tube,
  const std::vector<Eigen::Vector3d>& points, vtkImageData* image, vtkImageData* labels,
  const Options& options, Filter* flipFree, double secondsOfFlipFree)
{
  const auto method = PrepareMethod(VesselMethodOf(name), image, points, flipFree->GetCenterline(),
    options.Parameters);
  const double begin = vtkTimerLog::GetUniversalTime();
  method->Update();
  const double seconds = vtkTimerLog::GetUniversalTime() - begin;
  if (method->GetLabelMap()->GetNumberOfPoints() == 0)
  {
    std::printf("| %-14s | nothing | | | %s |\n", tube.Name.c_str(), name.c_str());
    return {};
  }
  const Course course(flipFree->GetCenterline());
  const Overlap overlap = MeasureOverlap(method->GetLabelMap(), labels, 1, course);
  const double distance = MeanDistance(method->GetLabelMap(), labels, course);
  std::printf("| %-14s | %.3f | %+.2f | %.2f mm | %s | %.2f |\n", tube.Name.c_str(), overlap.Dice,
    overlap.VolumeDifference, distance, name.c_str(), seconds);
  std::fflush(stdout);
  return { overlap.Dice, distance, seconds, 0, seconds / secondsOfFlipFree };
}

// By kind of vessel, all and each half, and method.
using Scores = std::map<std::string, std::map<std::string, std::vector<Score>>>;

constexpr const char* FlipFreeName = "flipfree";

// Of those that are numbers.
double MedianOf(const std::vector<Score>& scores, double Score::*value)
{
  std::vector<double> values;
  for (const Score& score : scores)
  {
    if (!std::isnan(score.*value))
    {
      values.push_back(score.*value);
    }
  }
  return values.empty() ? std::nan("") : Median(values);
}

double LeastDice(const std::vector<Score>& scores)
{
  double least = 1;
  for (const Score& score : scores)
  {
    least = std::min(least, score.Dice);
  }
  return least;
}

// The part of the pairs of a result below that Dice and one above in which the former has the lower
// confidence.
double AreaUnderCurve(const std::vector<Score>& scores, double dice)
{
  double right = 0;
  double pairs = 0;
  for (const Score& bad : scores)
  {
    for (const Score& good : scores)
    {
      if (bad.Dice < dice && good.Dice >= dice)
      {
        right +=
          bad.Confidence < good.Confidence ? 1 : (bad.Confidence == good.Confidence ? 0.5 : 0);
        ++pairs;
      }
    }
  }
  return pairs > 0 ? right / pairs : std::nan("");
}

void PrintComparison(const Scores& scores, const std::vector<std::string>& methods)
{
  std::printf(
    "| vessels | method | Dice, median | least | mean distance, mm | s | times FlipFree's "
    "|\n|---|---|---|---|---|---|---|\n");
  for (const auto& [vessels, found] : scores)
  {
    for (const std::string& method : methods)
    {
      const std::vector<Score>& own = found.at(method);
      std::printf("| %s (%zu) | %s | %.3f | %.3f | %.2f | %.2f | %.2f |\n", vessels.c_str(),
        own.size(), method.c_str(), MedianOf(own, &Score::Dice), LeastDice(own),
        MedianOf(own, &Score::Distance), MedianOf(own, &Score::Seconds),
        MedianOf(own, &Score::TimesFlipFree));
    }
  }
}

void Measure(const Options& options)
{
  std::printf("| vessel | Dice | confidence | volume | inside | radius | vertices | s | "
              "self-intersections |\n");
  const std::map<std::string, std::string> halves = ReadHalves(options.Halves);
  Scores scores;
  std::string read; // the volume at hand
  vtkSmartPointer<vtkImageData> image;
  vtkSmartPointer<vtkImageData> labels;
  const std::vector<Tube> tubes = ReadTubes(options.Data + "/" + options.Cases);
  if (tubes.empty())
  {
    throw std::runtime_error("there is no vessel in '" + options.Data + "/" + options.Cases + "'");
  }
  for (const Tube& tube : tubes)
  {
    if (tube.Name.find(options.Only) == std::string::npos)
    {
      continue;
    }
    if (read != tube.Image)
    {
      image = ReadVolume(options.Data + "/" + tube.Image);
      labels = ReadVolume(options.Data + "/" + tube.Labels);
      read = tube.Image;
    }
    const auto half = halves.find(tube.Name.substr(0, tube.Name.find('-')));
    std::mt19937 random(7);
    const auto parts = PartsWith(tube.Points, labels, tube.Label);
    for (int repeat = 0; repeat < options.Repeats; ++repeat)
    {
      const auto points = Jittered(tube.Points, options.Jitter, random);
      const auto add = [&](const std::string& method, const Score& score)
      {
        scores[tube.Organ][method].push_back(score);
        if (half != halves.end())
        {
          scores[tube.Organ + " " + half->second][method].push_back(score);
        }
      };
      vtkNew<Filter> filter;
      const std::string name =
        tube.Name + (options.Repeats > 1 ? "-" + std::to_string(repeat + 1) : "");
      const Score own = MeasureTube(tube, points, image, parts, options, name, filter);
      add(FlipFreeName, own);
      for (const std::string& method : options.Methods)
      {
        add(method,
          own.Dice > 0
            ? MeasureMethod(method, tube, points, image, parts, options, filter, own.Seconds)
            : Score());
      }
    }
  }
  constexpr double poor = 0.7; // Dice
  for (const auto& [organ, found] : scores)
  {
    const std::vector<Score>& own = found.at(FlipFreeName);
    std::printf("%-8s %3zu runs, Dice: median %.3f, least %.3f", organ.c_str(), own.size(),
      MedianOf(own, &Score::Dice), LeastDice(own));
    const double area = AreaUnderCurve(own, poor);
    if (!std::isnan(area))
    {
      std::printf(", below %.1f by confidence: area under the curve %.2f", poor, area);
    }
    std::printf("\n");
  }
  if (!options.Methods.empty())
  {
    std::vector<std::string> methods = options.Methods;
    methods.insert(methods.begin(), FlipFreeName);
    PrintComparison(scores, methods);
  }
}

} // namespace

int main(int argc, char* argv[])
try
{
  Options options;
  options.WallThickness = vtkNew<Filter>()->GetWallThickness();
  CLI::App program("Measures the segmentation of vessels.");
  program.add_option("--data", options.Data, "folder with the vessels' table and volumes")
    ->capture_default_str();
  program.add_option("--cases", options.Cases, "table of the vessels, in the folder")
    ->capture_default_str();
  program.add_option("--only", options.Only, "rows whose name contains this");
  program.add_option("--radius", options.Radius, "of all vessels, mm");
  program.add_option("--wall-thickness", options.WallThickness, "mm");
  program.add_option("--jitter", options.Jitter, "how far points are moved, mm");
  program.add_option("--repeats", options.Repeats, "runs per row");
  program.add_option("--halves", options.Halves, "table of volumes and their halves");
  program.add_option("--surfaces", options.Surfaces, "folder for surfaces and centerlines");
  std::vector<std::string> names;
  for (const VesselMethod& method : VesselMethods())
  {
    names.push_back(method.Name);
  }
  program.add_option("--methods", options.Methods, "methods to compare with")
    ->check(CLI::IsMember(names));
  program.add_option("--set", options.Parameters, "their parameters, NAME=VALUE");
  CLI11_PARSE(program, argc, argv);
  Measure(options);
  return 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "MeasureVessels: %s\n", error.what());
  return 1;
}
