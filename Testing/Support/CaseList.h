/**
 * The real cases that benchmarks and tests measure, and random seeds in their organs.
 */
#ifndef CaseList_h
#define CaseList_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

struct Case
{
  std::string Name;
  std::string Organ;
  std::string Image;
  std::string Labels;
  int Label = 0;
  std::array<double, 3> Seed{};
  double Radius = 0;
};

/// The folder of real volumes that the build was configured with, FLIPFREE_DATA_DIR.
std::string DefaultDataFolder();

/// The rows of a list such as cases.csv; none where the file does not exist.
std::vector<Case> ReadCases(const std::string& file);

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& file);

struct RandomSeed
{
  std::array<double, 3> Center{};
  double Radius = 0;
};

/// Voxel centers of the organ that lie at least `radius` millimeters from its border, chosen at
/// random but the same each time. Where fewer exist than asked for, the radius is halved, at most
/// twice.
std::vector<RandomSeed> RandomSeeds(vtkImageData* labels, int label, double radius, int count);

/// The peak resident size of this process in bytes, since ResetPeakMemory if it was called.
double PeakMemory();

/// Returns free memory to the system, forgets the peak, and returns the present resident size.
double ResetPeakMemory();

#endif
