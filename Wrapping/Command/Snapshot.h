/**
 * Draws a segmentation: three orthogonal slices through the center of the surface with its contour,
 * and the surface itself.
 */
#ifndef FlipFreeCommandSnapshot_h
#define FlipFreeCommandSnapshot_h

#include <string>

class vtkImageData;
class vtkPolyData;

namespace Command
{

/// Throws a Failure if there is no display to draw with.
void RequireDisplay();

/// Writes a PNG file of 1200 x 1200 pixels. Slices follow the radiological convention, at one
/// scale: axial (upper left) from the feet, coronal (lower left) from the front, sagittal (upper
/// right) from the patient's left. At the lower right, the surface from the front.
void WriteSnapshot(const std::string& name, vtkImageData* image, vtkPolyData* surface);

} // namespace Command

#endif
