/**
 * The volumes in a folder of DICOM files: which frames belong together, which one is meant, and
 * what is left out.
 *
 * Frames of a series that have one size and orientation make up a volume if they are an even stack.
 * Where they are not, they are taken apart by what they say of themselves (stack, time,
 * acquisition, echo, file and so on), and each part is a volume of its own: `UID#1`, `UID#2`. A few
 * slices beside many (scouts, pictures without a place) are left out, and so is a slice that is
 * there twice. What cannot be a volume stays in the list with the reason.
 */
#ifndef FlipFreeDicomVolumes_h
#define FlipFreeDicomVolumes_h

#include "Exchange/DicomFrame.h"
#include "Exchange/DicomStack.h"

#include <functional>
#include <string>
#include <vector>

namespace FlipFree
{

struct DicomFile
{
  std::string Name;
  /// Why it could not even be opened, or that it is empty: as DicomDataSet::Damage.
  std::string Unreadable;
  DicomDataSet Data;
};

struct DicomVolume
{
  std::string SeriesUID;
  std::size_t Number = 1; ///< among the volumes of its series
  std::size_t Count = 1;  ///< of these
  std::string SeriesNumber;
  std::string Description;
  std::string Modality;
  std::vector<DicomFrame> Frames; ///< in the order of their slices
  std::size_t DamagedFiles = 0;   ///< of its series
  ImageGeometry Geometry;
  VoxelType Type = VoxelType::Int16;
  std::string Problem; ///< for the user, where it cannot be read
  std::string Warning;

  /// What chooses it: the UID of its series, and #n where that has several.
  std::string Identifier() const;
};

/// Files that are no slice of a volume.
struct DicomLeftOut
{
  enum class Reason
  {
    Damaged,      ///< cut off or otherwise
    NoDicom,      ///< although its name says so
    NoPixels,     ///< reports, contours, spectra, maps of floating-point numbers, private objects
    NoGrayValues, ///< colors, or bits
    NoPlace,      ///< in the patient
    OtherGrid,    ///< scouts, and the like
    TheSame       ///< slices that are there twice
  };
  Reason Why = Reason::NoPixels;
  std::size_t File = 0;
  std::string SeriesUID;  ///< empty where it is not known
  std::string Difference; ///< of another grid, as GridDifference(); empty for a scout
};

struct DicomFolder
{
  std::string Name;
  std::vector<DicomFile> Files;
  std::vector<DicomVolume> Volumes; ///< the series with the greatest volume first
  std::vector<DicomLeftOut> LeftOut;
};

/// The bytes in which the pixels of a file's frame are stored (ReadCodedFrame()).
using DicomFrameBytes = std::function<std::string(const DicomFile& file, std::size_t frame)>;

/// Finds the volumes among the files of a folder. Asks for pixels only where slices may be the
/// same.
DicomFolder FindDicomVolumes(const std::string& name, std::vector<DicomFile> files,
  const DicomFrameBytes& bytesOf);

} // namespace FlipFree

#endif
