#include "CaseList.h"

#include "Image/DistanceTransform.h"
#include "ImageAdapter.h"
#include "LabelAdapter.h"

#include "vtkMedicalImageReader.h"
#include "vtkNew.h"

#include <malloc.h>

#include <fstream>
#include <random>
#include <sstream>

std::string DefaultDataFolder()
{
  return FLIPFREE_DATA_DIR;
}

std::vector<Case> ReadCases(const std::string& file)
{
  std::vector<Case> cases;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line); // the column names
  while (std::getline(stream, line))
  {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ',');)
    {
      fields.push_back(field);
    }
    Case row;
    row.Name = fields.at(0);
    row.Organ = fields.at(1);
    row.Image = fields.at(3);
    row.Labels = fields.at(4);
    row.Label = std::stoi(fields.at(5));
    row.Seed = { { std::stod(fields.at(6)), std::stod(fields.at(7)), std::stod(fields.at(8)) } };
    row.Radius = std::stod(fields.at(9));
    cases.push_back(row);
  }
  return cases;
}

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& file)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::vector<RandomSeed> RandomSeeds(vtkImageData* labels, int label, double radius, int count)
{
  const FlipFree::BitMask mask = FlipFree::LabelVolumeOf(labels, "the reference").MaskOf(label);
  const FlipFree::ImageGeometry& geometry = mask.GetGeometry();
  std::vector<unsigned char> voxels(geometry.NumberOfVoxels(), 0);
  mask.ForEach([&voxels](std::size_t voxel) { voxels[voxel] = 1; });
  const std::vector<float> depth =
    FlipFree::SquaredDistance(voxels, geometry, 0, FlipFree::SerialFor, FlipFree::NeverStop);
  std::mt19937 random(20240607);
  std::vector<RandomSeed> seeds;
  for (int halving = 0; halving < 3 && seeds.empty(); ++halving, radius /= 2)
  {
    std::vector<std::size_t> candidates;
    for (std::size_t voxel = 0; voxel < depth.size(); ++voxel)
    {
      if (voxels[voxel] && depth[voxel] >= radius * radius)
      {
        candidates.push_back(voxel);
      }
    }
    if (candidates.size() < static_cast<std::size_t>(count))
    {
      continue;
    }
    for (int seed = 0; seed < count; ++seed)
    {
      const std::size_t voxel = candidates[random() % candidates.size()];
      const std::size_t row = geometry.Dimensions[0];
      const std::size_t rows = geometry.Dimensions[1];
      const Eigen::Matrix<std::size_t, 3, 1> index(voxel % row, voxel / row % rows,
        voxel / row / rows);
      const Eigen::Vector3d center = geometry.ToPhysical(index.cast<double>());
      seeds.push_back({ { { center[0], center[1], center[2] } }, radius });
    }
  }
  return seeds;
}

// From the system's description of this process: bytes of a line that is given in kilobytes.
static double StatusLine(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == name + ":")
    {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  }
  return 0;
}

double PeakMemory()
{
  // What getrusage tells is at least the size that the process's parent had when it began.
  return StatusLine("VmHWM");
}

double ResetPeakMemory()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return StatusLine("VmRSS");
}
