/**
 * The pixels of a DICOM file: how they are stored, which gray values they mean, and how the bytes
 * of a frame become voxels.
 *
 * Native pixels are read from their place in the file. So are run-length encoded ones (RLE
 * Lossless, PS3.5 annex G). Those of other compressed transfer syntaxes (JPEG, JPEG-LS, JPEG 2000)
 * are decoded by a library, which gets to see nothing of the file but a clean one made here
 * (MinimalDicomFile), and returns them as if they were native.
 */
#ifndef FlipFreeDicomPixels_h
#define FlipFreeDicomPixels_h

#include "Exchange/DicomDataSet.h"
#include "Exchange/VoxelType.h"

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace FlipFree
{

/// How a pixel lies in its 8, 16 or 32 bits.
struct DicomPixelFormat
{
  int Columns = 0;
  int Rows = 0;
  int BitsAllocated = 0;
  int BitsStored = 0;
  int HighBit = 0;
  bool IsSigned = false;

  std::size_t NumberOfPixels() const
  {
    return static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->Rows);
  }
  std::size_t BytesPerFrame() const
  {
    return this->NumberOfPixels() * static_cast<std::size_t>(this->BitsAllocated) / 8;
  }
};

/// The gray value of a pixel is the stored value times `Slope`, plus `Intercept`.
struct DicomRescale
{
  double Slope = 1;
  double Intercept = 0;

  bool operator==(const DicomRescale& other) const
  {
    return this->Slope == other.Slope && this->Intercept == other.Intercept;
  }
};

/// At least 1; no number counts as 1.
std::size_t NumberOfDicomFrames(const DicomDataSet& data);

/// Why the pixels are not gray values that can be read, such as colors; as the end of the sentence
/// "'file' ...". Empty where they are.
std::string WhyNotGray(const DicomDataSet& data);

/// Why there are fewer pixels than the file claims, or they are coded in no known way, as
/// DicomDataSet::Damage has it. Empty where they are all there.
std::string WhyPixelsAreIncomplete(const DicomDataSet& data);

/// Of a data set whose pixels are gray.
DicomPixelFormat PixelFormatOf(const DicomDataSet& data);

/// The gray values that the pixels of some frames can have.
class DicomValueRange
{
public:
  void Add(const DicomPixelFormat& format, const DicomRescale& rescale);

  /// The least integer type that holds them all, or a floating-point type where they are not whole.
  VoxelType Type() const;

private:
  double Least = 0;
  double Greatest = 0;
  bool AreWhole = true;
  bool ExceedFloat = false; ///< more digits than single precision has
};

/// Whether the pixels can be read by ReadStoredFrame().
bool IsReadDirectly(const DicomDataSet& data);

/// The stored bytes of a frame in little-endian order; empty where the stream does not have them.
std::string ReadStoredFrame(std::istream& file, const DicomDataSet& data, std::size_t frame);

/// All bytes in which the pixels of a frame are stored, whatever their coding: where those of two
/// frames are equal, so are the frames.
std::string ReadCodedFrame(std::istream& file, const DicomDataSet& data, std::size_t frame);

/// A DICOM file with the compressed pixels of all frames, and no more than their decoder needs.
/// Empty where a frame is not one of the file's size.
std::string MinimalDicomFile(std::istream& file, const DicomDataSet& data);

/// Whether decoded pixels have nothing in the bits above the stored ones but their sign: compressed
/// streams may have more bits than the file says, and then these must not be cut off.
bool HasOnlyStoredBits(const std::string& stored, const DicomPixelFormat& format);

/// Whether pixels have anything in the bits below the stored ones. There are such bits only where
/// HighBit is not BitsStored - 1. Older editions of the standard allow that, and then pixels begin
/// above them; but some programs write such a HighBit and store pixels in the lowest bits.
bool HasBitsBelowStoredOnes(const std::string& stored, const DicomPixelFormat& format);

/// Writes the gray values of a frame whose stored bytes are given into `voxels` of this type.
void ToVoxels(const char* stored, const DicomPixelFormat& format, const DicomRescale& rescale,
  VoxelType type, void* voxels);

} // namespace FlipFree

#endif
