#include "Image/AnisotropicDiffusion.h"

#include "Image/DiffusionRows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <vector>

namespace FlipFree
{
namespace
{

// Largest part of the image that is processed at once: a few of its slices per iteration fit into a
// core's second-level cache. The margins around parts are computed twice.
constexpr std::array<int, 3> PartSize{ { 320, 32, 64 } };
// A part takes some milliseconds. The monitor is asked after this many per thread.
constexpr std::ptrdiff_t PartsPerThread = 4;

DiffusionCoefficients CoefficientsOf(double contrast, const Eigen::Vector3d& spacing)
{
  DiffusionCoefficients result{};
  // The step is chosen in units of the finest spacing; coarser axes diffuse less.
  const Eigen::Vector3d rates = (spacing.minCoeff() / spacing.array()).square();
  const double step = 1 / (2 * rates.sum() + 1e-9);
  for (int axis = 0; axis < 3; ++axis)
  {
    result.Weight[axis] = static_cast<float>(step * rates[axis]);
  }
  // Finite, so that nothing flows between equal values, however small the contrast.
  result.Fall = static_cast<float>(std::min(1 / (contrast * contrast), 1e38));
  return result;
}

struct Range
{
  int Begin;
  int End;

  int Size() const { return this->End - this->Begin; }
};

// The working memory of one thread: the last three slices of a part and its margin after each
// iteration.
class Cascade
{
public:
  Cascade(const VoxelReader& read, const ImageGeometry& geometry,
    const AnisotropicDiffusionSettings& settings, float* out)
    : Read(read)
    , Size(geometry.Dimensions)
    , Out(out)
    , Last(settings.Iterations)
    , Rows(ChooseDiffusionRows())
    , Coefficients(CoefficientsOf(settings.Contrast, geometry.Spacing))
  {
  }

  void Run(const VoxelBox& box)
  {
    this->Box = box;
    // One more place on each side, for what RepeatRim() adds.
    this->Row = this->RangeOf(0, 0).Size() + 2;
    this->Slice = this->Row * (this->RangeOf(0, 1).Size() + 2);
    this->Voxels.resize(3 * this->Slice * std::max(1, this->Last));
    this->SliceFlux.resize(this->Slice * this->Last);
    this->RowFlux.resize(4 * this->Row);

    // Each iteration runs one slice behind the one before.
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
  // The indices that are needed after `level` iterations for the box to be right after the last.
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

  // The voxel (i, j) of a slice in memory. Beyond the image in z: of the image's outermost slice.
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

  // Repeats the outermost voxels in plane, so that nothing flows across the image's border.
  void RepeatRim(int level, int k, const Range& columns, const Range& rows)
  {
    for (int j = rows.Begin; j < rows.End; ++j)
    {
      float* const row = this->RowAt(level, columns.Begin, j, k);
      row[-1] = row[0];
      row[columns.Size()] = row[columns.Size() - 1];
    }
    std::copy_n(this->RowAt(level, columns.Begin, rows.Begin, k), columns.Size(),
      this->RowAt(level, columns.Begin, rows.Begin - 1, k));
    std::copy_n(this->RowAt(level, columns.Begin, rows.End - 1, k), columns.Size(),
      this->RowAt(level, columns.Begin, rows.End, k));
  }

  void StepSlice(int level, int k, const Range& columns, const Range& rows)
  {
    const int size = columns.Size();
    const auto voxels = [&](int j, int slice)
    { return this->RowAt(level - 1, columns.Begin, j, slice); };
    const auto fluxBetween = [&](const float* near, const float* far, int faces, float* flux)
    { this->Rows.Flux(near, far, this->Coefficients, faces, flux); };
    const auto sliceFlux = [&](int j)
    { return this->SliceFlux.data() + (level - 1) * this->Slice + this->Place(columns.Begin, j); };

    float* const alongRow = this->RowFlux.data();
    float* previousRow = alongRow + this->Row;
    float* nextRow = previousRow + this->Row;
    float* const nextSlice = nextRow + this->Row;
    if (k == this->RangeOf(level, 2).Begin)
    {
      for (int j = rows.Begin; j < rows.End; ++j)
      {
        fluxBetween(voxels(j, k - 1), voxels(j, k), size, sliceFlux(j));
      }
    }
    fluxBetween(voxels(rows.Begin - 1, k), voxels(rows.Begin, k), size, previousRow);
    for (int j = rows.Begin; j < rows.End; ++j)
    {
      const float* const row = voxels(j, k);
      float* const previousSlice = sliceFlux(j);
      fluxBetween(row - 1, row, size + 1, alongRow);
      fluxBetween(row, voxels(j + 1, k), size, nextRow);
      fluxBetween(row, voxels(j, k + 1), size, nextSlice);
      this->Rows.Step(row, { { alongRow, previousRow, previousSlice } },
        { { alongRow + 1, nextRow, nextSlice } }, this->Coefficients, size,
        this->Target(level, columns.Begin, j, k));
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

// One of `count` parts of [begin, end), of equal sizes but for one.
Range PartOfRange(int begin, int end, std::ptrdiff_t part, std::ptrdiff_t count)
{
  const auto border = [&](std::ptrdiff_t at)
  { return begin + static_cast<int>((end - begin) * at / count); };
  return { border(part), border(part + 1) };
}

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
  const auto cutOut = [&](std::ptrdiff_t part)
  {
    const std::array<std::ptrdiff_t, 3> place{ { part % parts[0], part / parts[0] % parts[1],
      part / parts[0] / parts[1] } };
    VoxelBox cut;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Range range = PartOfRange(box.Begin[axis], box.End[axis], place[axis], parts[axis]);
      cut.Begin[axis] = range.Begin;
      cut.End[axis] = range.End;
    }
    return cut;
  };
  const std::ptrdiff_t count = parts[0] * parts[1] * parts[2];
  const std::ptrdiff_t threads =
    settings.Threads > 0 ? settings.Threads : std::max(1U, std::thread::hardware_concurrency());
  const std::ptrdiff_t atOnce = PartsPerThread * threads;
  for (std::ptrdiff_t begin = 0; begin < count; begin += atOnce)
  {
    if (!monitor(static_cast<double>(begin) / static_cast<double>(count)))
    {
      return false;
    }
    parallelFor(begin, std::min(count, begin + atOnce),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        Cascade cascade(read, geometry, settings, out);
        for (std::ptrdiff_t part = first; part < last; ++part)
        {
          cascade.Run(cutOut(part));
        }
      });
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
  // The passes alternate between the two buffers; the last one ends in `out`.
  float* to = passes % 2 == 1 ? out : other.data();
  VoxelReader from = read;
  for (int pass = 0; pass < passes; ++pass)
  {
    AnisotropicDiffusionSettings now = settings;
    now.Iterations =
      (pass + 1) * settings.Iterations / passes - pass * settings.Iterations / passes;
    if (!DiffuseBox(from, geometry, now, WholeBox(geometry), parallelFor,
          PartOf(monitor, 1.0 * pass / passes, (pass + 1.0) / passes), to))
    {
      return false;
    }
    from = ReaderOf(ImageView<float>{ to, geometry });
    to = to == out ? other.data() : out;
  }
  return true;
}

double ContrastOfNoise(double noiseStandardDeviation)
{
  // Differences of neighbors scatter by sqrt(2) of the noise; twice that is an edge.
  return 2 * std::sqrt(2.0) * noiseStandardDeviation;
}

} // namespace FlipFree
