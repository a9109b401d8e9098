/**
 * Volumes and label maps in files, by their ending.
 */
#ifndef FlipFreeCommandVolumeFile_h
#define FlipFreeCommandVolumeFile_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace Command
{

/// Endings of the label maps that can be written.
const std::vector<std::string>& VolumeEndings();

/// Reads a volume from a file or a DICOM folder; of several series, the one of that UID, or the one
/// with most files.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name,
  const std::string& seriesUID = std::string());

void WriteVolume(const std::string& name, vtkImageData* image);

} // namespace Command

#endif
