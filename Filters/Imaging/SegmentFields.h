/**
 * Private to the module: what a file of 3D Slicer (.seg.nrrd) says of the labels in it: a NRRD file
 * whose fields give each label, a segment, a name and a color, as documented in Slicer's developer
 * guide, "Segmentation labelmap file format".
 */
#ifndef FlipFreeSegmentFields_h
#define FlipFreeSegmentFields_h

#include <string>
#include <utility>
#include <vector>

class vtkImageData;

namespace FlipFree
{

using FileFields = std::vector<std::pair<std::string, std::string>>;

/// Whether the file's name ends on .seg.nrrd.
bool IsSegmentation(const std::string& name);

/// The fields of a label map with scalars, for the file of that name. Names and colors are those of
/// its field data (SegmentLabels, SegmentNames, SegmentColors); a label that these do not name is
/// called by its value, or, the only one of the file, by the file. Throws an ImageFileError where
/// the voxels are not labels, or the field data do not fit together.
FileFields SegmentFieldsOf(vtkImageData* labels, const std::string& name);

} // namespace FlipFree

#endif
