#include "Exchange/DicomDataSet.h"

#include "Exchange/DicomElements.h"
#include "Exchange/FileProblem.h"

#include <algorithm>
#include <new>

namespace FlipFree
{
namespace
{

constexpr std::uint32_t UndefinedLength = 0xFFFFFFFF;
constexpr std::uint32_t ItemTag = 0xFFFEE000;
constexpr std::uint32_t EndOfItem = 0xFFFEE00D;
constexpr std::uint32_t EndOfSequence = 0xFFFEE0DD;
constexpr std::uint32_t MediaStorageSOPClassUID = 0x00020002;
constexpr std::uint32_t FloatPixelData = 0x7FE00008;
constexpr std::uint32_t DoubleFloatPixelData = 0x7FE00009;
constexpr std::uint32_t PixelDataTag = 0x7FE00010;
constexpr std::uint32_t SharedGroups = 0x52009229;
constexpr std::uint32_t PerFrameGroups = 0x52009230;
constexpr std::uint32_t ModalityLutSequence = 0x00283000;
constexpr std::uint32_t DetectorInformation = 0x00540022; // of nuclear medicine
constexpr int DeepestSequence = 64;
constexpr std::uint32_t LongestValue = 1 << 20;
constexpr std::size_t MostFragments = 1 << 20; // far beyond one for each frame

const char* const ExplicitBigEndian = "1.2.840.10008.1.2.2";
const char* const DeflatedLittleEndian = "1.2.840.10008.1.2.1.99";

struct DicomCoding
{
  bool IsExplicit = true;
  bool IsBigEndian = false;
};

struct DicomElement
{
  std::uint32_t Tag = 0;
  std::uint32_t Length = 0;
  std::string Type; // empty where the coding is implicit
};

/// Thrown and caught here alone: what has been read stays.
[[noreturn]] void StopReading(const std::string& why)
{
  throw FileProblem(FileProblem::Kind::Incomplete, why);
}

/// Reads forward within bounds; every length is checked before it is used.
class DicomBytes
{
public:
  explicit DicomBytes(std::istream& file)
    : File(file)
  {
    file.clear();
    file.seekg(0, std::ios::end);
    const auto end = static_cast<std::streamoff>(file.tellg());
    this->End = end < 0 ? 0 : static_cast<std::uint64_t>(end);
    file.clear();
    file.seekg(0);
  }

  std::uint64_t Position() const { return this->At; }
  std::uint64_t Size() const { return this->End; }

  void MoveTo(std::uint64_t position)
  {
    this->At = position;
    this->File.clear();
    this->File.seekg(static_cast<std::streamoff>(position));
  }

  std::string Read(std::uint32_t length)
  {
    this->Require(length);
    std::string bytes(length, '\0');
    this->File.read(&bytes[0], length);
    if (!this->File)
    {
      StopReading("the disk or the network failed while it was read");
    }
    this->At += length;
    return bytes;
  }

  /// The bytes that follow, as many as there are up to `length`.
  std::string Peek(std::uint32_t length)
  {
    const std::uint64_t start = this->At;
    std::string bytes =
      this->Read(static_cast<std::uint32_t>(std::min<std::uint64_t>(length, this->End - this->At)));
    this->MoveTo(start);
    return bytes;
  }

  void Skip(std::uint32_t length)
  {
    this->Require(length);
    constexpr std::uint32_t few = 4096;
    if (length > few)
    {
      this->MoveTo(this->At + length);
      return;
    }
    this->File.ignore(length); // keeps what the stream has buffered
    this->At += length;
  }

  void Require(std::uint32_t length) const
  {
    if (length > this->End - this->At)
    {
      StopReading("it ends within an element");
    }
  }

private:
  std::istream& File;
  std::uint64_t At = 0;
  std::uint64_t End = 0;
};

class DicomParser
{
public:
  DicomParser(std::istream& file, DicomDataSet& data)
    : Bytes(file)
    , Data(data)
  {
  }

