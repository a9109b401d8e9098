#include "DicomCheck.h"

#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace FlipFree
{
namespace
{

constexpr std::uint32_t Undefined = 0xFFFFFFFF;
constexpr std::uint32_t Item = 0xFFFEE000;
constexpr std::uint32_t EndOfItem = 0xFFFEE00D;
constexpr std::uint32_t EndOfSequence = 0xFFFEE0DD;
constexpr std::uint32_t NumberOfFrames = 0x00280008;
constexpr std::uint32_t PixelData = 0x7FE00010;

struct Encoding
{
  bool ExplicitVR = true;
  bool BigEndian = false;
};

/// A data element's header; the file is positioned at its value.
struct Element
{
  std::uint32_t Tag = 0;
  std::uint32_t Length = 0;
  std::string Type; // its value representation; empty where that is implicit

  /// Such a sequence is coded implicitly, whatever surrounds it.
  bool IsUnknownSequence() const { return this->Type == "UN" && this->Length == Undefined; }
};

/// Reads numbers of either byte order; reading or skipping past the end of the file is an error.
class DicomFile
{
public:
  explicit DicomFile(const std::string& name)
    : Name(name)
    , File(name, std::ios::binary)
  {
    std::error_code ignored;
    this->Left = std::filesystem::file_size(name, ignored);
  }

  bool AtEnd() const { return this->Left == 0; }

  [[noreturn]] void Refuse(const std::string& why) const
  {
    throw ImageFileError(vtkErrorCode::PrematureEndOfFileError,
      "The DICOM file '" + this->Name + "' cannot be read: " + why +
        ". It is truncated or damaged. Download or copy its series again.");
  }

  std::string Text(std::uint32_t length)
  {
    std::string text(this->Take(length), '\0');
    this->File.read(&text[0], length);
    return text.substr(0, text.find_last_not_of(std::string(" \0", 2)) + 1);
  }

  void Skip(std::uint32_t length)
  {
    this->File.seekg(static_cast<std::streamoff>(this->Take(length)), std::ios::cur);
  }

  template <typename T>
  T Number(bool bigEndian)
  {
    unsigned char bytes[sizeof(T)] = {};
    this->Take(sizeof(T));
    this->File.read(reinterpret_cast<char*>(bytes), sizeof(T));
    if (!bigEndian)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    T value = 0;
    for (const unsigned char byte : bytes)
    {
      value = static_cast<T>(value << 8 | byte);
    }
    return value;
  }

  /// The group of the element that follows, in the byte order of the first group; -1 at the end.
  int NextGroup()
  {
    if (this->AtEnd())
    {
      return -1;
    }
    const std::uint64_t left = this->Left;
    const auto group = this->Number<std::uint16_t>(false);
    this->File.seekg(-2, std::ios::cur);
    this->Left = left;
    return group;
  }

  Element Next(const Encoding& encoding)
  {
    Element element;
    const bool big = encoding.BigEndian;
    element.Tag = static_cast<std::uint32_t>(this->Number<std::uint16_t>(big)) << 16;
    element.Tag |= this->Number<std::uint16_t>(big);
    if (element.Tag >> 16 == 0xFFFE || !encoding.ExplicitVR)
    {
      element.Length = this->Number<std::uint32_t>(big);
      return element;
    }
    char vr[2] = { 0, 0 };
    this->Take(2);
    this->File.read(vr, 2);
    element.Type.assign(vr, 2);
    const std::string shortTypes =
      "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US ";
    const std::string longTypes = "OB OD OF OL OV OW SQ SV UC UN UR UT UV ";
    if (shortTypes.find(element.Type + ' ') != std::string::npos)
    {
      element.Length = this->Number<std::uint16_t>(big);
      return element;
    }
    if (longTypes.find(element.Type + ' ') == std::string::npos)
    {
      this->Refuse("an element has no known type");
    }
    this->Skip(2);
    element.Length = this->Number<std::uint32_t>(big);
    return element;
  }

  /// Skips the value of an element.
  void SkipValue(const Element& element, const Encoding& encoding, int depth = 0)
  {
    if (element.Length != Undefined)
    {
      this->Skip(element.Length);
      return;
    }
    if (depth > 64)
    {
      this->Refuse("its sequences are nested without end");
    }
    const Encoding inner = element.IsUnknownSequence() ? Encoding{ false, false } : encoding;
    for (Element item = this->Next(inner); item.Tag != EndOfSequence; item = this->Next(inner))
    {
      if (item.Tag != Item)
      {
        this->Refuse("a sequence holds what is not an item");
      }
      if (item.Length != Undefined)
      {
        this->Skip(item.Length);
        continue;
      }
      for (Element part = this->Next(inner); part.Tag != EndOfItem; part = this->Next(inner))
      {
        this->SkipValue(part, inner, depth + 1);
      }
    }
  }

private:
  std::uint64_t Take(std::uint32_t length)
  {
    if (length > this->Left)
    {
      this->Refuse("it ends within an element");
    }
    this->Left -= length;
    return length;
  }

  std::string Name;
  std::ifstream File;
  std::uint64_t Left = 0;
};

/// By the class of the object, which stands near the beginning of the file.
bool IsKindWithoutPixels(const std::string& uid)
{
  const std::string storage = "1.2.840.10008.5.1.4.1.1.";
  if (uid == "1.2.840.10008.1.3.10") // DICOMDIR
  {
    return true;
  }
  const char* const kinds[] = { "9.", "11.", "66", "66.1", "66.3", "88.", "104.", "481.3", "481.4",
    "481.5", "481.6", "481.7", "481.8", "481.9" };
  return uid.compare(0, storage.size(), storage) == 0 &&
    std::any_of(std::begin(kinds), std::end(kinds),
      [rest = uid.substr(storage.size())](const std::string& kind)
      { return kind.back() == '.' ? rest.compare(0, kind.size(), kind) == 0 : rest == kind; });
}

/// The numbers that multiply to the number of bits of the pixels.
class PixelSize
{
public:
  /// Takes the element's value, if it is one of these.
  bool Take(DicomFile& file, const Element& element, const Encoding& encoding)
  {
    const auto factor = this->Factors.find(element.Tag);
    if (factor != this->Factors.end() && element.Length == 2)
    {
      factor->second = file.Number<std::uint16_t>(encoding.BigEndian);
      return true;
    }
    if (element.Tag == NumberOfFrames && element.Length < 20)
    {
      this->Frames = std::strtoul(file.Text(element.Length).c_str(), nullptr, 10);
      return true;
    }
    return false;
  }

  double Bytes() const
  {
    auto bits = static_cast<double>(this->Frames);
    for (const auto& factor : this->Factors)
    {
      bits *= static_cast<double>(factor.second);
    }
    return std::ceil(bits / 8);
  }

private:
  std::uint64_t Frames = 1;
  // Rows, columns, samples per pixel, bits per sample.
  std::map<std::uint32_t, std::uint64_t> Factors{ { 0x00280010, 0 }, { 0x00280011, 0 },
    { 0x00280002, 1 }, { 0x00280100, 0 } };
};

/// GDCM stops the program where an element that describes the image is of another type.
void RequireType(const DicomFile& file, const Element& element)
{
  static const std::map<std::uint32_t, std::string> types{ { 0x00180050, "DS" },
    { 0x00180088, "DS" }, { 0x00200013, "IS" }, { 0x00200032, "DS" }, { 0x00200037, "DS" },
    { 0x00280002, "US" }, { 0x00280004, "CS" }, { 0x00280006, "US" }, { 0x00280008, "IS" },
    { 0x00280010, "US" }, { 0x00280011, "US" }, { 0x00280030, "DS" }, { 0x00280034, "IS" },
    { 0x00280100, "US" }, { 0x00280101, "US" }, { 0x00280102, "US" }, { 0x00280103, "US" },
    { 0x00281052, "DS" }, { 0x00281053, "DS" } };
  const auto type = types.find(element.Tag);
  if (type != types.end() && !element.Type.empty() && element.Type != type->second &&
    element.Type != "UN")
  {
    file.Refuse("an element that describes the image has the type " + element.Type +
      " instead of " + type->second);
  }
}

/// Walks through the data set to its end; GDCM stops the program at items outside of sequences.
void RequirePixels(DicomFile& file, const Encoding& encoding)
{
  constexpr std::uint32_t groupOfItems = 0xFFFE;
  PixelSize size;
  bool hasPixels = false;
  while (!file.AtEnd())
  {
    const Element element = file.Next(encoding);
    if (element.Tag >> 16 == groupOfItems)
    {
      file.Refuse("an item stands outside of a sequence");
    }
    RequireType(file, element);
    if (!size.Take(file, element, encoding))
    {
      file.SkipValue(element, encoding);
    }
    if (element.Tag == PixelData && !hasPixels)
    {
      hasPixels = true;
      const double bytes = size.Bytes();
      if (bytes == 0 || (element.Length != Undefined && element.Length < bytes))
      {
        file.Refuse("it holds fewer pixels than its rows and columns say");
      }
    }
  }
  if (!hasPixels)
  {
    file.Refuse("it holds no pixels");
  }
}

} // namespace

bool HasDicomMark(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  char mark[4] = {};
  file.seekg(128).read(mark, sizeof(mark));
  return file && std::equal(mark, mark + 4, "DICM");
}

bool IsCompleteDicomImage(const std::string& name)
{
  DicomFile file(name);
  file.Skip(132);
  // The group that tells about the file is always coded alike.
  const Encoding ofGroup;
  std::string kind;
  std::string syntax;
  while (file.NextGroup() == 2)
  {
    const Element element = file.Next(ofGroup);
    if (element.Tag == 0x00020002)
    {
      kind = file.Text(element.Length);
    }
    else if (element.Tag == 0x00020010)
    {
      syntax = file.Text(element.Length);
    }
    else
    {
      file.SkipValue(element, ofGroup);
    }
  }
  if (syntax.empty())
  {
    file.Refuse("it does not tell how it is coded");
  }
  if (IsKindWithoutPixels(kind))
  {
    return false;
  }
  if (syntax == "1.2.840.10008.1.2.1.99")
  {
    return true; // deflated as a whole
  }
  RequirePixels(file, { syntax != "1.2.840.10008.1.2", syntax == "1.2.840.10008.1.2.2" });
  return true;
}

} // namespace FlipFree
