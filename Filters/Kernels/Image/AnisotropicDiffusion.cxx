#include "Image/AnisotropicDiffusion.h"

#include "Image/DiffusionRows.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>

namespace FlipFree
{
namespace
{

// The greatest parts that the image is cut into: what a core works on, a few slices after each
// iteration, is to fit into its second cache. What is around a part is computed twice.
constexpr std::array<int, 3> PartSize{ { 320, 32, 64 } };
// Seconds between two questions to the monitor.
constexpr double Interval = 0.04;

DiffusionCoefficients CoefficientsOf(const AnisotropicDiffusionSettings& settings,
  const Eigen::Vector3d& spacing)
{
  DiffusionCoefficients result{};
  const double finest = spacing.minCoeff();
  const double contrast = settings.Contrast * settings.Contrast;
  const bool itk = settings.Equation != DiffusionEquation::Faces;
  // The step is chosen in units of the finest spacing; coarser axes diffuse less.
  const Eigen::Vector3d rates = (finest / spacing.array()).square();
  const double step =
    itk ? (settings.TimeStep > 0 ? settings.TimeStep : finest / 16) : 1 / (2 * rates.sum() + 1e-9);
  for (int axis = 0; axis < 3; ++axis)
  {
    result.InverseSpacing[axis] = static_cast<float>(1 / spacing[axis]);
    result.Weight[axis] = static_cast<float>(step * (itk ? 1 : rates[axis]));
  }
  // Finite, so that where nothing differs nothing flows, however small the contrast.
  result.Fall = static_cast<float>(std::min(itk ? 0.5 / contrast : 1 / contrast, 1e38));
  result.TimeStep = static_cast<float>(step);
  return result;
}

struct Range
{
  int Begin;
  int End;

  int Size() const { return this->End - this->Begin; }
};

std::array<int, 2> OthersOf(int axis)
{
  return { { axis == 0 ? 1 : 0, axis == 2 ? 1 : 2 } };
}

// The working memory of one thread: what a part of the image and its surroundings are after each
// iteration, of which three slices are kept.
class Cascade
{
public:
  Cascade(const VoxelReader& read, const ImageGeometry& geometry,
    const AnisotropicDiffusionSettings& settings, float* out)
    : Read(read)
    , Size(geometry.Dimensions)
    , Out(out)
    , Last(settings.Iterations)
    , Rows(ChooseDiffusionRows(settings.Equation))
    , Coefficients(CoefficientsOf(settings, geometry.Spacing))
  {
  }

  void Run(const VoxelBox& box)
  {
    this->Box = box;
    // With a place more on each side, where what is beyond the image repeats its rim.
    this->Row = this->RangeOf(0, 0).Size() + 2;
    this->Slice = this->Row * (this->RangeOf(0, 1).Size() + 2);
    this->Voxels.resize(3 * this->Slice * std::max(1, this->Last));
    this->SliceFlux.resize(this->Slice * this->Last);
    this->RowFlux.resize(4 * this->Row);

    // An iteration follows the one before at a distance of one slice.
    const int end = box.End[2] + this->Last;
    for (int front = this->RangeOf(0, 2).Begin; front < end; ++front)
    {
      for (int level = 0; level <= this->Last; ++level)
      {
        const int k = front - level;
        const Range slices = this->RangeOf(level, 2);
        if (k >= slices.Begin && k < slices.End)
        {
          this->MakeSlice(level, k);
        }
      }
    }
  }

private:
  // Indices that are needed after `level` iterations, so that the box is right after the last.
  Range RangeOf(int level, int axis) const
  {
    const int margin = this->Last - level;
    return { std::max(0, this->Box.Begin[axis] - margin),
      std::min(this->Size[axis], this->Box.End[axis] + margin) };
  }

  std::ptrdiff_t Place(int i, int j) const
  {
    return (j - this->RangeOf(0, 1).Begin + 1) * this->Row + (i - this->RangeOf(0, 0).Begin + 1);
  }

  // Of a slice in memory, the pointer to what would be its voxel (0, j). Beyond the image in z, the
  // slice next to it.
  float* RowAt(int level, int i, int j, int k)
  {
    const int inside = std::clamp(k, 0, this->Size[2] - 1);
    return this->Voxels.data() + (3 * level + inside % 3) * this->Slice + this->Place(i, j);
  }

  float* Target(int level, int i, int j, int k)
  {
    return level < this->Last
      ? this->RowAt(level, i, j, k)
      : this->Out + i + this->Size[0] * (j + static_cast<std::ptrdiff_t>(this->Size[1]) * k);
  }