  void Run(bool unpacked)
  {
    this->Data.IsDicom = this->FindStart();
    this->ReadFileMetaInformation();
    this->Data.IsDicom = this->Data.IsDicom || !this->Data.TransferSyntax.empty();
    if (this->Data.TransferSyntax == DeflatedLittleEndian && !unpacked)
    {
      this->Data.IsDeflated = true;
      this->Data.DeflatedOffset = this->Bytes.Position();
      return;
    }
    DicomCoding coding;
    if (!this->GuessCoding(coding))
    {
      if (this->Data.IsDicom)
      {
        StopReading("no data set follows its header");
      }
      return;
    }
    this->Data.IsBigEndian = coding.IsBigEndian;
    try
    {
      this->ReadElements(this->Bytes.Size(), false, coding, &this->Data.Attributes, true, 0);
    }
    catch (const FileProblem&)
    {
      this->Recognize();
      throw;
    }
    this->Recognize();
  }

private:
  /// Moves behind the preamble, if there is one; whether the file is marked as DICOM.
  bool FindStart()
  {
    const std::string head = this->Bytes.Peek(132);
    if (head.size() == 132 && head.compare(128, 4, "DICM") == 0)
    {
      this->Bytes.MoveTo(132);
      return true;
    }
    if (head.compare(0, 4, "DICM") == 0)
    {
      this->Bytes.MoveTo(4);
      return true;
    }
    return false;
  }

  /// Group 2, which is always explicit and little-endian.
  void ReadFileMetaInformation()
  {
    const DicomCoding coding;
    for (std::string next = this->Bytes.Peek(6);
         next.size() == 6 && DicomNumberAt<std::uint16_t>(next, 0, false) == 2 &&
         (IsShortDicomType(next.substr(4)) || IsLongDicomType(next.substr(4)) ||
           this->Bytes.Position() > 128);
         next = this->Bytes.Peek(6))
    {
      const DicomElement element = this->Next(coding);
      const bool isClass = element.Tag == MediaStorageSOPClassUID;
      if ((element.Tag == DicomTag::TransferSyntaxUID || isClass) && element.Length <= LongestValue)
      {
        (isClass ? this->Data.MediaClass : this->Data.TransferSyntax) =
          WithoutDicomPadding(this->Bytes.Read(element.Length));
      }
      else
      {
        this->Bytes.Skip(element.Length);
      }
    }
  }

  /// By the first element: headers lie, or are missing.
  bool GuessCoding(DicomCoding& coding)
  {
    const std::string head = this->Bytes.Peek(8);
    if (head.size() < 8)
    {
      return false;
    }
    const std::string type = head.substr(4, 2);
    coding.IsExplicit = IsShortDicomType(type) || IsLongDicomType(type);
    const auto little = DicomNumberAt<std::uint16_t>(head, 0, false);
    const auto big = DicomNumberAt<std::uint16_t>(head, 0, true);
    coding.IsBigEndian = this->Data.TransferSyntax == ExplicitBigEndian ||
      (this->Data.TransferSyntax.empty() && coding.IsExplicit && big == 8 && little != 8);
    // Without a header, only what begins as images do is taken for one.
    return this->Data.IsDicom || (coding.IsBigEndian ? big : little) == 8;
  }

  /// A file without a mark is DICOM if it says what it is.
  void Recognize()
  {
    const DicomAttributes& known = this->Data.Attributes;
    this->Data.IsDicom = this->Data.IsDicom || known.Has(DicomTag::SOPClassUID) ||
      known.Has(DicomTag::SeriesInstanceUID) || this->Data.HasPixels;
  }

