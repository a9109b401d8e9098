/**
 * Reads and writes volumes and label maps; the ending of a file's name tells its format.
 */
#ifndef FlipFreeCommandVolumeFile_h
#define FlipFreeCommandVolumeFile_h

#include "FileFormats.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace Command
{

/// Reads a volume from a file or a DICOM folder; of several series, the one with the given UID, or
/// else the one with the most slices.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& name,
  const std::string& seriesUID = std::string());

/// A label map with a label that was chosen.
struct ChosenLabels
{
  vtkSmartPointer<vtkImageData> Map;
  int Label = -1; ///< negative where none was
};

/// Reads a label map. A label is a segment's name or a value; an empty text chooses none, and then
/// a segmentation of 3D Slicer may have but one layer.
ChosenLabels ReadLabels(const std::string& name, const std::string& label);

/// The DICOM series that a volume was read from, as ReadVolume() takes it; empty for other files.
std::string SeriesOf(vtkImageData* image);

void WriteVolume(const std::string& name, vtkImageData* image);

} // namespace Command

#endif
