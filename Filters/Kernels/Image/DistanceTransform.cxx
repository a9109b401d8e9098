#include "Image/DistanceTransform.h"

#include <algorithm>
#include <limits>

namespace FlipFree
{
namespace
{

constexpr float Far = 1e20f;

// Lower envelope of the parabolas f(q) + (step (x - q))^2 along one line of the grid.
class Envelope
{
public:
  explicit Envelope(int size)
    : Value(size)
    , Place(size)
    , Border(size + 1)
  {
  }

  // Sources stay at zero, and of those in a row only the ends reach beyond them. So lines are cut
  // there, which leaves little of a line that mostly consists of sources.
  void Transform(float* line, std::ptrdiff_t stride, int size, double step)
  {
    for (int begin = 0; begin < size; ++begin)
    {
      if (line[begin * stride] > 0)
      {
        int end = begin + 1;
        while (end < size && line[end * stride] > 0)
        {
          ++end;
        }
        this->TransformPart(line, stride, std::max(0, begin - 1), std::min(end + 1, size), step);
        begin = end;
      }
    }
  }

private:
  void TransformPart(float* line, std::ptrdiff_t stride, int begin, int end, double step)
  {
    const double square = step * step;
    int last = -1;
    for (int q = begin; q < end; ++q)
    {
      const double f = line[q * stride];
      if (f >= Far)
      {
        continue;
      }
      double border = -std::numeric_limits<double>::infinity();
      while (last >= 0)
      {
        const int p = this->Place[last];
        border = 0.5 * ((f - this->Value[last]) / (square * (q - p)) + (q + p));
        if (border > this->Border[last])
        {
          break;
        }
        --last;
      }
      ++last;
      this->Place[last] = q;
      this->Value[last] = f;
      this->Border[last] = last == 0 ? -std::numeric_limits<double>::infinity() : border;
    }
    if (last < 0)
    {
      return;
    }
    this->Border[last + 1] = std::numeric_limits<double>::infinity();
    int current = 0;
    for (int x = begin; x < end; ++x)
    {
      while (this->Border[current + 1] < x)
      {
        ++current;
      }
      const double offset = x - this->Place[current];
      line[x * stride] = static_cast<float>(this->Value[current] + square * offset * offset);
    }
  }

  std::vector<double> Value;
  std::vector<int> Place;
  std::vector<double> Border;
};

// The first axis needs no envelope, since all sources are at distance zero.
void NearestAlongRow(const unsigned char* mask, unsigned char target, float* row, int size,
  double step)
{
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size; ++i)
  {
    distance = mask[i] == target ? 0 : distance + step;
    row[i] = distance < 1e9 ? static_cast<float>(distance * distance) : Far;
  }
  distance = std::numeric_limits<double>::infinity();
  for (int i = size - 1; i >= 0; --i)
  {
    distance = mask[i] == target ? 0 : distance + step;
    const float square = distance < 1e9 ? static_cast<float>(distance * distance) : Far;
    row[i] = std::min(row[i], square);
  }
}

// `rowOf(j, k, buffer)` gives a row of the mask, a byte per voxel; the buffer has room for it.
template <typename RowOf>
std::vector<float> TransformRows(const RowOf& rowOf, const ImageGeometry& geometry,
  unsigned char target, const ParallelFor& parallelFor, const Monitor& monitor)
{
  if (!monitor(0))
  {
    return {};
  }
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t row = size[0];
  const std::ptrdiff_t slice = row * size[1];
  std::vector<float> result(geometry.NumberOfVoxels());
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      Envelope envelope(size[1]);
      std::vector<unsigned char> buffer(row);
      for (auto k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          const std::ptrdiff_t offset = k * slice + j * row;
          NearestAlongRow(rowOf(j, k, buffer), target, result.data() + offset, size[0],
            geometry.Spacing[0]);
        }
        for (int i = 0; i < size[0]; ++i)
        {
          envelope.Transform(result.data() + k * slice + i, row, size[1], geometry.Spacing[1]);
        }
      }
    });
  if (!monitor(0.5))
  {
    return {};
  }
  parallelFor(0, size[1],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      Envelope envelope(size[2]);
      for (std::ptrdiff_t j = first; j < last; ++j)
      {
        for (int i = 0; i < size[0]; ++i)
        {
          envelope.Transform(result.data() + j * row + i, slice, size[2], geometry.Spacing[2]);
        }
      }
    });
  return result;
}

} // namespace

std::vector<float> SquaredDistance(const std::vector<unsigned char>& mask,
  const ImageGeometry& geometry, unsigned char target, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  return TransformRows([&](int j, int k, std::vector<unsigned char>&)
    { return mask.data() + geometry.Offset(0, j, k); },
    geometry, target, parallelFor, monitor);
}

std::vector<float> SquaredDistance(const BitMask& mask, bool target, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  return TransformRows(
    [&](int j, int k, std::vector<unsigned char>& buffer)
    {
      const BitMask::Word* const words = mask.Row(j, k);
      for (std::size_t i = 0; i < buffer.size(); ++i)
      {
        buffer[i] = words[i / BitMask::BitsOfWord] >> (i % BitMask::BitsOfWord) & 1U;
      }
      return static_cast<const unsigned char*>(buffer.data());
    },
    mask.GetGeometry(), target ? 1 : 0, parallelFor, monitor);
}

} // namespace FlipFree