  DicomElement Next(const DicomCoding& coding)
  {
    const bool big = coding.IsBigEndian;
    const std::string head = this->Bytes.Read(8);
    DicomElement element;
    element.Tag = static_cast<std::uint32_t>(DicomNumberAt<std::uint16_t>(head, 0, big)) << 16;
    element.Tag |= DicomNumberAt<std::uint16_t>(head, 2, big);
    if (element.Tag >> 16 == 0xFFFE || !coding.IsExplicit)
    {
      element.Length = DicomNumberAt<std::uint32_t>(head, 4, big);
      return element;
    }
    element.Type = head.substr(4, 2);
    if (IsShortDicomType(element.Type))
    {
      element.Length = DicomNumberAt<std::uint16_t>(head, 6, big);
      return element;
    }
    if (!IsLongDicomType(element.Type))
    {
      StopReading("an element has no known type");
    }
    element.Length = DicomNumberAt<std::uint32_t>(this->Bytes.Read(4), 0, big);
    return element;
  }

  /// Up to `end`, or to the delimiter of the item. Elements that matter go `into` something, if
  /// their sequence matters.
  void ReadElements(std::uint64_t end, bool isDelimited, const DicomCoding& coding,
    DicomAttributes* into, bool isTop, int depth)
  {
    if (depth > DeepestSequence)
    {
      StopReading("its sequences are nested without end");
    }
    while (this->Bytes.Position() < end)
    {
      const DicomElement element = this->Next(coding);
      if (isDelimited && element.Tag == EndOfItem)
      {
        return;
      }
      if (element.Tag >> 16 == 0xFFFE)
      {
        StopReading("an item stands outside of a sequence");
      }
      const bool isFloat = element.Tag == FloatPixelData || element.Tag == DoubleFloatPixelData;
      if (isTop && (element.Tag == PixelDataTag || isFloat))
      {
        this->Data.HasFloatPixels = isFloat;
        if (!isFloat)
        {
          this->FindPixels(element, coding);
        }
        return; // what follows does not matter
      }
      this->ReadElement(element, end, coding, into, isTop, depth);
    }
    if (isDelimited || this->Bytes.Position() > end)
    {
      StopReading("it ends within a sequence");
    }
  }

  void ReadElement(const DicomElement& element, std::uint64_t end, const DicomCoding& coding,
    DicomAttributes* into, bool isTop, int depth)
  {
    // Compressed pixels of an icon, say, which matter as little as what surrounds them.
    const bool isPacked =
      element.Tag == PixelDataTag || element.Type == "OB" || element.Type == "OW";
    if (element.Length == UndefinedLength && isPacked)
    {
      this->ReadFragments(coding, nullptr);
      return;
    }
    this->Data.HasModalityLut = this->Data.HasModalityLut ||
      (isTop && element.Tag == ModalityLutSequence && element.Length > 0);
    const bool hasFrames = isTop && element.Tag == PerFrameGroups;
    DicomAttributes* target = nullptr;
    if (isTop && element.Tag == SharedGroups)
    {
      target = &this->Data.Shared;
    }
    else if (isTop ? element.Tag == DetectorInformation : IsFunctionalGroup(element.Tag))
    {
      target = into;
    }
    if (element.Length == UndefinedLength || target || hasFrames)
    {
      this->ReadSequence(element, end, coding, target, hasFrames, depth);
      return;
    }
    const char* const wanted = TypeOfWantedElement(element.Tag);
    if (!into || !wanted)
    {
      this->Bytes.Skip(element.Length);
      return;
    }
    if (element.Length > LongestValue)
    {
      StopReading("an element that describes the image is too long");
    }
    const bool isTyped = !element.Type.empty() && element.Type != "UN";
    into->Add(element.Tag,
      DicomValueText(this->Bytes.Read(element.Length), isTyped ? element.Type : wanted,
        coding.IsBigEndian));
  }

