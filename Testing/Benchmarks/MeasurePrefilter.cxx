// Times the prefilter beside ITK's gradient and curvature diffusion and beside the memory's
// bandwidth. Prints the medians of interleaved runs: nanoseconds per voxel and iteration, and how
// the time of all iterations compares with that of moving the voxels once (read as short, written
// as float) and once per iteration.
//
//   MeasurePrefilter [--size N] [--iterations N] [--repetitions N] [--threads N]
#include "MemoryBandwidth.h"

#include "ExecutionAdapter.h"
#include "Image/AnisotropicDiffusion.h"
#include "ImageAdapter.h"
#include "Stopwatch.h"

#include "vtkAnisotropicDiffusionPrefilter.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace
{

constexpr double Contrast = 20;

struct Options
{
  int Size = 128;
  int Iterations = 5;
  int Repetitions = 5;
  int Threads = 2;
};

struct Method
{
  std::string Name;
  std::function<double()> Run; ///< gives the seconds
  std::vector<double> Seconds;
};

void MakeImage(int size, vtkImageData* image)
{
  image->SetDimensions(size, size, size);
  image->SetSpacing(0.8, 0.8, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  auto* voxels = static_cast<short*>(image->GetScalarPointer());
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 15);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    voxels[voxel] =
      static_cast<short>((voxel % size < size / 2 ? 0 : 100) + std::lround(normal(random)));
  }
}

double RunItk(vtkImageData* image, int equation, const Options& options)
{
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetInputData(image);
  filter->SetEquation(equation);
  filter->SetNumberOfIterations(options.Iterations);
  filter->SetGradientScale(Contrast);
  FlipFree::Stopwatch watch;
  filter->Update();
  return watch.Lap();
}

double RunKernel(vtkImageData* image, const Options& options)
{
  const FlipFree::ImageView<short> gray = FlipFree::ViewOf<short>(image);
  std::vector<float> smooth(gray.Geometry.NumberOfVoxels());
  FlipFree::Stopwatch watch;
  FlipFree::DiffuseAnisotropically(FlipFree::ReaderOf(gray), gray.Geometry,
    { options.Iterations, Contrast, options.Threads }, FlipFree::SMPFor, FlipFree::NeverStop,
    smooth.data());
  return watch.Lap();
}

double MedianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void Print(const std::vector<Method>& methods, double bandwidth, const Options& options)
{
  std::printf("triad: %.1f GB/s\n\n", bandwidth / 1e9);
  std::printf("| method | ns per voxel and iteration | all iterations, in times of one pass | in "
              "times of a pass each |\n"
              "|---|---|---|---|\n");
  const double voxels = std::pow(options.Size, 3);
  const double onePass = (sizeof(short) + sizeof(float)) / bandwidth;
  const double perIteration = 2 * sizeof(float) / bandwidth;
  for (const Method& method : methods)
  {
    const double perVoxel = MedianOf(method.Seconds) / voxels;
    std::printf("| %s | %.2f | %.1f | %.2f |\n", method.Name.c_str(),
      1e9 * perVoxel / options.Iterations, perVoxel / onePass,
      perVoxel / (perIteration * options.Iterations));
  }
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  CLI::App app{ "Times the prefilter beside ITK's and beside the memory's bandwidth." };
  app.add_option("--size", options.Size, "voxels along each axis")->check(CLI::Range(8, 1024));
  app.add_option("--iterations", options.Iterations, "iterations")->check(CLI::Range(1, 1000));
  app.add_option("--repetitions", options.Repetitions, "interleaved runs")
    ->check(CLI::Range(1, 1000));
  app.add_option("--threads", options.Threads, "threads")->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(options.Threads);

  vtkNew<vtkImageData> image;
  MakeImage(options.Size, image);
  using Filter = vtkAnisotropicDiffusionPrefilter;
  std::vector<Method> methods{
    { "ITK, gradient", [&] { return RunItk(image, Filter::GRADIENT, options); }, {} },
    { "ITK, curvature", [&] { return RunItk(image, Filter::CURVATURE, options); }, {} },
    { "FlipFree", [&] { return RunKernel(image, options); }, {} },
  };
  double bandwidth = 0;
  for (int repetition = 0; repetition < options.Repetitions; ++repetition)
  {
    bandwidth = std::max(bandwidth, FlipFree::MemoryBandwidth(options.Threads));
    for (Method& method : methods)
    {
      method.Seconds.push_back(method.Run());
    }
  }
  Print(methods, bandwidth, options);
  return EXIT_SUCCESS;
}
