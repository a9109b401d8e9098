/**
 * @class   vtkSimplexMeshSegmentation
 * @brief   segments an organ by a simplex mesh that is inflated from the seed sphere
 *
 * A deformable simplex mesh (itk::DeformableSimplexMesh3DFilter) is a surface whose vertices have
 * three neighbors each. A balloon force moves the vertices along their normals, outward where the
 * intensity is within IntensityWidth standard deviations of the seed's mean and inward elsewhere;
 * internal forces keep the vertices spread evenly and the surface smooth. The motion stops when the
 * volume has settled, or after MaximumIterations.
 *
 * Nothing keeps the surface from folding or intersecting itself, as simplex meshes of this kind do
 * at necks and in leaks.
 *
 * Ports, errors and the common properties are those of vtkBaselineSegmentation. The surface has the
 * sphere's topology: the mesh's faces, cut into triangles.
 *
 * Source: H. Delingette, General object reconstruction based on simplex meshes (1999); T. Boettger
 * et al., Implementation of a 3D simplex mesh segmentation in ITK (2007); the balloon force: L.
 * Cohen, On active contour models and balloons (1991).
 */
#ifndef vtkSimplexMeshSegmentation_h
#define vtkSimplexMeshSegmentation_h

#include "vtkBaselineSegmentation.h"

class vtkSimplexMeshSegmentation : public vtkBaselineSegmentation
{
public:
  static vtkSimplexMeshSegmentation* New();
  vtkTypeMacro(vtkSimplexMeshSegmentation, vtkBaselineSegmentation);

  /**
   * Resolution n of the mesh: 12 n^2 - 4 vertices. Default 12 (1,724); 2 to 128.
   */
  vtkSetClampMacro(Resolution, int, 2, 128);

  /**
   * Half the width of the interval of intensities in which the surface grows, in standard
   * deviations of the seed's smoothed intensities. Default 6; 0.1 to 100.
   */
  vtkSetClampMacro(IntensityWidth, double, 0.1, 100);

  /**
   * Maximum step of a vertex by the balloon force, in millimeters per iteration. Default 0.25;
   * 0.001 to 10.
   */
  vtkSetClampMacro(BalloonStep, double, 0.001, 10);

  /**
   * Weight of the internal forces; higher is stiffer. Default 0.5; 0 to 1.
   */
  vtkSetClampMacro(Stiffness, double, 0, 1);

  /**
   * Radius of the neighborhood to whose mean curvature a vertex is drawn, in edges beyond the
   * first. Default 2; 0 to 10.
   */
  vtkSetClampMacro(Rigidity, int, 0, 10);

  /**
   * Maximum number of iterations. Default 1000; 1 to 1e6.
   */
  vtkSetClampMacro(MaximumIterations, int, 1, 1000000);

  /**
   * The motion stops when the volume has changed by less than this fraction over 25 iterations.
   * Default 0.001; 0 (never) to 1.
   */
  vtkSetClampMacro(VolumeTolerance, double, 0, 1);

protected:
  vtkSimplexMeshSegmentation() = default;
  ~vtkSimplexMeshSegmentation() override = default;

  bool Segment(const FlipFree::BaselineTask& task, const std::function<bool(double)>& monitor,
    FlipFree::BaselineResult& result) override;
  void RequireProperties() override;

  int Resolution = 12;
  double IntensityWidth = 6;
  double BalloonStep = 0.25;
  double Stiffness = 0.5;
  int Rigidity = 2;
  int MaximumIterations = 1000;
  double VolumeTolerance = 0.001;
};

#endif
