// Where the time and the memory of whole runs go, from the volume in memory to surface, label map
// and scores. Medians of runs that take turns.
//
//   MeasureRun --data DIR --only abdomen01-liver     a row of cases.csv
//   MeasureRun --size 512x512x275                    the abdomen phantom, drawn that fine
//   MeasureRun --series vertices                     how the cost grows, with fitted exponents;
//                                                    also resolution, surroundings, organ
//
// For one volume it prints the seconds of every stage, and the stages that do little else than
// move voxels beside what memory allows in the same run. The clock is the one on the wall; the
// processor's is printed beside it, since other work on the machine slows the former.
#include "CaseList.h"
#include "MemoryBandwidth.h"
#include "PhantomScan.h"
#include "SegmentationRun.h"
#include "Statistics.h"

#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "Image/AnisotropicDiffusion.h"
#include "LabelAdapter.h"
#include "Measures/VoxelOverlap.h"
#include "Stopwatch.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkNew.h"
#include "vtkSegmentationMetrics.h"
#include "vtkShortArray.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

using namespace FlipFree;

namespace
{

struct Subject
{
  std::string Name;
  vtkSmartPointer<vtkImageData> Image;
  vtkSmartPointer<vtkImageData> Reference;
  int Label = 0;
  SeedSphere Seed;
  int Resolution = 0; ///< zero: the default
  double Size = 0;    ///< what a series varies
};

Subject SubjectOfCase(const Case& row, const std::string& folder)
{
  return { row.Name, ReadVolume(folder + "/" + row.Image), ReadVolume(folder + "/" + row.Labels),
    row.Label, { Eigen::Vector3d(row.Seed.data()), row.Radius } };
}

Subject SubjectOfPhantom(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  double scale = 1)
{
  const PhantomScan scan = ScanAbdomen(dimensions, spacing, scale, SMPFor);
  Subject subject;
  subject.Name = "phantom, " + std::to_string(dimensions[0]) + " x " +
    std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]);
  subject.Image = vtkSmartPointer<vtkImageData>::New();
  subject.Image->SetDimensions(dimensions.data());
  subject.Image->SetSpacing(spacing.data());
  subject.Reference = vtkSmartPointer<vtkImageData>::New();
  subject.Reference->CopyStructure(subject.Image);
  const auto attach = [](vtkDataArray* array, const auto& values, vtkImageData* image)
  {
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    std::copy(values.begin(), values.end(),
      static_cast<typename std::decay_t<decltype(values)>::value_type*>(array->GetVoidPointer(0)));
    image->GetPointData()->SetScalars(array);
  };
  attach(vtkNew<vtkShortArray>(), scan.Voxels, subject.Image);
  attach(vtkNew<vtkUnsignedCharArray>(), scan.Labels, subject.Reference);
  subject.Label = scan.Label;
  subject.Seed = scan.Seed;
  return subject;
}

// The body's field of view at a given number of voxels.
Subject SubjectOfSize(const std::array<int, 3>& dimensions)
{
  const double pixel = 330.0 / dimensions[0];
  return SubjectOfPhantom(dimensions, { pixel, pixel, 270.0 / dimensions[2] });
}

struct Quantity
{
  std::string Name;
  double Value;
};

struct Run
{
  std::vector<Quantity> Stages; ///< seconds
  double Total = 0;             ///< seconds, to the scores
  double ToLabels = 0;          ///< seconds, to surface and label map
  double Processor = 0;         ///< seconds of all threads
  double Memory = 0;            ///< bytes beyond the input, at the most
  double Dice = 0;
  int Iterations = 0;
  std::vector<Quantity> PerIteration; ///< seconds, at the finest level
};

double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<Quantity> FinestIteration(vtkTable* table)
{
  std::vector<Quantity> means;
  const int last = table->GetValueByName(table->GetNumberOfRows() - 1, "Level").ToInt();
  for (const char* name : { "SearchSeconds", "FlipSeconds", "SolveSeconds", "GuardSeconds" })
  {
    std::vector<double> values;
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
    {
      if (table->GetValueByName(row, "Level").ToInt() == last)
      {
        values.push_back(table->GetValueByName(row, name).ToDouble());
      }
    }
    means.push_back({ name, Median(values) });
  }
  return means;
}

