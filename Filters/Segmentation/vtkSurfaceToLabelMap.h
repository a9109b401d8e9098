/**
 * @class   vtkSurfaceToLabelMap
 * @brief   the voxels inside a closed surface, as a label map
 *
 * Writes LabelValue into every voxel whose center is inside the surface and 0 into all others. The
 * label map has the extent, origin, spacing and direction of a reference image, even if its axes
 * are permuted, oblique or left-handed: the surface is brought into the image's index space and
 * converted row by row, exact up to rounding. Of two surfaces that share a wall, each voxel belongs
 * to exactly one, even where the wall runs through voxel centers. Where a self-intersecting surface
 * overlaps itself, the overlap is inside. What lies beyond the image is cut off.
 *
 * Input port 0: vtkPolyData, the surface: polygons, closed, all oriented alike (outwards or
 * inwards). Coordinates are the physical millimeters of the image.
 *
 * Input port 1: vtkImageData, the reference image (SetReferenceImageData or
 * SetReferenceImageConnection). Only its geometry is used; it need not have scalars.
 *
 * Output port 0: vtkImageData with the scalars
 *  - `Labels`, unsigned char, one component: LabelValue inside, 0 outside.
 *
 * Errors, with a code of FlipFreeErrorCode.h and with an empty output: a surface without points or
 * polygons, with triangle strips, with a coordinate that is not finite, or not closed and
 * consistently oriented; an image without voxels, with a spacing that is not positive, or with a
 * singular direction matrix.
 *
 * @sa vtkPolyDataToImageStencil, which does not support direction matrices.
 */
#ifndef vtkSurfaceToLabelMap_h
#define vtkSurfaceToLabelMap_h

#include "FlipFreeSegmentationModule.h"
#include "vtkImageAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkSurfaceToLabelMap : public vtkImageAlgorithm
{
public:
  static vtkSurfaceToLabelMap* New();
  vtkTypeMacro(vtkSurfaceToLabelMap, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The image whose geometry the label map takes (input port 1).
   */
  void SetReferenceImageData(vtkImageData* image);
  void SetReferenceImageConnection(vtkAlgorithmOutput* output);
  ///@}

  ///@{
  /**
   * Value of the voxels inside. Default 1; 1 to 255.
   */
  vtkSetClampMacro(LabelValue, int, 1, 255);
  vtkGetMacro(LabelValue, int);
  ///@}

protected:
  vtkSurfaceToLabelMap();
  ~vtkSurfaceToLabelMap() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int LabelValue = 1;

private:
  vtkSurfaceToLabelMap(const vtkSurfaceToLabelMap&) = delete;
  void operator=(const vtkSurfaceToLabelMap&) = delete;
};

#endif
