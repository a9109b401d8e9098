/**
 * Reads and writes volumes and label maps; the ending of a file's name tells its format.
 */
#ifndef FlipFreeCommandVolumeFile_h
#define FlipFreeCommandVolumeFile_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace Command
{

/// The endings of label maps that can be written.
const std::vector<std::string>& VolumeEndings();

/// Reads a volume from a file or a DICOM folder; of several series, the one with the given UID, or
/// else the one with the most slices.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name,
  const std::string& seriesUID = std::string());

/// The DICOM series that a volume was read from, as ReadVolume() takes it; empty for other files.
std::string SeriesOf(vtkImageData* image);

/// What a summary calls a volume: the file, or the folder and the series in it.
std::string InputTitle(const std::string& name, const std::string& seriesUID);

void WriteVolume(const std::string& name, vtkImageData* image);

} // namespace Command

#endif
