/**
 * Private to the module: volumes that are a folder of DICOM files.
 */
#ifndef FlipFreeDicomSeries_h
#define FlipFreeDicomSeries_h

#include "VolumeHeader.h"

#include <vector>

namespace FlipFree
{

/// One file of a series.
struct DicomSlice
{
  std::string File;
  VolumeHeader Header;
};

/// One series of a folder; the slices are in the order of their positions in space.
struct DicomSeries
{
  std::string UID;
  std::string Description;
  std::vector<DicomSlice> Slices;
  /// Why the series cannot be a volume, if one of its files told so: colors, several components.
  std::string Problem;
};

/// All series in a folder (not in the folders within it), the one with most files first. Files that
/// are not DICOM, or DICOM without an image, are skipped. Reads headers only; an empty list if
/// the monitor says stop.
std::vector<DicomSeries> ListDicomSeries(const std::string& folder, const Monitor& monitor);

/// The volume that the slices of a series make up, and a warning where they are not quite evenly
/// spaced. An ImageFileError where they do not make up one.
VolumeHeader HeaderOfSeries(const DicomSeries& series, std::string& warning);

/// Reads the voxels of all slices, one after the other. Where the monitor says stop, the rest is
/// left as it was.
void ReadSeriesVoxels(const DicomSeries& series, const VolumeHeader& header, void* voxels,
  const Monitor& monitor);

} // namespace FlipFree

#endif