Run RunOnce(const Subject& subject)
{
  Run run;
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputDataObject(subject.Image);
  filter->SetSeedCenter(subject.Seed.Center.data());
  filter->SetSeedRadius(subject.Seed.Radius);
  if (subject.Resolution > 0)
  {
    filter->SetResolution(subject.Resolution);
    filter->SetLevels(static_cast<int>(std::round(std::log2(subject.Resolution / 4.0))) + 1);
  }
  const double before = ResetPeakMemory();
  const double processor = ProcessorSeconds();
  Stopwatch watch;
  filter->Update();
  run.ToLabels = watch.Lap();
  run.Memory = PeakMemory() - before;

  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(filter->GetLabelMap());
  metrics->SetReferenceData(subject.Reference);
  metrics->SetReferenceLabel(subject.Label);
  metrics->Update();
  const double scores = watch.Lap();
  run.Total = run.ToLabels + scores;
  run.Processor = ProcessorSeconds() - processor;
  run.Dice = metrics->GetDice();

  const StageSeconds stages = StageSecondsOf(filter);
  run.Iterations = stages.Iterations;
  const double iterations = stages.Search + stages.Flips + stages.Solve + stages.Guard;
  run.Stages = { { "region, noise, prefilter", stages.Smoothing }, { "feature", stages.Feature },
    { "search, outliers", stages.Search }, { "flips, propagation", stages.Flips },
    { "solve", stages.Solve }, { "guard", stages.Guard },
    { "refinements, last check", stages.Deformation - iterations }, { "label map", stages.Labels },
    { "scores", scores } };
  run.PerIteration = FinestIteration(filter->GetConvergence());
  return run;
}

template <typename Read>
double MedianOf(const std::vector<Run>& runs, const Read& read)
{
  std::vector<double> values;
  for (const Run& run : runs)
  {
    values.push_back(read(run));
  }
  return Median(values);
}

// The region that the surface may reach, as vtkFlipFreeSegmentation chooses it.
VoxelBox RegionOf(const Subject& subject)
{
  return BoxAround(GeometryOf(subject.Image), subject.Seed.Center,
    std::clamp(10 * subject.Seed.Radius, 100.0, 250.0));
}

// What only moves voxels: seconds of a single call, and the bytes that it cannot do without.
struct Traffic
{
  std::string Name;
  double Bytes;
  std::function<void()> Call;
  std::vector<double> Seconds;
};

void MeasureTraffic(const Subject& subject, int runs, int threads)
{
  const VoxelBox box = RegionOf(subject);
  const ImageGeometry geometry = GeometryOf(subject.Image);
  FloatImage region;
  GrayRegionOf(subject.Image, box, region);
  const auto inRegion = static_cast<double>(region.Voxels.size());
  const auto inImage = static_cast<double>(geometry.NumberOfVoxels());
  const double scalar = subject.Image->GetPointData()->GetScalars()->GetDataTypeSize();
  const double label = subject.Reference->GetPointData()->GetScalars()->GetDataTypeSize();
  AnisotropicDiffusionSettings diffusion;
  diffusion.Contrast = ContrastOfNoise(NoiseStandardDeviation(region.View(), subject.Seed));
  std::vector<float> smooth(region.Voxels.size());
  const BitMask mask = LabelVolumeOf(subject.Reference, "the reference").MaskOf(subject.Label);
  vtkNew<vtkImageData> labelMap;

  std::vector<Traffic> stages = {
    { "region: scalars to floats", inRegion * (scalar + 4),
      [&] { GrayRegionOf(subject.Image, box, region); }, {} },
    { "prefilter: in and out once per step", inRegion * 8 * diffusion.Iterations,
      [&]
      {
        DiffuseAnisotropically(ReaderOf(region.View()), region.Geometry, diffusion, SMPFor,
          NeverStop, smooth.data());
      },
      {} },
    { "threshold: floats to bits", inRegion * (4 + 1.0 / 8),
      [&]
      {
        VoxelsWhere(
          region.View(), [](float z) { return z >= 100 && z < 200; }, SMPFor);
      },
      {} },
    { "label map: filled", inImage, [&] { MakeLabelMap({}, 1, subject.Image, labelMap); }, {} },
    { "scores: a label to a mask", inImage * (label + 1.0 / 8),
      [&] { LabelVolumeOf(subject.Reference, "the reference").MaskOf(subject.Label); }, {} },
    { "scores: overlap of two masks", inImage * 2 / 8, [&] { MeasureOverlap(mask, mask, SMPFor); },
      {} },
  };
  std::vector<double> bandwidths;
  for (int run = 0; run < runs; ++run)
  {
    bandwidths.push_back(MemoryBandwidth(threads));
    for (Traffic& stage : stages)
    {
      Stopwatch watch;
      stage.Call();
      stage.Seconds.push_back(watch.Lap());
    }
  }
  const double bandwidth = Median(bandwidths);
  std::printf("\nmemory bandwidth, triad with %d threads: %.1f GB/s\n", threads, bandwidth / 1e9);
  std::puts("| bound by memory | MB moved | ms | GB/s | times the limit |\n|---|---|---|---|---|");
  for (const Traffic& stage : stages)
  {
    const double seconds = Median(stage.Seconds);
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f |\n", stage.Name.c_str(), stage.Bytes / 1e6,
      1e3 * seconds, stage.Bytes / seconds / 1e9, seconds * bandwidth / stage.Bytes);
  }
}

