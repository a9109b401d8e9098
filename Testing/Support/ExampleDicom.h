/**
 * Small DICOM files, as bytes: slices and enhanced images, in the codings that archives use.
 */
#ifndef ExampleDicom_h
#define ExampleDicom_h

#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace ExampleDicom
{

enum class Coding
{
  Explicit,
  Implicit,
  BigEndian
};

/// A data set that grows element by element.
class DataSet
{
public:
  explicit DataSet(Coding coding = Coding::Explicit)
    : CodingOf(coding)
  {
  }

  /// Text is padded to an even length.
  DataSet& Add(std::uint32_t tag, const std::string& type, std::string value)
  {
    value += value.size() % 2 ? (type == "UI" ? std::string(1, '\0') : " ") : "";
    return this->AddHeader(tag, type, static_cast<std::uint32_t>(value.size())).AddBytes(value);
  }

  DataSet& AddShort(std::uint32_t tag, int number)
  {
    this->AddHeader(tag, "US", 2);
    this->Append(static_cast<std::uint32_t>(number), 2);
    return *this;
  }

  /// With items of known length, or delimited ones.
  DataSet& AddSequence(std::uint32_t tag, const std::vector<DataSet>& items,
    bool isDelimited = false)
  {
    DataSet content(this->CodingOf);
    for (const DataSet& item : items)
    {
      content.AddItem(0xFFFEE000,
        isDelimited ? 0xFFFFFFFF : static_cast<std::uint32_t>(item.Bytes.size()));
      content.Bytes += item.Bytes;
      if (isDelimited)
      {
        content.AddItem(0xFFFEE00D, 0);
      }
    }
    if (isDelimited)
    {
      content.AddItem(0xFFFEE0DD, 0);
    }
    return this
      ->AddHeader(tag, "SQ",
        isDelimited ? 0xFFFFFFFF : static_cast<std::uint32_t>(content.Bytes.size()))
      .AddBytes(content.Bytes);
  }

  /// Pixels in fragments, of which the first is the table of offsets.
  DataSet& AddFragments(const std::vector<std::string>& fragments)
  {
    this->AddHeader(0x7FE00010, "OB", 0xFFFFFFFF);
    for (const std::string& fragment : fragments)
    {
      this->AddItem(0xFFFEE000, static_cast<std::uint32_t>(fragment.size()));
      this->Bytes += fragment;
    }
    return this->AddItem(0xFFFEE0DD, 0);
  }

  DataSet& AddBytes(const std::string& bytes)
  {
    this->Bytes += bytes;
    return *this;
  }

  DataSet& AddHeader(std::uint32_t tag, const std::string& type, std::uint32_t length)
  {
    this->Append(tag >> 16, 2);
    this->Append(tag & 0xFFFF, 2);
    if (this->CodingOf == Coding::Implicit)
    {
      this->Append(length, 4);
      return *this;
    }
    this->Bytes += type;
    const bool isLong = type == "OB" || type == "OW" || type == "SQ" || type == "UN";
    if (isLong)
    {
      this->Append(0, 2);
    }
    this->Append(length, isLong ? 4 : 2);
    return *this;
  }

  std::string Bytes;

private:
  DataSet& AddItem(std::uint32_t tag, std::uint32_t length)
  {
    this->Append(tag >> 16, 2);
    this->Append(tag & 0xFFFF, 2);
    this->Append(length, 4);
    return *this;
  }

  void Append(std::uint32_t number, int count)
  {
    for (int byte = 0; byte < count; ++byte)
    {
      const int shift = 8 * (this->CodingOf == Coding::BigEndian ? count - 1 - byte : byte);
      this->Bytes += static_cast<char>(number >> shift & 0xFF);
    }
  }

  Coding CodingOf;
};

const char* const RootUID = "1.2.826.0.1.3680043.2.1143.78";

/// With preamble and file meta information.
inline std::string FileOf(const DataSet& data, const std::string& syntax = "1.2.840.10008.1.2.1")
{
  DataSet meta;
  meta.Add(0x00020001, "OB", std::string("\0\1", 2));
  meta.Add(0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2");
  meta.Add(0x00020003, "UI", std::string(RootUID) + ".1.1");
  meta.Add(0x00020010, "UI", syntax);
  DataSet length;
  length.AddHeader(0x00020000, "UL", 4);
  std::string size;
  for (int byte = 0; byte < 4; ++byte)
  {
    size += static_cast<char>(meta.Bytes.size() >> 8 * byte & 0xFF);
  }
  return std::string(128, '\0') + "DICM" + length.Bytes + size + meta.Bytes + data.Bytes;
}

/// What a slice or an enhanced image is like.
struct Options
{
  Coding How = Coding::Explicit;
  std::string Series = std::string(RootUID) + ".1";
  std::string Instance = std::string(RootUID) + ".1.1";
  std::string Class = "1.2.840.10008.5.1.4.1.1.2"; // CT
  std::string Modality = "CT";
  std::string Description = "Example";
  std::string ImageType = "ORIGINAL\\PRIMARY\\AXIAL";
  std::string Position = "0\\0\\0"; // of a slice; none if it is empty
  std::string Orientation = "1\\0\\0\\0\\1\\0";
  std::string Spacing = "2\\1"; // of rows, then of columns
  int Acquisition = 0;          // none
  int Columns = 4;
  int Rows = 3;
  int Allocated = 16;
  int Stored = 16;
  int HighBit = -1; // none
  int IsSigned = 1;
  int Samples = 1;
  std::string Colors = "MONOCHROME2";
  std::string Slope = "1";
  std::string Intercept = "0";
  std::string Frames;                 // NumberOfFrames; none if it is empty
  std::string Pixels;                 // of all frames
  std::vector<std::string> Fragments; // in place of these
};

/// Up to, not including, what places the slice.
inline DataSet Beginning(const Options& options)
{
  DataSet data(options.How);
  data.Add(0x00080008, "CS", options.ImageType);
  data.Add(0x00080016, "UI", options.Class);
  data.Add(0x00080018, "UI", options.Instance);
  data.Add(0x00080060, "CS", options.Modality);
  data.Add(0x0008103E, "LO", options.Description);
  data.Add(0x0020000D, "UI", RootUID);
  data.Add(0x0020000E, "UI", options.Series);
  data.Add(0x00200011, "IS", "3");
  if (options.Acquisition > 0)
  {
    data.Add(0x00200012, "IS", std::to_string(options.Acquisition));
  }
  return data;
}

inline void AddPixelDescription(const Options& options, DataSet& data)
{
  data.AddShort(0x00280002, options.Samples);
  data.Add(0x00280004, "CS", options.Colors);
  if (!options.Frames.empty())
  {
    data.Add(0x00280008, "IS", options.Frames);
  }
  data.AddShort(0x00280010, options.Rows);
  data.AddShort(0x00280011, options.Columns);
}

inline void AddPixels(const Options& options, DataSet& data)
{
  if (options.Fragments.empty())
  {
    data.Add(0x7FE00010, "OW", options.Pixels);
  }
  else
  {
    data.AddFragments(options.Fragments);
  }
}

inline void AddBits(const Options& options, DataSet& data)
{
  data.AddShort(0x00280100, options.Allocated);
  data.AddShort(0x00280101, options.Stored);
  if (options.HighBit >= 0)
  {
    data.AddShort(0x00280102, options.HighBit);
  }
  data.AddShort(0x00280103, options.IsSigned);
}

/// One slice without preamble.
inline DataSet Slice(const Options& options)
{
  DataSet data = Beginning(options);
  const auto add = [&data](std::uint32_t tag, const std::string& value)
  {
    if (!value.empty())
    {
      data.Add(tag, "DS", value);
    }
  };
  add(0x00200032, options.Position);
  add(0x00200037, options.Orientation);
  AddPixelDescription(options, data);
  add(0x00280030, options.Spacing);
  AddBits(options, data);
  add(0x00281052, options.Intercept);
  add(0x00281053, options.Slope);
  AddPixels(options, data);
  return data;
}

/// What an enhanced image says of a frame.
struct Frame
{
  std::string Position;
  std::string Stack = "1";
  int Time = 0; // none
  std::string Slope = {};
  std::string Intercept = {};
};

/// An enhanced image without preamble: its orientation and pixel spacing are those of all frames,
/// and so is the rescale unless frames have their own.
inline DataSet Enhanced(Options options, const std::vector<Frame>& frames, bool isDelimited = false)
{
  options.Frames = std::to_string(frames.size());
  options.Class = "1.2.840.10008.5.1.4.1.1.2.1";
  DataSet data = Beginning(options);
  AddPixelDescription(options, data);
  AddBits(options, data);
  const Coding how = options.How;
  const auto rescale = [how](const std::string& slope, const std::string& intercept)
  { return DataSet(how).Add(0x00281052, "DS", intercept).Add(0x00281053, "DS", slope); };
  DataSet shared(how);
  shared.AddSequence(0x00209116, { DataSet(how).Add(0x00200037, "DS", options.Orientation) },
    isDelimited);
  shared.AddSequence(0x00289110, { DataSet(how).Add(0x00280030, "DS", options.Spacing) },
    isDelimited);
  shared.AddSequence(0x00289145, { rescale(options.Slope, options.Intercept) }, isDelimited);
  data.AddSequence(0x52009229, { shared }, isDelimited);
  std::vector<DataSet> items;
  for (const Frame& frame : frames)
  {
    DataSet content(how);
    content.Add(0x00209056, "SH", frame.Stack);
    if (frame.Time > 0)
    {
      content.AddHeader(0x00209128, "UL", 4);
      for (int byte = 0; byte < 4; ++byte)
      {
        const int place = how == Coding::BigEndian ? 3 - byte : byte;
        content.Bytes += static_cast<char>(frame.Time >> 8 * place & 0xFF);
      }
    }
    DataSet item(how);
    item.AddSequence(0x00209111, { content }, isDelimited);
    item.AddSequence(0x00209113, { DataSet(how).Add(0x00200032, "DS", frame.Position) },
      isDelimited);
    if (!frame.Slope.empty())
    {
      item.AddSequence(0x00289145, { rescale(frame.Slope, frame.Intercept) }, isDelimited);
    }
    items.push_back(item);
  }
  data.AddSequence(0x52009230, items, isDelimited);
  AddPixels(options, data);
  return data;
}

/// Two bytes each.
inline std::string Shorts(const std::vector<int>& values, bool bigEndian = false)
{
  std::string bytes;
  for (const int value : values)
  {
    const char low = static_cast<char>(value & 0xFF);
    const char high = static_cast<char>(value >> 8 & 0xFF);
    bytes += bigEndian ? std::string{ high, low } : std::string{ low, high };
  }
  return bytes;
}

} // namespace ExampleDicom

#endif
