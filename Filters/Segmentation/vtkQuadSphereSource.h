/**
 * @class   vtkQuadSphereSource
 * @brief   the quadrilateral sphere from which a segmentation starts
 *
 * Makes the mesh of section 3.1 of the paper: a cube with Resolution x Resolution vertices at the
 * cell centers of each side, projected onto a sphere. It has 6 n^2 vertices, each with exactly four
 * neighbors and on exactly two closed contours; 6 n^2 - 6 quads; and 8 triangles, one at each
 * corner of the cube. Faces are counter-clockwise seen from outside.
 *
 * Output port 0: vtkPolyData with the point array
 *  - `Checkerboard`, unsigned char: 0 or 1 by fields of 4 x 4 cells per side, to show how a
 *    deformation moves the mesh (Fig. 1 of the paper).
 *
 * Errors, with a code of FlipFreeErrorCode.h: a Center or Radius that is not finite, no memory. A
 * Resolution below 1 or a Radius that is not positive cannot be set; they are clamped.
 */
#ifndef vtkQuadSphereSource_h
#define vtkQuadSphereSource_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkQuadSphereSource : public vtkPolyDataAlgorithm
{
public:
  static vtkQuadSphereSource* New();
  vtkTypeMacro(vtkQuadSphereSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Values of Spacing.
   */
  enum SpacingType
  {
    EQUIANGULAR = 0,
    RADIAL = 1,
    CUBE = 2
  };

  ///@{
  /**
   * Center of the sphere in millimeters (physical coordinates of the image it will segment).
   * Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Radius of the sphere in millimeters; for CUBE, half the edge length. Default 1; positive.
   */
  vtkSetClampMacro(Radius, double, 1e-9, 1e9);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Number n of vertices along the edge of a side. Default 32 (6,144 vertices); 1 to 1024.
   */
  vtkSetClampMacro(Resolution, int, 1, 1024);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * How the cube's vertices are spread on the sphere. EQUIANGULAR (default) gives even cells;
   * RADIAL is the paper's projection along the radius, with smaller cells near the cube's corners;
   * CUBE leaves the cube as it is (Fig. 1a).
   */
  vtkSetClampMacro(Spacing, int, EQUIANGULAR, CUBE);
  vtkGetMacro(Spacing, int);
  void SetSpacingToEquiangular() { this->SetSpacing(EQUIANGULAR); }
  void SetSpacingToRadial() { this->SetSpacing(RADIAL); }
  void SetSpacingToCube() { this->SetSpacing(CUBE); }
  ///@}

protected:
  vtkQuadSphereSource();
  ~vtkQuadSphereSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Center[3] = { 0, 0, 0 };
  double Radius = 1;
  int Resolution = 32;
  int Spacing = EQUIANGULAR;

private:
  vtkQuadSphereSource(const vtkQuadSphereSource&) = delete;
  void operator=(const vtkQuadSphereSource&) = delete;
};

#endif
