#include "Exchange/VoxelDecoding.h"

#include "Exchange/ByteOrder.h"
#include "Exchange/HeaderField.h"
#include "TextWords.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace FlipFree
{
namespace
{

template <typename T>
void Scale(const VolumeFileHeader& header, T voxel, std::size_t index, void* values)
{
  const double value = header.Slope * static_cast<double>(voxel) + header.Intercept;
  if (header.ValueType() == VoxelType::Float32)
  {
    static_cast<float*>(values)[index] = static_cast<float>(value);
  }
  else
  {
    static_cast<double*>(values)[index] = value;
  }
}

template <typename T>
bool Fits(double number)
{
  return !std::is_integral<T>::value ||
    (number == std::floor(number) &&
      number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
      number < std::ldexp(1., std::numeric_limits<T>::digits));
}

[[noreturn]] void RefuseDigits(const VolumeFileHeader& header, const std::string& what)
{
  RefuseField(header.Name, "encoding", "is " + what);
}

void DecodeText(const VolumeFileHeader& header, const std::string& stored, void* values)
{
  constexpr std::size_t longestWord = 100;
  const std::size_t count = header.NumberOfStoredVoxels();
  const char* const space = " \t\r\n\f\v,";
  std::size_t begin = stored.find_first_not_of(space);
  for (std::size_t index = 0; index < count; ++index)
  {
    if (begin >= stored.size())
    {
      throw FileProblem(IncompleteVoxels(header.Name, Incompleteness::TooFewVoxels));
    }
    const std::size_t end = std::min(stored.find_first_of(space, begin), stored.size());
    double number = 0;
    if (end - begin > longestWord || !ToNumber(stored.substr(begin, end - begin), number))
    {
      RefuseDigits(header, "text, but the voxels are not numbers");
    }
    WithVoxelType(header.Storage.Type,
      [&](auto* type)
      {
        using T = std::remove_pointer_t<decltype(type)>;
        if (!Fits<T>(number))
        {
          RefuseDigits(header, "text, but the numbers do not fit the type of the voxels");
        }
        if (header.IsScaled())
        {
          Scale(header, static_cast<T>(number), index, values);
        }
        else
        {
          static_cast<T*>(values)[index] = static_cast<T>(number);
        }
      });
    begin = stored.find_first_not_of(space, end);
  }
}

int HexDigit(char letter)
{
  const char* const digits = "0123456789abcdef";
  const char small = letter >= 'A' && letter <= 'F' ? static_cast<char>(letter + 32) : letter;
  const char* const found = std::find(digits, digits + 16, small);
  return found == digits + 16 ? -1 : static_cast<int>(found - digits);
}

std::string BytesOfHex(const VolumeFileHeader& header, const std::string& stored)
{
  std::string bytes;
  int high = -1;
  for (const char letter : stored)
  {
    const int digit = HexDigit(letter);
    if (digit < 0 && !std::isspace(static_cast<unsigned char>(letter)))
    {
      RefuseDigits(header, "hex, but the voxels are not pairs of such digits");
    }
    if (digit >= 0 && high >= 0)
    {
      bytes.push_back(static_cast<char>(16 * high + digit));
      high = -1;
    }
    else if (digit >= 0)
    {
      high = digit;
    }
  }
  return bytes;
}

} // namespace

void DecodeVoxels(const VolumeFileHeader& header, const void* stored, std::size_t count,
  void* values)
{
  const std::size_t size = SizeOf(header.Storage.Type);
  const bool isReversed = size > 1 && header.Storage.IsBigEndian != MachineIsBigEndian();
  if (!isReversed && !header.IsScaled())
  {
    if (values != stored)
    {
      std::memcpy(values, stored, count * size);
    }
    return;
  }
  const auto* const bytes = static_cast<const char*>(stored);
  WithVoxelType(header.Storage.Type,
    [&](auto* type)
    {
      using T = std::remove_pointer_t<decltype(type)>;
      for (std::size_t index = 0; index < count; ++index)
      {
        const T voxel = NumberFrom<T>(bytes + index * size, header.Storage.IsBigEndian);
        if (header.IsScaled())
        {
          Scale(header, voxel, index, values);
        }
        else
        {
          static_cast<T*>(values)[index] = voxel;
        }
      }
    });
}

void DecodeDigits(const VolumeFileHeader& header, const std::string& stored, void* values)
{
  if (header.Storage.Form == VoxelStorage::Coding::Text)
  {
    DecodeText(header, stored, values);
    return;
  }
  const std::string bytes = BytesOfHex(header, stored);
  if (bytes.size() < header.NumberOfStoredBytes())
  {
    throw FileProblem(IncompleteVoxels(header.Name, Incompleteness::TooFewVoxels));
  }
  DecodeVoxels(header, bytes.data(), header.NumberOfStoredVoxels(), values);
}

} // namespace FlipFree
