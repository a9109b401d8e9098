// Times the prefilter side by side, in one run: ITK's filters, the kernel with the same equations
// and numbers, and the kernel's own equation, beside the memory's bandwidth. Prints the medians of
// interleaved runs: nanoseconds per voxel and iteration, the greatest difference from ITK, and how
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
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace
{

using Equation = FlipFree::DiffusionEquation;

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
  Equation Kind;
  bool IsItk;
  std::vector<double> Seconds;
  std::vector<float> Result;
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

void RunItk(vtkImageData* image, const Options& options, Method& method)
{
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetInputData(image);
  filter->SetEquation(method.Kind == Equation::Curvature
      ? vtkAnisotropicDiffusionPrefilter::CURVATURE
      : vtkAnisotropicDiffusionPrefilter::GRADIENT);
  filter->SetNumberOfIterations(options.Iterations);
  filter->SetGradientScale(Contrast);
  FlipFree::Stopwatch watch;
  filter->Update();
  method.Seconds.push_back(watch.Lap());
  const auto* voxels = static_cast<float*>(filter->GetOutput()->GetScalarPointer());
  method.Result.assign(voxels, voxels + image->GetNumberOfPoints());
}

void RunKernel(vtkImageData* image, const Options& options, Method& method)
{
  const FlipFree::ImageView<short> gray = FlipFree::ViewOf<short>(image);
  method.Result.resize(gray.Geometry.NumberOfVoxels());
  FlipFree::Stopwatch watch;
  FlipFree::DiffuseAnisotropically(FlipFree::ReaderOf(gray), gray.Geometry,
    { options.Iterations, Contrast, method.Kind, 0 }, FlipFree::SMPFor, FlipFree::NeverStop,
    method.Result.data());
  method.Seconds.push_back(watch.Lap());
}

double MedianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double MaximumDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double greatest = 0;
  for (std::size_t voxel = 0; voxel < a.size(); ++voxel)
  {
    greatest = std::max(greatest, std::abs(static_cast<double>(a[voxel]) - b[voxel]));
  }
  return greatest;
}

void Print(const std::vector<Method>& methods, double bandwidth, const Options& options)
{
  std::printf("triad: %.1f GB/s\n\n", bandwidth / 1e9);
  std::printf(
    "| method | ns per voxel and iteration | times ITK's speed | greatest difference from "
    "ITK | all iterations, in times of one pass | in times of a pass each |\n"
    "|---|---|---|---|---|---|\n");
  const double onePass = (sizeof(short) + sizeof(float)) / bandwidth;
  const double perIteration = 2 * sizeof(float) / bandwidth;
  for (const Method& method : methods)
  {
    const double perVoxel = MedianOf(method.Seconds) / static_cast<double>(method.Result.size());
    const auto itk = std::find_if(methods.begin(), methods.end(),
      [&method](const Method& other) { return other.IsItk && other.Kind == method.Kind; });
    std::printf("| %s | %.2f | ", method.Name.c_str(), 1e9 * perVoxel / options.Iterations);
    if (itk == methods.end() || method.IsItk)
    {
      std::printf("| | ");
    }
    else
    {
      std::printf("%.0f | %.1e | ", MedianOf(itk->Seconds) / MedianOf(method.Seconds),
        MaximumDifference(method.Result, itk->Result));
    }
    std::printf("%.1f | %.2f |\n", perVoxel / onePass,
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
  std::vector<Method> methods{ { "ITK, gradient", Equation::Gradient, true, {}, {} },
    { "kernel, gradient", Equation::Gradient, false, {}, {} },
    { "ITK, curvature", Equation::Curvature, true, {}, {} },
    { "kernel, curvature", Equation::Curvature, false, {}, {} },
    { "kernel, faces (the default)", Equation::Faces, false, {}, {} } };
  double bandwidth = 0;
  for (int repetition = 0; repetition < options.Repetitions; ++repetition)
  {
    bandwidth = std::max(bandwidth, FlipFree::MemoryBandwidth(options.Threads));
    for (Method& method : methods)
    {
      (method.IsItk ? RunItk : RunKernel)(image, options, method);
    }
  }
  Print(methods, bandwidth, options);
  return EXIT_SUCCESS;
}
