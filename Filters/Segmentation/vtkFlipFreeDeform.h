/**
 * @class   vtkFlipFreeDeform
 * @brief   moves a surface towards its targets, without a flip and without a self-intersection
 *
 * One iteration of sections 3.4 to 3.6 of the paper: detects the vertices whose targets would flip
 * an edge (Eq. 3), drops all but the middle one of each run on a contour, propagates displacements
 * to solitary vertices, and solves the Laplacian deformation (Eq. 4-8). The guard then holds back
 * what would make the surface meet itself or turn a face, so that an embedded input gives an
 * embedded output.
 *
 * Input port 0: vtkPolyData, closed, four neighbors at every vertex, with the point arrays
 * `Displacement` (3 doubles, mm) and `Correspondence` (unsigned char) of vtkCorrespondenceSearch.
 * Output port 0: the moved surface; both arrays as flip avoidance and propagation left them. Field
 * data, one double each: `FlippingVertices` (before avoidance) and `GuardedVertices` (held back).
 *
 * Errors: missing arrays or arrays of another type, displacements that are not finite, a surface
 * that is open, not four-valent, or, with the guard on, self-intersecting.
 */
#ifndef vtkFlipFreeDeform_h
#define vtkFlipFreeDeform_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeDeform : public vtkPolyDataAlgorithm
{
public:
  static vtkFlipFreeDeform* New();
  vtkTypeMacro(vtkFlipFreeDeform, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Detect and avoid flips. Default on.
   */
  vtkSetMacro(AvoidFlips, bool);
  vtkGetMacro(AvoidFlips, bool);
  vtkBooleanMacro(AvoidFlips, bool);
  ///@}

  ///@{
  /**
   * r of Eq. 3. Default 0.3; 0 to 1.
   */
  vtkSetClampMacro(FlipThreshold, double, 0, 1);
  vtkGetMacro(FlipThreshold, double);
  ///@}

  ///@{
  /**
   * Passes of local averaging by which displacements reach solitary vertices. Default 40.
   */
  vtkSetClampMacro(PropagationIterations, int, 0, 100000);
  vtkGetMacro(PropagationIterations, int);
  ///@}

  ///@{
  /**
   * Passes in which matched vertices are averaged too. Default 1.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, 100000);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /**
   * lambda_p of Eq. 4. Default 0.3.
   */
  vtkSetClampMacro(PositionWeight, double, 0, 1e6);
  vtkGetMacro(PositionWeight, double);
  ///@}

  ///@{
  /**
   * lambda_u of Eq. 4. Default 1.
   */
  vtkSetClampMacro(UniformWeight, double, 0, 1e6);
  vtkGetMacro(UniformWeight, double);
  ///@}

  ///@{
  /**
   * How much of the present Laplacian is given up: 0 (default) is Eq. 5, 1 smooths and shrinks.
   */
  vtkSetClampMacro(Fairing, double, 0, 1);
  vtkGetMacro(Fairing, double);
  ///@}

  ///@{
  /**
   * Hold back what is not valid. Default on.
   */
  vtkSetMacro(Guard, bool);
  vtkGetMacro(Guard, bool);
  vtkBooleanMacro(Guard, bool);
  ///@}

protected:
  vtkFlipFreeDeform() = default;
  ~vtkFlipFreeDeform() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  bool AvoidFlips = true;
  double FlipThreshold = 0.3;
  int PropagationIterations = 40;
  int SmoothingIterations = 1;
  double PositionWeight = 0.3;
  double UniformWeight = 1;
  double Fairing = 0;
  bool Guard = true;

private:
  vtkFlipFreeDeform(const vtkFlipFreeDeform&) = delete;
  void operator=(const vtkFlipFreeDeform&) = delete;
};

#endif
