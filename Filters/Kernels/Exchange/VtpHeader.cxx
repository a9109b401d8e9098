#include "Exchange/VtpHeader.h"

#include "Exchange/CheckedPolygons.h"
#include "Exchange/FileProblem.h"
#include "Exchange/PolygonFile.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

namespace FlipFree
{
namespace
{

/// The value of an attribute of a tag, or an empty text.
std::string XmlAttribute(const std::string& tag, const std::string& name)
{
  for (std::size_t at = tag.find(name); at != std::string::npos; at = tag.find(name, at + 1))
  {
    const std::size_t quote = tag.find_first_not_of(" \t\r\n=", at + name.size());
    const bool isName = std::isspace(static_cast<unsigned char>(tag[at - 1])) != 0;
    if (isName && quote != std::string::npos && (tag[quote] == '"' || tag[quote] == '\''))
    {
      return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
    }
  }
  return {};
}

/// The next tag with this name, with its brackets; moves `at` past it.
std::string NextXmlTag(const std::string& bytes, const std::string& name, std::size_t& at)
{
  const std::size_t begin = bytes.find("<" + name, at);
  if (begin == std::string::npos)
  {
    at = begin;
    return {};
  }
  at = std::min(bytes.find('>', begin), bytes.size() - 1) + 1;
  return bytes.substr(begin, at - begin);
}

/// The bytes encoded in base64 at a place, no more than `most` of them.
std::string BytesOfBase64(const std::string& bytes, std::size_t at, std::size_t most)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string plain;
  std::uint32_t bits = 0;
  int count = 0;
  for (at = bytes.find_first_not_of(" \t\r\n", at); at < bytes.size() && plain.size() < most; ++at)
  {
    const std::size_t digit = digits.find(bytes[at]);
    if (digit == std::string::npos)
    {
      break;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      plain += static_cast<char>(bits >> count & 0xFF);
    }
  }
  return plain;
}

class VtpFile
{
public:
  explicit VtpFile(const std::string& bytes)
    : Bytes(bytes)
  {
    std::size_t at = 0;
    const std::string tag = NextXmlTag(this->Bytes, "VTKFile", at);
    this->IsPacked = !XmlAttribute(tag, "compressor").empty();
    this->WordSize = XmlAttribute(tag, "header_type") == "UInt64" ? 8 : 4;
    this->IsBigEndian = XmlAttribute(tag, "byte_order") == "BigEndian";
  }

  void Validate() const
  {
    std::size_t at = 0;
    const std::string appended = NextXmlTag(this->Bytes, "AppendedData", at);
    const bool isRaw = XmlAttribute(appended, "encoding") == "raw";
    // Behind a mark. Where others stand before it, VTK's reader looks for it elsewhere.
    std::size_t begin = this->Bytes.find_first_not_of(" \t\r\n", at);
    begin = begin != std::string::npos && this->Bytes[begin] == '_' ? begin : std::string::npos;
    at = 0;
    for (std::string tag = NextXmlTag(this->Bytes, "Piece", at); !tag.empty();
         tag = NextXmlTag(this->Bytes, "Piece", at))
    {
      for (const char* const what : { "Points", "Verts", "Lines", "Strips", "Polys" })
      {
        this->RequireRoom(
          std::strtod(XmlAttribute(tag, std::string("NumberOf") + what).c_str(), nullptr));
      }
    }
    for (const char* const kind : { "DataArray", "Array" }) // of numbers, of texts
    {
      this->ValidateArrays(kind, begin, isRaw);
    }
  }

private:
  [[noreturn]] static void Refuse() { RefusePolygons("it cannot hold as much as its header says"); }