  void MakeSlice(int level, int k)
  {
    const Range columns = this->RangeOf(level, 0);
    const Range rows = this->RangeOf(level, 1);
    if (level == 0)
    {
      for (int j = rows.Begin; j < rows.End; ++j)
      {
        this->Read(columns.Begin, columns.End, j, k, this->Target(0, columns.Begin, j, k));
      }
    }
    else
    {
      this->StepSlice(level, k, columns, rows);
    }
    if (level < this->Last)
    {
      this->RepeatRim(level, k, columns, rows);
    }
  }

  // The border repeats, which lets nothing flow out.
  void RepeatRim(int level, int k, const Range& columns, const Range& rows)
  {
    for (int j = rows.Begin; j < rows.End; ++j)
    {
      float* const row = this->RowAt(level, columns.Begin, j, k);
      row[-1] = row[0];
      row[columns.Size()] = row[columns.Size() - 1];
    }
    const int width = columns.Size() + 2;
    std::copy_n(this->RowAt(level, columns.Begin - 1, rows.Begin, k), width,
      this->RowAt(level, columns.Begin - 1, rows.Begin - 1, k));
    std::copy_n(this->RowAt(level, columns.Begin - 1, rows.End - 1, k), width,
      this->RowAt(level, columns.Begin - 1, rows.End, k));
  }

  // The neighbors along each axis.
  VoxelRows RowsAround(int level, int i, int j, int k)
  {
    const float* const voxels = this->RowAt(level, i, j, k);
    VoxelRows rows{};
    rows.Voxels = voxels;
    rows.Previous = { { voxels - 1, voxels - this->Row, this->RowAt(level, i, j, k - 1) } };
    rows.Next = { { voxels + 1, voxels + this->Row, this->RowAt(level, i, j, k + 1) } };
    return rows;
  }

  // The voxels of a row and their neighbors along the two axes other than `axis`.
  FaceRows::Side SideOf(int level, int axis, int i, int j, int k)
  {
    const VoxelRows rows = this->RowsAround(level, i, j, k);
    const auto [first, second] = OthersOf(axis);
    return { rows.Voxels, { { rows.Previous[first], rows.Previous[second] } },
      { { rows.Next[first], rows.Next[second] } } };
  }

  // Through the faces towards the end of the axis.
  void MakeFlux(int level, int axis, int i, int j, int k, int size, float* flux)
  {
    const FaceRows rows{ axis, OthersOf(axis), this->SideOf(level, axis, i, j, k),
      this->SideOf(level, axis, i + (axis == 0), j + (axis == 1), k + (axis == 2)) };
    this->Rows.Flux(rows, this->Coefficients, size, flux);
  }

  void StepSlice(int level, int k, const Range& columns, const Range& rows)
  {
    const int i = columns.Begin;
    const int size = columns.Size();
    const int from = level - 1;
    float* const sliceFlux = this->SliceFlux.data() + from * this->Slice;
    float* const alongRow = this->RowFlux.data();
    float* previousRow = alongRow + this->Row;
    float* nextRow = previousRow + this->Row;
    float* const nextSlice = nextRow + this->Row;
    if (k == this->RangeOf(level, 2).Begin)
    {
      for (int j = rows.Begin; j < rows.End; ++j)
      {
        this->MakeFlux(from, 2, i, j, k - 1, size, sliceFlux + this->Place(i, j));
      }
    }
    this->MakeFlux(from, 1, i, rows.Begin - 1, k, size, previousRow);
    for (int j = rows.Begin; j < rows.End; ++j)
    {
      float* const previousSlice = sliceFlux + this->Place(i, j);
      this->MakeFlux(from, 0, i - 1, j, k, size + 1, alongRow);
      this->MakeFlux(from, 1, i, j, k, size, nextRow);
      this->MakeFlux(from, 2, i, j, k, size, nextSlice);
      VoxelRows around = this->RowsAround(from, i, j, k);
      around.PreviousFlux = { { alongRow, previousRow, previousSlice } };
      around.NextFlux = { { alongRow + 1, nextRow, nextSlice } };
      this->Rows.Step(around, this->Coefficients, size, this->Target(level, i, j, k));
      std::swap(previousRow, nextRow);
      std::copy_n(nextSlice, size, previousSlice);
    }
  }

  const VoxelReader& Read;
  std::array<int, 3> Size;
  float* Out;
  int Last;
  DiffusionRows Rows;
  DiffusionCoefficients Coefficients;

