/**
 * A picture of a segmentation: three orthogonal slices through the middle of the surface with its
 * contour on them, and the surface itself.
 */
#ifndef FlipFreeCommandSnapshot_h
#define FlipFreeCommandSnapshot_h

#include <string>

class vtkImageData;
class vtkPolyData;

namespace Command
{

/// Throws a Failure where pictures cannot be drawn, for want of a display.
void RequireDisplay();

/// Writes a PNG file of 1200 x 1200 pixels. Slices are shown as radiologists do: axial ones (upper
/// left) from the feet, coronal ones (lower left) from the front, sagittal ones (upper right) from
/// the patient's left, all to one scale; below right, the surface from the front.
void WriteSnapshot(const std::string& name, vtkImageData* image, vtkPolyData* surface);

} // namespace Command

#endif