  void ValidateArrays(const std::string& kind, std::size_t begin, bool isRaw) const
  {
    std::size_t at = 0;
    for (std::string tag = NextXmlTag(this->Bytes, kind, at); !tag.empty();
         tag = NextXmlTag(this->Bytes, kind, at))
    {
      this->RequireRoom(std::strtod(XmlAttribute(tag, "NumberOfComponents").c_str(), nullptr));
      this->RequireRoom(std::strtod(XmlAttribute(tag, "NumberOfTuples").c_str(), nullptr));
      // VTK's reader goes by the offset, whatever the format is.
      const std::string place = XmlAttribute(tag, "offset");
      if (place.empty() && XmlAttribute(tag, "format") == "binary")
      {
        this->ValidateArray(at, false);
      }
      else if (!place.empty())
      {
        const double offset = std::strtod(place.c_str(), nullptr);
        if (begin == std::string::npos || !(offset >= 0) ||
          offset >= static_cast<double>(this->Bytes.size() - begin))
        {
          Refuse();
        }
        this->ValidateArray(begin + 1 + static_cast<std::size_t>(offset), isRaw);
      }
    }
  }

  /// None of VTK's compressors can exceed this ratio.
  void RequireRoom(double number) const
  {
    constexpr double greatestRatio = 10000;
    if (!(number >= 0) || number > greatestRatio * static_cast<double>(this->Bytes.size()))
    {
      Refuse();
    }
  }

  /// The numbers before an array: its bytes; or, packed, the number of blocks, the bytes of each
  /// but the last, those of the last if it is smaller, and those of each when packed.
  void ValidateArray(std::size_t at, bool isRaw) const
  {
    const auto room = static_cast<double>(this->Bytes.size() - std::min(at, this->Bytes.size()));
    const std::size_t leading = this->IsPacked ? 3 : 1;
    std::string words = this->Words(at, leading, isRaw);
    if (!this->IsPacked)
    {
      if (static_cast<double>(this->Word(words, 0)) > room)
      {
        Refuse();
      }
      return;
    }
    const auto blocks = static_cast<double>(this->Word(words, 0));
    const std::uint64_t size = this->Word(words, 1);
    const std::uint64_t last = this->Word(words, 2);
    if (blocks == 0 && last == 0) // an empty array
    {
      return;
    }
    this->RequireRoom(blocks * static_cast<double>(size));
    if (blocks == 0 || size == 0 || last > size || blocks * this->WordSize > room)
    {
      Refuse();
    }
    const auto count = static_cast<std::size_t>(blocks);
    words = this->Words(at, leading + count, isRaw);
    double packed = 0;
    for (std::size_t block = 0; block < count; ++block)
    {
      packed += static_cast<double>(this->Word(words, leading + block));
    }
    if (packed > room)
    {
      Refuse();
    }
  }

  std::string Words(std::size_t at, std::size_t count, bool isRaw) const
  {
    const std::size_t size = count * static_cast<std::size_t>(this->WordSize);
    std::string words = isRaw ? this->Bytes.substr(std::min(at, this->Bytes.size()), size)
                              : BytesOfBase64(this->Bytes, at, size);
    if (words.size() < size)
    {
      Refuse();
    }
    return words;
  }

  std::uint64_t Word(const std::string& words, std::size_t index) const
  {
    std::uint64_t value = 0;
    for (int byte = 0; byte < this->WordSize; ++byte)
    {
      const int place = this->IsBigEndian ? byte : this->WordSize - 1 - byte;
      value = value << 8 |
        static_cast<unsigned char>(words[index * static_cast<std::size_t>(this->WordSize) +
          static_cast<std::size_t>(place)]);
    }
    return value;
  }

  const std::string& Bytes;
  bool IsPacked = false;
  bool IsBigEndian = false;
  int WordSize = 4;
};

} // namespace

void ValidateVtp(const std::string& name, const std::string& bytes)
{
  try
  {
    VtpFile(bytes).Validate();
  }
  catch (const FileProblem& fault)
  {
    throw FileProblem(FileProblem::Kind::Unusable, DamagedSurface(name, fault.what()));
  }
}

} // namespace FlipFree