  VoxelBox Box{};
  std::ptrdiff_t Row = 0;
  std::ptrdiff_t Slice = 0;
  std::vector<float> Voxels;    // by iteration, slice modulo three
  std::vector<float> SliceFlux; // by iteration, from the slice before
  std::vector<float> RowFlux;
};

// How many parts to do between two questions: equation and machine decide how long one takes. As
// many parts as there are threads take as long as one part, so that fewer would not be done sooner,
// but leave threads without work.
class Pace
{
public:
  explicit Pace(int threads)
    : Least(threads)
  {
    if (threads <= 0)
    {
      this->Least = std::max(1U, std::thread::hardware_concurrency());
    }
    this->Parts = this->Least;
  }

  std::ptrdiff_t PartsAtOnce() const { return this->Parts; }
  void Begin() { this->Began = Clock::now(); }
  void End()
  {
    const double seconds = std::chrono::duration<double>(Clock::now() - this->Began).count();
    if (seconds > Interval)
    {
      this->Parts = std::max(this->Least, this->Parts / 2);
    }
    else if (seconds < Interval / 2)
    {
      this->Parts *= 2;
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  std::ptrdiff_t Least;
  std::ptrdiff_t Parts = 0;
  Clock::time_point Began;
};

} // namespace

bool DiffuseBox(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const VoxelBox& box, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out)
{
  std::array<std::ptrdiff_t, 3> parts{};
  for (int axis = 0; axis < 3; ++axis)
  {
    parts[axis] = (box.Size(axis) + PartSize[axis] - 1) / PartSize[axis];
  }
  const std::ptrdiff_t count = parts[0] * parts[1] * parts[2];
  Pace pace(settings.Threads);
  for (std::ptrdiff_t begin = 0, end = 0; begin < count; begin = end)
  {
    if (!monitor(static_cast<double>(begin) / static_cast<double>(count)))
    {
      return false;
    }
    end = std::min(count, begin + pace.PartsAtOnce());
    pace.Begin();
    parallelFor(begin, end,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        Cascade cascade(read, geometry, settings, out);
        for (std::ptrdiff_t part = first; part < last; ++part)
        {
          const std::array<std::ptrdiff_t, 3> place{ { part % parts[0], part / parts[0] % parts[1],
            part / parts[0] / parts[1] } };
          VoxelBox cut;
          for (int axis = 0; axis < 3; ++axis)
          {
            const auto border = [&](std::ptrdiff_t at)
            { return box.Begin[axis] + static_cast<int>(box.Size(axis) * at / parts[axis]); };
            cut.Begin[axis] = border(place[axis]);
            cut.End[axis] = border(place[axis] + 1);
          }
          cascade.Run(cut);
        }
      });
    pace.End();
  }
  return true;
}

bool DiffuseAnisotropically(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out)
{
  const int passes =
    std::max(1, (settings.Iterations + DiffusionIterationsAtOnce - 1) / DiffusionIterationsAtOnce);
  std::vector<float> other(passes > 1 ? geometry.NumberOfVoxels() : 0);
  // From one to the other and back, so that the last pass ends in `out`.
  float* to = passes % 2 == 1 ? out : other.data();
  VoxelReader from = read;
  for (int pass = 0; pass < passes; ++pass)
  {
    AnisotropicDiffusionSettings now = settings;
    now.Iterations =
      (pass + 1) * settings.Iterations / passes - pass * settings.Iterations / passes;
    if (!DiffuseBox(from, geometry, now, { { { 0, 0, 0 } }, geometry.Dimensions }, parallelFor,
          PartOf(monitor, 1.0 * pass / passes, (pass + 1.0) / passes), to))
    {
      return false;
    }
    from = ReaderOf(ImageView<float>{ to, geometry });
    to = to == out ? other.data() : out;
  }
  return true;
}

double ContrastOfNoise(double noiseStandardDeviation, const ImageGeometry& geometry,
  DiffusionEquation equation)
{
  // Differences of neighbors scatter by sqrt(2) of the noise; twice that is an edge. An image
  // without noise has nothing to smooth.
  constexpr double factor = 2;
  const double difference = std::max(1e-3, factor * std::sqrt(2.0) * noiseStandardDeviation);
  if (equation == DiffusionEquation::Faces)
  {
    return difference;
  }
  // So do gradients, by differences over two voxels; ITK takes those of the whole image.
  const double least = 1e-3 / geometry.Spacing.minCoeff();
  return std::max(least,
    factor * noiseStandardDeviation *
      std::sqrt(0.5 * geometry.Spacing.array().square().inverse().sum()));
}

} // namespace FlipFree
