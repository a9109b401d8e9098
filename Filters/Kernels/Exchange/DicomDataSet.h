/**
 * What one DICOM file says, as far as volumes need it, and where its pixels are (DICOM PS3.5 and
 * PS3.10). Files come as archives leave them: with or without preamble and file meta information,
 * with padding behind the pixels, or cut off. Nothing in a file makes this code fail: where it
 * cannot go on, it stops, and says why.
 */
#ifndef FlipFreeDicomDataSet_h
#define FlipFreeDicomDataSet_h

#include "Exchange/DicomAttributes.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace FlipFree
{

/// Files that claim more are damaged.
constexpr std::size_t MostDicomFrames = 100000;

/// A part of a file, in bytes.
struct DicomRange
{
  std::uint64_t Offset = 0;
  std::uint64_t Length = 0;
};

struct DicomDataSet
{
  bool IsDicom = false;
  /// Why the file could not be read to its pixels, or to its end if it has none; as the end of the
  /// sentence "... cannot be read: ". Empty where it could.
  std::string Damage;
  std::string MediaClass;     ///< the SOP class, as the file meta information tells it
  std::string TransferSyntax; ///< empty if the file does not tell
  bool IsBigEndian = false;   ///< the pixels, too
  /// Whether the rest of the file, from DeflatedOffset on, is packed (RFC 1951) and was not read.
  bool IsDeflated = false;
  std::uint64_t DeflatedOffset = 0;

  DicomAttributes Attributes;
  /// Of an enhanced image: what its frames have in common, and each by itself.
  DicomAttributes Shared;
  std::vector<DicomAttributes> Frames;

  bool HasModalityLut = false; ///< a table of gray values, which is not read
  bool HasPixels = false;
  bool HasFloatPixels = false; ///< instead: a map, not gray values
  bool IsEncapsulated = false;
  DicomRange Pixels; ///< not encapsulated
  /// Encapsulated: the first one holds the offsets of the frames, or nothing.
  std::vector<DicomRange> Fragments;

  /// The value for a frame: its own, that of all frames, or that of the file.
  const std::string& TextOf(std::uint32_t tag, std::size_t frame) const;
  std::vector<double> NumbersOf(std::uint32_t tag, std::size_t frame) const;

private:
  const DicomAttributes& Holder(std::uint32_t tag, std::size_t frame) const;
};

/// Reads what a file says; never throws because of what it is. A deflated file is read up to where
/// it is packed. Its reader unpacks the rest, appends it to the beginning, and passes both together
/// with `unpacked`.
DicomDataSet ReadDicomDataSet(std::istream& file, bool unpacked = false);

/// The SOP class: what kind of object the file holds; empty where it does not tell.
std::string ClassOf(const DicomDataSet& data);

} // namespace FlipFree

#endif
