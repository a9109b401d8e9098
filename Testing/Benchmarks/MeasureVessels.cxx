// Runs the segmentation of vessels over every row of DIR/tubes.csv, one setting for all, and prints
// a table: overlap with the reference label between the planes across the path at its ends, how
// much of the centerline lies within the reference, seconds, self-intersections.
//
//   MeasureVessels [--data DIR] [--only TEXT] [--radius R] [--wall-thickness T] [--jitter MM]
//   [--repeats N]
//                  [--surfaces DIR]
//
// With --jitter, every point is moved by so much in a random direction, anew for each of the
// repeats.
#include "CaseList.h"
#include "Statistics.h"

#include "vtkCellArray.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"
#include "vtkXMLPolyDataWriter.h"

#include <CLI/CLI.hpp>
#include <Eigen/Dense>

#include <algorithm>
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
  std::string Data = "../shared/data";
  std::string Only;
  std::string Surfaces;
  double Radius = 0;
  double WallThickness = 0;
  double Jitter = 0;
  int Repeats = 1;
};

struct Tube
{
  std::string Name;
  std::string Role;
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

double MeasureTube(const Tube& tube, const std::vector<Eigen::Vector3d>& points,
  vtkImageData* image, vtkImageData* labels, const Options& options)
{
  vtkNew<Filter> filter;
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
    return 0;
  }
  const Overlap overlap =
    MeasureOverlap(filter->GetLabelMap(), labels, tube.Label, Course(filter->GetCenterline()));
  std::printf("| %-14s | %.3f | %+.2f | %.3f | %5d | %.2f | %d |\n", tube.Name.c_str(),
    overlap.Dice, overlap.VolumeDifference, overlap.Inside,
    static_cast<int>(filter->GetSurface()->GetNumberOfPoints()), seconds,
    filter->GetNumberOfSelfIntersections());
  std::fflush(stdout);
  if (!options.Surfaces.empty())
  {
    std::filesystem::create_directories(options.Surfaces);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(filter->GetSurface());
    writer->SetFileName((options.Surfaces + "/" + tube.Name + ".vtp").c_str());
    writer->Write();
  }
  return overlap.Dice;
}

void Measure(const Options& options)
{
  std::printf("| vessel | Dice | volume | inside | vertices | s | self-intersections |\n");
  std::map<std::string, std::vector<double>> scores;
  for (const Tube& tube : ReadTubes(options.Data + "/tubes.csv"))
  {
    if (tube.Name.find(options.Only) == std::string::npos)
    {
      continue;
    }
    const auto image = ReadVolume(options.Data + "/" + tube.Image);
    const auto labels = ReadVolume(options.Data + "/" + tube.Labels);
    std::mt19937 random(7);
    for (int repeat = 0; repeat < options.Repeats; ++repeat)
    {
      const auto points = Jittered(tube.Points, options.Jitter, random);
      scores[tube.Role].push_back(MeasureTube(tube, points, image, labels, options));
    }
  }
  for (auto& [role, dice] : scores)
  {
    std::sort(dice.begin(), dice.end());
    std::printf("%-8s %2zu runs, Dice: median %.3f, least %.3f\n", role.c_str(), dice.size(),
      Median(dice), dice.front());
  }
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  options.WallThickness = vtkNew<Filter>()->GetWallThickness();
  CLI::App program("Measures the segmentation of vessels.");
  program.add_option("--data", options.Data, "folder with tubes.csv and its volumes");
  program.add_option("--only", options.Only, "rows whose name contains this");
  program.add_option("--radius", options.Radius, "of all vessels, mm");
  program.add_option("--wall-thickness", options.WallThickness, "mm");
  program.add_option("--jitter", options.Jitter, "how far points are moved, mm");
  program.add_option("--repeats", options.Repeats, "runs per row");
  program.add_option("--surfaces", options.Surfaces, "folder for surfaces");
  CLI11_PARSE(program, argc, argv);
  Measure(options);
  return 0;
}
