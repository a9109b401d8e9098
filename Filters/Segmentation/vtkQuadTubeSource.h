/**
 * @class   vtkQuadTubeSource
 * @brief   a closed quadrilateral tube along a line, from which a segmentation may start
 *
 * Bends a box of Resolution x Resolution x m cells along a poly line with radii, such as
 * vtkVesselPath gives. Every vertex has exactly four neighbors and lies on exactly two closed
 * contours: rings around the tube and loops along it. Apart from the quads there are 8 triangles,
 * at the corners of the box. Faces are counter-clockwise seen from outside, and the ends are flat.
 *
 * Input port 0: vtkPolyData with poly lines and the point array Radius (one component, mm).
 * Output port 0: vtkPolyData, the tube.
 *
 * Errors, with a code of FlipFreeErrorCode.h: no such line, a radius that is not positive or not
 * finite, two coincident points, a line that bends more tightly than its radius or comes too close
 * to itself, so that the tube would intersect itself; the message says where. The output is then
 * empty.
 */
#ifndef vtkQuadTubeSource_h
#define vtkQuadTubeSource_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkQuadTubeSource : public vtkPolyDataAlgorithm
{
public:
  static vtkQuadTubeSource* New();
  vtkTypeMacro(vtkQuadTubeSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number n of vertices along a side of the box's square; there are 4 n around the tube. Default
   * 4; 2 to 256. The number along the tube is chosen so that its cells are even.
   */
  vtkSetClampMacro(Resolution, int, 2, 256);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Which of the input's lines, counted from 0. Default 0.
   */
  vtkSetClampMacro(LineIndex, int, 0, 1000000);
  vtkGetMacro(LineIndex, int);
  ///@}

protected:
  vtkQuadTubeSource() = default;
  ~vtkQuadTubeSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Resolution = 4;
  int LineIndex = 0;

private:
  vtkQuadTubeSource(const vtkQuadTubeSource&) = delete;
  void operator=(const vtkQuadTubeSource&) = delete;
};

#endif