  void ReadSequence(const DicomElement& sequence, std::uint64_t limit, const DicomCoding& coding,
    DicomAttributes* target, bool hasFrames, int depth)
  {
    // What is of unknown type is implicit, whatever surrounds it.
    const DicomCoding inner = sequence.Type == "UN" ? DicomCoding{ false, false } : coding;
    const bool isOpen = sequence.Length == UndefinedLength;
    const std::uint64_t end = isOpen ? limit : this->EndOf(sequence.Length, limit);
    while (this->Bytes.Position() < end)
    {
      const DicomElement item = this->Next(inner);
      if (item.Tag == EndOfSequence)
      {
        return;
      }
      if (item.Tag != ItemTag)
      {
        StopReading("a sequence holds what is not an item");
      }
      if (hasFrames)
      {
        if (this->Data.Frames.size() == MostDicomFrames)
        {
          StopReading("it describes more than " + std::to_string(MostDicomFrames) + " frames");
        }
        this->Data.Frames.emplace_back();
        target = &this->Data.Frames.back();
      }
      const bool isDelimited = item.Length == UndefinedLength;
      this->ReadElements(isDelimited ? end : this->EndOf(item.Length, end), isDelimited, inner,
        target, false, depth + 1);
    }
    if (isOpen || this->Bytes.Position() > end)
    {
      StopReading("it ends within a sequence");
    }
  }

  std::uint64_t EndOf(std::uint32_t length, std::uint64_t limit) const
  {
    if (length > limit - std::min(limit, this->Bytes.Position()))
    {
      StopReading("it ends within a sequence");
    }
    return this->Bytes.Position() + length;
  }

  void FindPixels(const DicomElement& element, const DicomCoding& coding)
  {
    this->Data.HasPixels = true;
    if (element.Length != UndefinedLength)
    {
      this->Data.Pixels = { this->Bytes.Position(), element.Length };
      if (element.Length > this->Bytes.Size() - this->Bytes.Position())
      {
        StopReading("it ends within its pixels");
      }
      return;
    }
    this->Data.IsEncapsulated = true;
    this->ReadFragments(coding, &this->Data.Fragments);
  }

  /// Up to their delimiter. Adds where they are to `fragments`, if there is such a list.
  void ReadFragments(const DicomCoding& coding, std::vector<DicomRange>* fragments)
  {
    while (this->Bytes.Position() < this->Bytes.Size())
    {
      const DicomElement item = this->Next(coding);
      if (item.Tag == EndOfSequence)
      {
        return;
      }
      if (item.Tag != ItemTag || item.Length > this->Bytes.Size() - this->Bytes.Position())
      {
        break;
      }
      if (fragments && fragments->size() == MostFragments)
      {
        StopReading("its pixels are in more than " + std::to_string(MostFragments) + " parts");
      }
      if (fragments)
      {
        fragments->push_back({ this->Bytes.Position(), item.Length });
      }
      this->Bytes.Skip(item.Length);
    }
    StopReading("it ends within its pixels");
  }

  DicomBytes Bytes;
  DicomDataSet& Data;
};

} // namespace

const DicomAttributes& DicomDataSet::Holder(std::uint32_t tag, std::size_t frame) const
{
  if (frame < this->Frames.size() && this->Frames[frame].Has(tag))
  {
    return this->Frames[frame];
  }
  return this->Shared.Has(tag) ? this->Shared : this->Attributes;
}

const std::string& DicomDataSet::TextOf(std::uint32_t tag, std::size_t frame) const
{
  return this->Holder(tag, frame).Text(tag);
}

std::vector<double> DicomDataSet::NumbersOf(std::uint32_t tag, std::size_t frame) const
{
  return this->Holder(tag, frame).Numbers(tag);
}

DicomDataSet ReadDicomDataSet(std::istream& file, bool unpacked)
{
  DicomDataSet data;
  try
  {
    DicomParser(file, data).Run(unpacked);
  }
  catch (const FileProblem& damage)
  {
    data.Damage = damage.what();
  }
  catch (const std::bad_alloc&)
  {
    data.Damage = "there is not enough memory for what it says";
  }
  return data;
}

std::string ClassOf(const DicomDataSet& data)
{
  const std::string& own = data.Attributes.Text(DicomTag::SOPClassUID);
  return own.empty() ? data.MediaClass : own;
}

} // namespace FlipFree