void MeasureSubject(const Subject& subject, int runs, int threads)
{
  std::vector<Run> all;
  for (int run = 0; run < runs; ++run)
  {
    all.push_back(RunOnce(subject));
  }
  const double total = MedianOf(all, [](const Run& run) { return run.Total; });
  std::printf("%s: %d threads, medians of %d runs, %d iterations, Dice %.3f\n\n",
    subject.Name.c_str(), threads, runs, all.front().Iterations, all.front().Dice);
  std::puts("| stage | ms | share |\n|---|---|---|");
  for (std::size_t stage = 0; stage < all.front().Stages.size(); ++stage)
  {
    const double seconds = MedianOf(all, [=](const Run& run) { return run.Stages[stage].Value; });
    std::printf("| %s | %.1f | %.0f %% |\n", all.front().Stages[stage].Name.c_str(), 1e3 * seconds,
      100 * seconds / total);
  }
  const VoxelBox box = RegionOf(subject);
  const double region =
    4.0 * static_cast<double>(CropGeometry(GeometryOf(subject.Image), box).NumberOfVoxels());
  // The first run's: what later ones find free in the process they need not take again.
  std::printf("| **to surface and label map** | **%.1f** | |\n| **to the scores** | **%.1f** | |\n"
              "| processor, all threads | %.1f | |\n\n"
              "memory beyond the input, at the most: %.1f MB, %.2f times the region as floats\n",
    1e3 * MedianOf(all, [](const Run& run) { return run.ToLabels; }), 1e3 * total,
    1e3 * MedianOf(all, [](const Run& run) { return run.Processor; }), all.front().Memory / 1e6,
    all.front().Memory / region);
  MeasureTraffic(subject, runs, threads);
}

std::vector<Subject> SubjectsOf(const std::string& series)
{
  std::vector<Subject> subjects;
  const auto add = [&subjects](Subject subject, double size)
  {
    subject.Size = size;
    subjects.push_back(std::move(subject));
  };
  if (series == "vertices")
  {
    const Subject scan = SubjectOfPhantom({ { 220, 170, 90 } }, { 1.5, 1.5, 3 });
    for (int n = 8; n <= 128; n *= 2)
    {
      Subject subject = scan;
      subject.Resolution = n;
      subject.Name = "n = " + std::to_string(n);
      add(subject, 6.0 * n * n);
    }
    return subjects;
  }
  if (series == "organ")
  {
    for (const double scale : { 0.5, 0.65, 0.8, 1.0, 1.2 })
    {
      Subject subject = SubjectOfPhantom({ { 220, 170, 150 } }, { 2, 2, 2 }, scale);
      subject.Name += ", body x " + std::to_string(scale).substr(0, 4);
      add(subject, std::pow(scale, 3));
    }
    return subjects;
  }
  for (const std::array<int, 3>& dimensions : std::vector<std::array<int, 3>>{ { 128, 128, 128 },
         { 192, 192, 160 }, { 256, 256, 192 }, { 384, 384, 240 }, { 512, 512, 275 } })
  {
    Subject subject = series == "resolution" ? SubjectOfSize(dimensions)
                                             : SubjectOfPhantom(dimensions, { 2.2, 2.2, 2.2 }, 0.8);
    const auto size = static_cast<double>(subject.Image->GetNumberOfPoints());
    add(subject, size);
  }
  return subjects;
}

