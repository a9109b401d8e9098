#include "Exchange/DicomPixels.h"

#include "Exchange/DicomCodestream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace FlipFree
{
namespace
{

const char* const RLELossless = "1.2.840.10008.1.2.5";

bool IsNativeSyntax(const std::string& syntax)
{
  const char* const native[] = { "", "1.2.840.10008.1.2", "1.2.840.10008.1.2.1",
    "1.2.840.10008.1.2.1.99", "1.2.840.10008.1.2.2" };
  return std::find(std::begin(native), std::end(native), syntax) != std::end(native);
}

/// JPEG, JPEG-LS and JPEG 2000, with one frame after the other.
bool IsDecodedSyntax(const std::string& syntax)
{
  const std::string family = "1.2.840.10008.1.2.4.";
  if (syntax.compare(0, family.size(), family) != 0)
  {
    return false;
  }
  const char* const known[] = { "50", "51", "57", "70", "80", "81", "90", "91" };
  return std::find(std::begin(known), std::end(known), syntax.substr(family.size())) !=
    std::end(known);
}

std::uint32_t LittleEndianNumber(const std::string& bytes, std::size_t offset)
{
  std::uint32_t number = 0;
  for (int byte = 3; byte >= 0; --byte)
  {
    number =
      number << 8 | static_cast<unsigned char>(bytes[offset + static_cast<std::size_t>(byte)]);
  }
  return number;
}

/// Empty where the stream does not have them.
std::string BytesAt(std::istream& file, std::uint64_t offset, std::uint64_t length)
{
  std::string bytes(length, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(&bytes[0], static_cast<std::streamsize>(length));
  return file ? bytes : std::string();
}

/// Consecutive fragments of a file.
struct FragmentSpan
{
  const DicomRange* First = nullptr;
  const DicomRange* Last = nullptr; // behind the last one

  const DicomRange* begin() const { return this->First; }
  const DicomRange* end() const { return this->Last; }
};

/// The fragments of a frame; none where that is not to be told.
FragmentSpan FragmentsOf(std::istream& file, const DicomDataSet& data, std::size_t frame)
{
  if (data.Fragments.size() < 2)
  {
    return {};
  }
  const DicomRange* const begin = data.Fragments.data() + 1;
  const DicomRange* const end = data.Fragments.data() + data.Fragments.size();
  const std::size_t frames = NumberOfDicomFrames(data);
  if (frames == 1)
  {
    return { begin, end };
  }
  if (data.Fragments.size() == frames + 1)
  {
    return { begin + frame, begin + frame + 1 };
  }
  const DicomRange& table = data.Fragments.front();
  if (table.Length != 4 * static_cast<std::uint64_t>(frames))
  {
    return {};
  }
  // Offsets count from the first fragment's item, as fragments' own do from the first fragment.
  const bool isLast = frame + 1 == frames;
  const std::string offsets = BytesAt(file, table.Offset + 4 * frame, isLast ? 4 : 8);
  if (offsets.empty())
  {
    return {};
  }
  const auto from = [begin, end](std::uint64_t offset)
  {
    return std::lower_bound(begin, end, begin->Offset + offset,
      [](const DicomRange& fragment, std::uint64_t place) { return fragment.Offset < place; });
  };
  const DicomRange* const first = from(LittleEndianNumber(offsets, 0));
  const DicomRange* const last = isLast ? end : from(LittleEndianNumber(offsets, 4));
  return { first, std::max(first, last) };
}

/// The least number of bytes that so many pixels can be compressed to. A file that has fewer lies
/// about its size, and no memory must be taken by what it says.
std::uint64_t LeastCompressedSize(const std::string& syntax, const DicomPixelFormat& format,
  std::uint64_t frames)
{
  const std::uint64_t pixels = format.NumberOfPixels();
  if (syntax == RLELossless)
  {
    // A header for each frame; two bytes at least for 128 of a plane.
    return frames *
      (64 + static_cast<std::uint64_t>(format.BitsAllocated / 8) * 2 * ((pixels + 127) / 128));
  }
  const std::string process = syntax.substr(syntax.find_last_of('.') + 1);
  constexpr std::uint64_t lossless = 8; // one bit for each pixel
  constexpr std::uint64_t lossy = 256;  // two bits for each block of 64
  // In JPEG 2000, a blank slice takes about 140 bytes, whatever its size. One may be as large as
  // slices are.
  constexpr std::uint64_t others = 8192;
  constexpr std::uint64_t greatestBlank = 2048 * 2048;
  const bool isLossless = process == "57" || process == "70";
  const bool isLossy = process == "50" || process == "51";
  const std::uint64_t all = frames * pixels;
  return isLossless ? all / lossless
    : isLossy       ? all / lossy
                    : (all - std::min(all, greatestBlank)) / others;
}

bool HasEnoughPixels(const DicomDataSet& data, const DicomPixelFormat& format, std::uint64_t frames)
{
  if (!data.IsEncapsulated)
  {
    return data.Pixels.Length / format.BytesPerFrame() >= frames;
  }
  if (data.Fragments.size() < frames + 1)
  {
    return false;
  }
  std::uint64_t size = 0;
  for (auto fragment = data.Fragments.begin() + 1; fragment != data.Fragments.end(); ++fragment)
  {
    size += fragment->Length;
  }
  return size >= LeastCompressedSize(data.TransferSyntax, format, frames);
}

/// PackBits; false where it does not give all bytes of a plane. Bytes go to every `stride`-th
/// place.
bool UnpackRun(const std::string& packed, std::size_t begin, std::size_t end, std::size_t count,
  std::size_t stride, char* plane)
{
  std::size_t done = 0;
  while (begin < end && done < count)
  {
    const auto byte = static_cast<unsigned char>(packed[begin++]);
    const int control = byte < 128 ? byte : byte - 256;
    if (control == -128)
    {
      continue;
    }
    const bool isRun = control < 0;
    const auto length = static_cast<std::size_t>(isRun ? 1 - control : 1 + control);
    if ((isRun ? 1 : length) > end - begin || length > count - done)
    {
      return false;
    }
    for (std::size_t index = 0; index < length; ++index)
    {
      plane[stride * done++] = packed[begin + (isRun ? 0 : index)];
    }
    begin += isRun ? 1 : length;
  }
  return done == count;
}

/// Planes of bytes, the most significant first.
std::string UnpackRle(const std::string& packed, const DicomPixelFormat& format)
{
  constexpr std::size_t headerSize = 64;
  const auto planes = static_cast<std::size_t>(format.BitsAllocated / 8);
  if (packed.size() < headerSize || LittleEndianNumber(packed, 0) != planes)
  {
    return {};
  }
  std::string stored(format.BytesPerFrame(), '\0');
  for (std::size_t plane = 0; plane < planes; ++plane)
  {
    const std::size_t begin = LittleEndianNumber(packed, 4 * plane + 4);
    const std::size_t end =
      plane + 1 < planes ? LittleEndianNumber(packed, 4 * plane + 8) : packed.size();
    if (begin < headerSize || begin > end || end > packed.size() ||
      !UnpackRun(packed, begin, end, format.NumberOfPixels(), planes, &stored[planes - 1 - plane]))
    {
      return {};
    }
  }
  return stored;
}

void SwapBytes(std::string& stored, int bitsAllocated)
{
  const auto size = static_cast<std::size_t>(bitsAllocated / 8);
  for (std::size_t at = 0; at + size <= stored.size(); at += size)
  {
    std::reverse(stored.begin() + static_cast<std::ptrdiff_t>(at),
      stored.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
}

bool IsWhole(double number)
{
  constexpr double greatest = 1e15; // whole numbers are exact up to here, and sums of two
  return number == std::floor(number) && std::abs(number) < greatest;
}

/// Little-endian, explicit.
void AppendDicomElement(std::string& bytes, std::uint32_t tag, const std::string& type,
  std::string value)
{
  if (value.size() % 2 != 0)
  {
    value += type == "UI" ? '\0' : ' ';
  }
  const auto append = [&bytes](std::uint32_t number, int count)
  {
    for (int byte = 0; byte < count; ++byte)
    {
      bytes += static_cast<char>(number >> 8 * byte & 0xFF);
    }
  };
  append(tag >> 16, 2);
  append(tag & 0xFFFF, 2);
  bytes += type;
  append(static_cast<std::uint32_t>(value.size()), 2);
  bytes += value;
}

std::string TwoBytes(int number)
{
  return { static_cast<char>(number & 0xFF), static_cast<char>(number >> 8 & 0xFF) };
}

void AppendDicomItem(std::string& bytes, const std::string& content)
{
  bytes += std::string("\xFE\xFF\x00\xE0", 4);
  for (int byte = 0; byte < 4; ++byte)
  {
    bytes += static_cast<char>(content.size() >> 8 * byte & 0xFF);
  }
  bytes += content;
}

/// Whether a condition holds for the allocated bits of every pixel.
template <typename Condition>
bool AllCells(const std::string& stored, const DicomPixelFormat& format, const Condition& holds)
{
  const auto size = static_cast<std::size_t>(format.BitsAllocated / 8);
  for (std::size_t at = 0; at + size <= stored.size(); at += size)
  {
    std::uint64_t bits = 0;
    for (std::size_t byte = size; byte-- > 0;)
    {
      bits = bits << 8 | static_cast<unsigned char>(stored[at + byte]);
    }
    if (!holds(bits))
    {
      return false;
    }
  }
  return true;
}

template <typename Stored, typename Voxel>
void ConvertPixels(const char* stored, const DicomPixelFormat& format, const DicomRescale& rescale,
  Voxel* voxels)
{
  const std::size_t count = format.NumberOfPixels();
  const int shift = format.HighBit + 1 - format.BitsStored;
  const std::int64_t signBit = std::int64_t(1) << (format.BitsStored - 1);
  const std::int64_t mask = 2 * signBit - 1;
  for (std::size_t index = 0; index < count; ++index)
  {
    Stored bits = 0;
    for (std::size_t byte = 0; byte < sizeof(Stored); ++byte)
    {
      const auto part = static_cast<unsigned char>(stored[index * sizeof(Stored) + byte]);
      bits = static_cast<Stored>(bits | static_cast<Stored>(part) << 8 * byte);
    }
    std::int64_t value = static_cast<std::int64_t>(bits) >> shift & mask;
    if (format.IsSigned && (value & signBit))
    {
      value -= 2 * signBit;
    }
    voxels[index] =
      static_cast<Voxel>(static_cast<double>(value) * rescale.Slope + rescale.Intercept);
  }
}

template <typename Voxel>
void ConvertPixelsTo(const char* stored, const DicomPixelFormat& format,
  const DicomRescale& rescale, void* voxels)
{
  auto* const target = static_cast<Voxel*>(voxels);
  if (format.BitsAllocated == 8)
  {
    ConvertPixels<std::uint8_t>(stored, format, rescale, target);
  }
  else if (format.BitsAllocated == 16)
  {
    ConvertPixels<std::uint16_t>(stored, format, rescale, target);
  }
  else
  {
    ConvertPixels<std::uint32_t>(stored, format, rescale, target);
  }
}

struct TypeRange
{
  VoxelType Type;
  double Least;
  double Greatest;
};

constexpr TypeRange IntegerRanges[] = { { VoxelType::UInt8, 0, 255 },
  { VoxelType::Int8, -128, 127 }, { VoxelType::UInt16, 0, 65535 },
  { VoxelType::Int16, -32768, 32767 }, { VoxelType::UInt32, 0, 4294967295. },
  { VoxelType::Int32, -2147483648., 2147483647. } };

} // namespace

std::size_t NumberOfDicomFrames(const DicomDataSet& data)
{
  return static_cast<std::size_t>(
    data.Attributes.Integer(DicomTag::NumberOfFrames, 1, std::numeric_limits<int>::max(), 1));
}

std::string WhyNotGray(const DicomDataSet& data)
{
  const DicomAttributes& known = data.Attributes;
  const int samples = known.Integer(DicomTag::SamplesPerPixel, 0, 0xFFFF, 1);
  const std::string& colors = known.Text(DicomTag::PhotometricInterpretation);
  if (samples > 1 || (!colors.empty() && colors.compare(0, 10, "MONOCHROME") != 0))
  {
    return "holds colors or several values per pixel (" + std::to_string(samples) + " of " +
      (colors.empty() ? "unknown meaning" : colors) + "), not gray values";
  }
  const int bits = known.Integer(DicomTag::BitsAllocated, 0, 0xFFFF, 0);
  if (bits != 8 && bits != 16 && bits != 32)
  {
    return "has pixels of " + (bits == 0 ? std::string("unknown many") : std::to_string(bits)) +
      " bits (BitsAllocated), which are not gray values of 8, 16 or 32 bits";
  }
  return {};
}

std::string WhyPixelsAreIncomplete(const DicomDataSet& data)
{
  const DicomPixelFormat format = PixelFormatOf(data);
  if (format.NumberOfPixels() == 0)
  {
    return "it has no rows or columns";
  }
  const std::string& frames = data.Attributes.Text(DicomTag::NumberOfFrames);
  if (!frames.empty() && frames != "0" &&
    data.Attributes.Integer(DicomTag::NumberOfFrames, 1, std::numeric_limits<int>::max(), 0) == 0)
  {
    return "its NumberOfFrames is not a number of frames";
  }
  if (format.BitsStored < 1 || format.BitsStored > format.BitsAllocated ||
    format.HighBit < format.BitsStored - 1 || format.HighBit >= format.BitsAllocated)
  {
    return "its BitsStored and HighBit do not fit its BitsAllocated";
  }
  const bool isNative = IsNativeSyntax(data.TransferSyntax);
  if (data.IsEncapsulated == isNative ||
    !(isNative || data.TransferSyntax == RLELossless || IsDecodedSyntax(data.TransferSyntax)))
  {
    return "its pixels are coded in a way that is not supported (transfer syntax '" +
      data.TransferSyntax + "')";
  }
  const auto count = static_cast<std::uint64_t>(NumberOfDicomFrames(data));
  if (count > MostDicomFrames)
  {
    return "it claims to have " + std::to_string(count) + " frames";
  }
  if (!data.Frames.empty() && data.Frames.size() != count)
  {
    return "it describes " + std::to_string(data.Frames.size()) + " frames, but has " +
      std::to_string(count);
  }
  return HasEnoughPixels(data, format, count)
    ? ""
    : "it holds fewer pixels than its rows, columns and frames say";
}

DicomPixelFormat PixelFormatOf(const DicomDataSet& data)
{
  const DicomAttributes& known = data.Attributes;
  DicomPixelFormat format;
  format.Columns = known.Integer(DicomTag::Columns, 0, 0xFFFF, 0);
  format.Rows = known.Integer(DicomTag::Rows, 0, 0xFFFF, 0);
  format.BitsAllocated = known.Integer(DicomTag::BitsAllocated, 0, 0xFFFF, 0);
  // What is missing follows from the rest; what is no number is left out of bounds.
  const auto bits = [&known](std::uint32_t tag, int otherwise)
  { return known.Has(tag) ? known.Integer(tag, 0, 0xFFFF, -1) : otherwise; };
  format.BitsStored = bits(DicomTag::BitsStored, format.BitsAllocated);
  format.HighBit = bits(DicomTag::HighBit, format.BitsStored - 1);
  format.IsSigned = known.Integer(DicomTag::PixelRepresentation, 0, 1, 0) == 1;
  return format;
}

void DicomValueRange::Add(const DicomPixelFormat& format, const DicomRescale& rescale)
{
  constexpr int digitsOfFloat = 24;
  const double half = std::ldexp(1., format.BitsStored - 1);
  for (const double stored :
    { format.IsSigned ? -half : 0, format.IsSigned ? half - 1 : 2 * half - 1 })
  {
    const double value = stored * rescale.Slope + rescale.Intercept;
    this->Least = std::min(this->Least, value);
    this->Greatest = std::max(this->Greatest, value);
  }
  this->AreWhole = this->AreWhole && IsWhole(rescale.Slope) && IsWhole(rescale.Intercept);
  this->ExceedFloat = this->ExceedFloat || format.BitsStored > digitsOfFloat;
}

VoxelType DicomValueRange::Type() const
{
  for (const TypeRange& range : IntegerRanges)
  {
    if (this->AreWhole && this->Least >= range.Least && this->Greatest <= range.Greatest)
    {
      return range.Type;
    }
  }
  return this->AreWhole || this->ExceedFloat ? VoxelType::Float64 : VoxelType::Float32;
}

bool IsReadDirectly(const DicomDataSet& data)
{
  return !data.IsEncapsulated || data.TransferSyntax == RLELossless;
}

std::string ReadStoredFrame(std::istream& file, const DicomDataSet& data, std::size_t frame)
{
  const DicomPixelFormat format = PixelFormatOf(data);
  std::string bytes = ReadCodedFrame(file, data, frame);
  if (data.IsEncapsulated)
  {
    return UnpackRle(bytes, format);
  }
  if (data.IsBigEndian)
  {
    SwapBytes(bytes, format.BitsAllocated);
  }
  return bytes;
}

std::string ReadCodedFrame(std::istream& file, const DicomDataSet& data, std::size_t frame)
{
  if (!data.IsEncapsulated)
  {
    const std::uint64_t size = PixelFormatOf(data).BytesPerFrame();
    return BytesAt(file, data.Pixels.Offset + frame * size, size);
  }
  std::string bytes;
  for (const DicomRange& fragment : FragmentsOf(file, data, frame))
  {
    bytes += BytesAt(file, fragment.Offset, fragment.Length);
  }
  return bytes;
}

std::string MinimalDicomFile(std::istream& file, const DicomDataSet& data)
{
  const DicomPixelFormat format = PixelFormatOf(data);
  const std::string secondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
  const std::string instance = "1.2.826.0.1.3680043.2.1143.1"; // of no importance
  std::string meta;
  AppendDicomElement(meta, 0x00020002, "UI", secondaryCapture);
  AppendDicomElement(meta, 0x00020003, "UI", instance);
  AppendDicomElement(meta, DicomTag::TransferSyntaxUID, "UI", data.TransferSyntax);
  std::string bytes(128, '\0');
  bytes += "DICM";
  AppendDicomElement(bytes, 0x00020000, "UL",
    TwoBytes(static_cast<int>(meta.size())) + TwoBytes(0));
  bytes += meta;
  AppendDicomElement(bytes, DicomTag::SOPClassUID, "UI", secondaryCapture);
  AppendDicomElement(bytes, DicomTag::SOPInstanceUID, "UI", instance);
  AppendDicomElement(bytes, DicomTag::SamplesPerPixel, "US", TwoBytes(1));
  AppendDicomElement(bytes, DicomTag::PhotometricInterpretation, "CS", "MONOCHROME2");
  const std::size_t frames = NumberOfDicomFrames(data);
  AppendDicomElement(bytes, DicomTag::NumberOfFrames, "IS", std::to_string(frames));
  AppendDicomElement(bytes, DicomTag::Rows, "US", TwoBytes(format.Rows));
  AppendDicomElement(bytes, DicomTag::Columns, "US", TwoBytes(format.Columns));
  AppendDicomElement(bytes, DicomTag::BitsAllocated, "US", TwoBytes(format.BitsAllocated));
  AppendDicomElement(bytes, DicomTag::BitsStored, "US", TwoBytes(format.BitsStored));
  AppendDicomElement(bytes, DicomTag::HighBit, "US", TwoBytes(format.HighBit));
  AppendDicomElement(bytes, DicomTag::PixelRepresentation, "US", TwoBytes(format.IsSigned ? 1 : 0));
  bytes += std::string("\xE0\x7F\x10\x00OB\x00\x00\xFF\xFF\xFF\xFF", 12);
  AppendDicomItem(bytes, {});
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    // One fragment for each frame, so that no table of offsets is needed.
    std::string coded = ReadCodedFrame(file, data, frame);
    if (!IsCodestreamOf(coded, data.TransferSyntax, format))
    {
      return {};
    }
    coded.append(coded.size() % 2, '\0');
    AppendDicomItem(bytes, coded);
  }
  bytes += std::string("\xFE\xFF\xDD\xE0\x00\x00\x00\x00", 8);
  return bytes;
}

bool HasOnlyStoredBits(const std::string& stored, const DicomPixelFormat& format)
{
  const std::uint64_t beyond =
    (std::uint64_t(1) << format.BitsAllocated) - (std::uint64_t(1) << (format.HighBit + 1));
  const std::uint64_t signBit = std::uint64_t(1) << format.HighBit;
  return beyond == 0 ||
    AllCells(stored, format,
      [&](std::uint64_t bits)
      {
        const bool isNegative = format.IsSigned && (bits & signBit);
        return (bits & beyond) == 0 || (isNegative && (bits & beyond) == beyond);
      });
}

bool HasBitsBelowStoredOnes(const std::string& stored, const DicomPixelFormat& format)
{
  const std::uint64_t below = (std::uint64_t(1) << (format.HighBit + 1 - format.BitsStored)) - 1;
  return below != 0 &&
    !AllCells(stored, format, [below](std::uint64_t bits) { return (bits & below) == 0; });
}

void ToVoxels(const char* stored, const DicomPixelFormat& format, const DicomRescale& rescale,
  VoxelType type, void* voxels)
{
  WithVoxelType(type,
    [&](auto* value)
    { ConvertPixelsTo<std::remove_pointer_t<decltype(value)>>(stored, format, rescale, voxels); });
}

} // namespace FlipFree
