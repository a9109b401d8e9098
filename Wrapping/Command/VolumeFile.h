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

/// Whether it is a folder, or a DICOM file of several frames.
bool MayHoldSeries(const std::string& name);

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

/// Whether a text can choose a label: whatever is not a number other than a value.
bool IsLabel(const std::string& text);

/// The DICOM series that a volume was read from, as ReadVolume() takes it; empty for other files.
std::string SeriesOf(vtkImageData* image);

/// What a summary calls a volume: the file, or the folder and the series in it.
std::string InputTitle(const std::string& name, const std::string& seriesUID);

void WriteVolume(const std::string& name, vtkImageData* image);

} // namespace Command

#endif
