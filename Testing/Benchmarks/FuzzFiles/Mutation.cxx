#include "Mutation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace
{

std::size_t Below(std::size_t bound, std::mt19937_64& random)
{
  return bound == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
}

template <typename T>
std::string BytesOf(T value, bool reversed)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(&bytes[0], &value, sizeof(T));
  if (reversed)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

/// Numbers at which readers stumble, in either byte order.
std::string Number(std::mt19937_64& random)
{
  const bool reversed = Below(4, random) == 0;
  const std::int64_t integers[] = { 0, 1, -1, 2, 8, 255, 256, 348, 540, 32767, -32768, 65535,
    100000000, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN };
  const double reals[] = { 0, -1, 1e-40, 1e10, -1e20, 3e38,
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity(), 1e300 };
  const std::int64_t integer = integers[Below(std::size(integers), random)];
  const double real = reals[Below(std::size(reals), random)];
  switch (Below(5, random))
  {
    case 0:
      return BytesOf(static_cast<std::int16_t>(integer), reversed);
    case 1:
      return BytesOf(static_cast<std::int32_t>(integer), reversed);
    case 2:
      return BytesOf(integer, reversed);
    case 3:
      return BytesOf(static_cast<float>(std::abs(real) > 3e38 && std::isfinite(real) ? 3e38 : real),
        reversed);
    default:
      return BytesOf(real, reversed);
  }
}

const char* const Words[] = { "nan", "inf", "-inf", "-1", "0", "1", "2", "3", "4", "7", "16",
  "1e308", "-1e308", "1e-300", "99999999999999999999", "2147483647", "2147483648", "4294967295",
  "-2147483648", "65536", "1000000", "", "%s%s%n", "%d", "LIST", "LOCAL", "none", "true", "False",
  "/dev/zero", ".", "..", "gzip", "raw", "ascii", "hex", "bzip2", "double", "MET_OTHER", "(", ")",
  "(0,0,0)", "\"", "<", ">", "/>", "f", "list", "uchar", "vertex", "face", "\xff\xfe", "\t", "\r",
  "1/1/1", "1//1", "-1/-1", "endsolid", "end_header", "Float64", "Int64", "appended", "binary" };

std::string Word(std::mt19937_64& random)
{
  if (Below(20, random) == 0)
  {
    return std::string(Below(20000, random), static_cast<char>('0' + Below(40, random)));
  }
  return Words[Below(std::size(Words), random)];
}

/// Begins and ends of the words or lines of the text's first part.
std::vector<std::pair<std::size_t, std::size_t>> Pieces(const std::string& bytes, std::size_t end,
  const char* separators)
{
  std::vector<std::pair<std::size_t, std::size_t>> pieces;
  std::size_t begin = bytes.find_first_not_of(separators);
  while (begin < end)
  {
    const std::size_t after = std::min(bytes.find_first_of(separators, begin), bytes.size());
    pieces.emplace_back(begin, after);
    begin = bytes.find_first_not_of(separators, after);
  }
  return pieces;
}

void MutateText(std::string& bytes, std::size_t end, std::mt19937_64& random)
{
  const bool wholeLine = Below(3, random) == 0;
  const auto pieces = Pieces(bytes, end, wholeLine ? "\n" : " \t\n\r=:,\"()<>/");
  if (pieces.empty())
  {
    return;
  }
  const auto [begin, after] = pieces[Below(pieces.size(), random)];
  const auto [otherBegin, otherAfter] = pieces[Below(pieces.size(), random)];
  const std::string other = bytes.substr(otherBegin, otherAfter - otherBegin);
  switch (Below(5, random))
  {
    case 0:
      bytes.erase(begin, after - begin);
      break;
    case 1: // twice, or moved
      bytes.insert(begin, other + (wholeLine ? "\n" : " "));
      break;
    case 2:
      bytes.replace(begin, after - begin, other);
      break;
    default:
      bytes.replace(begin, after - begin, Word(random));
  }
}

void MutateBytes(std::string& bytes, std::size_t end, const std::string& other,
  std::mt19937_64& random)
{
  const std::size_t place = Below(end, random);
  const std::size_t length = 1 + Below(1U << Below(10, random), random);
  switch (Below(8, random))
  {
    case 0:
      bytes[place] = static_cast<char>(bytes[place] ^ 1 << Below(8, random));
      break;
    case 1:
      bytes[place] = static_cast<char>(Below(256, random));
      break;
    case 2:
    case 3:
    {
      const std::string number = Number(random);
      const std::size_t aligned = place / number.size() * number.size();
      bytes.replace(Below(2, random) ? aligned : place, number.size(), number);
      break;
    }
    case 4:
      bytes.erase(place, length);
      break;
    case 5:
      bytes.insert(place, bytes.substr(Below(bytes.size(), random), length));
      break;
    case 6:
      bytes.insert(place, other.substr(Below(other.size(), random), length));
      break;
    default:
      if (Below(3, random) == 0)
      {
        bytes.resize(place);
      }
      else
      {
        std::generate_n(bytes.begin() + static_cast<std::ptrdiff_t>(place),
          std::min(length, bytes.size() - place),
          [&random]() { return static_cast<char>(Below(256, random)); });
      }
  }
}

} // namespace

std::string Mutated(std::string bytes, std::size_t header, bool isText, const std::string& other,
  std::mt19937_64& random)
{
  const std::size_t damages = 1 + Below(4, random);
  for (std::size_t damage = 0; damage < damages && !bytes.empty(); ++damage)
  {
    const std::size_t end = Below(2, random) ? std::min(header, bytes.size()) : bytes.size();
    if (isText && Below(4, random) != 0)
    {
      MutateText(bytes, end, random);
    }
    else
    {
      MutateBytes(bytes, end, other, random);
    }
  }
  return bytes;
}