void MeasureSeries(const std::string& series, int runs)
{
  const std::vector<Subject> subjects = SubjectsOf(series);
  std::vector<std::vector<Run>> all(subjects.size());
  for (int run = 0; run < runs; ++run)
  {
    for (std::size_t subject = 0; subject < subjects.size(); ++subject)
    {
      all[subject].push_back(RunOnce(subjects[subject]));
    }
  }
  const bool perIteration = series == "vertices";
  std::printf("milliseconds, medians of %d runs; %s\n\n| %s |", runs,
    perIteration ? "per iteration at the finest level" : "of whole runs", series.c_str());
  const auto quantities = [perIteration](const Run& run)
  {
    std::vector<Quantity> values = perIteration ? run.PerIteration : run.Stages;
    values.push_back({ "to surface and label map", run.ToLabels });
    values.push_back({ "memory, MB", run.Memory / 1e9 });
    return values;
  };
  const std::vector<Quantity> columns = quantities(all.front().front());
  std::string rule = "|---|";
  for (const Quantity& column : columns)
  {
    std::printf(" %s |", column.Name.c_str());
    rule += "---|";
  }
  std::printf("\n%s\n", rule.c_str());
  std::vector<double> sizes;
  std::vector<std::vector<double>> values(columns.size());
  for (std::size_t subject = 0; subject < subjects.size(); ++subject)
  {
    sizes.push_back(subjects[subject].Size);
    std::printf("| %s |", subjects[subject].Name.c_str());
    for (std::size_t column = 0; column < columns.size(); ++column)
    {
      values[column].push_back(
        MedianOf(all[subject], [&](const Run& run) { return quantities(run)[column].Value; }));
      std::printf(" %.1f |", 1e3 * values[column].back());
    }
    std::printf("\n");
  }
  std::printf("| exponent |");
  for (const std::vector<double>& column : values)
  {
    std::printf(" %.2f |", FittedExponent(sizes, column));
  }
  std::printf("\n");
}

} // namespace

int main(int argc, char* argv[])
{
  std::string folder = DefaultDataFolder();
  std::string only;
  std::string size;
  std::string series;
  int runs = 5;
  int threads = 0;
  CLI::App app("Measures whole runs: seconds per stage, memory, bandwidth, growth.");
  app.add_option("--data", folder, "folder with cases.csv")->capture_default_str();
  app.add_option("--only", only, "the rows of cases.csv whose name contains this text");
  app.add_option("--size", size, "the phantom with that many voxels, such as 512x512x275");
  app.add_option("--series", series, "vertices, resolution, surroundings, or organ")
    ->check(CLI::IsMember({ "vertices", "resolution", "surroundings", "organ" }));
  app.add_option("--runs", runs, "of which medians are taken")->capture_default_str();
  app.add_option("--threads", threads, "number of threads");
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(threads);
  threads = vtkSMPTools::GetEstimatedNumberOfThreads();

  if (!series.empty())
  {
    MeasureSeries(series, runs);
    return 0;
  }
  if (!only.empty())
  {
    for (const Case& row : ReadCases(folder + "/cases.csv"))
    {
      if (row.Name.find(only) != std::string::npos)
      {
        MeasureSubject(SubjectOfCase(row, folder), runs, threads);
      }
    }
    return 0;
  }
  std::array<int, 3> dimensions{ { 220, 170, 90 } };
  if (!size.empty() &&
    std::sscanf(size.c_str(), "%dx%dx%d", &dimensions[0], &dimensions[1], &dimensions[2]) != 3)
  {
    std::fprintf(stderr, "--size wants three numbers such as 512x512x275, not %s\n", size.c_str());
    return 1;
  }
  MeasureSubject(SubjectOfSize(dimensions), runs, threads);
  return 0;
}
