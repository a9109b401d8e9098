/**
 * @class   vtkFlipFreeDeform
 * @brief   moves a surface toward its targets, without a flip and without a self-intersection
 *
 * One iteration of sections 3.4 to 3.6 of the paper: detects the vertices whose targets would flip
 * an edge (Eq. 3), drops the targets of all but the middle vertex of each run on a contour,
 * propagates displacements to solitary vertices, and solves the Laplacian deformation (Eq. 4-8).
 * The guard then limits any motion that would make the surface meet itself or flip a face, so that
 * an embedded input gives an embedded output.
 *
 * Input port 0: vtkPolyData, closed, four neighbors at every vertex, with the point arrays
 * `Displacement` (3 doubles, mm) and `Correspondence` (unsigned char) of vtkCorrespondenceSearch.
 * Output port 0: the moved surface; both arrays as flip avoidance and propagation left them. Field
 * data, one double each: `FlippingVertices` (before avoidance), `GuardedVertices` (whose motion the
 * guard scaled down), and `Certified` (1 with the guard on, 0 otherwise).
 *
 * Errors, with a code of FlipFreeErrorCode.h: missing arrays or arrays of another type,
 * displacements that are not finite, a surface that is open, not four-valent, or, with the guard
 * on, self-intersecting.
 */
#ifndef vtkFlipFreeDeform_h
#define vtkFlipFreeDeform_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace FlipFree
{
struct DeformationStepSettings;
}

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeDeform : public vtkPolyDataAlgorithm
{
public:
  static vtkFlipFreeDeform* New();
  vtkTypeMacro(vtkFlipFreeDeform, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Detect and avoid flips (sections 3.4 and 3.5). Default on; off only counts them.
   */
  void SetAvoidFlips(bool value);
  bool GetAvoidFlips() const;
  vtkBooleanMacro(AvoidFlips, bool);
  ///@}

  ///@{
  /**
   * r of Eq. 3: the least cosine of the angle by which an edge may turn. Default 0.3; 0 to 1.
   */
  void SetFlipThreshold(double value);
  double GetFlipThreshold() const;
  ///@}

  ///@{
  /**
   * Passes of local averaging that carry displacements to solitary vertices (section 3.6). Default
   * 40; 0 to 100000.
   */
  void SetPropagationIterations(int value);
  int GetPropagationIterations() const;
  ///@}

  ///@{
  /**
   * Passes that average matched vertices, too. Default 1; 0 to 100000.
   */
  void SetSmoothingIterations(int value);
  int GetSmoothingIterations() const;
  ///@}

  ///@{
  /**
   * Weight lambda_p of the positional energy (Eq. 7). Default 0.3; 0 to 1e6.
   */
  void SetPositionWeight(double value);
  double GetPositionWeight() const;
  ///@}

  ///@{
  /**
   * Weight lambda_u of the energy of uniform vertex distribution (Eq. 8). Default 1; 0 to 1e6.
   */
  void SetUniformWeight(double value);
  double GetUniformWeight() const;
  ///@}

  ///@{
  /**
   * Fraction of the current Laplacian that is given up in each iteration, 0 to 1. Default 0: Eq. 5,
   * which keeps the shape; 1 minimizes the new Laplacian, which smooths and shrinks.
   */
  void SetFairing(double value);
  double GetFairing() const;
  ///@}

  ///@{
  /**
   * Limit the motion so that the surface neither meets itself nor flips. Default on; off gives no
   * guarantee.
   */
  void SetGuard(bool value);
  bool GetGuard() const;
  vtkBooleanMacro(Guard, bool);
  ///@}

protected:
  vtkFlipFreeDeform();
  ~vtkFlipFreeDeform() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  friend class vtkFlipFreeSegmentation; // takes the settings as a whole

  void RequireProperties() const;

  const std::unique_ptr<FlipFree::DeformationStepSettings> Settings;

  vtkFlipFreeDeform(const vtkFlipFreeDeform&) = delete;
  void operator=(const vtkFlipFreeDeform&) = delete;

  struct Workspace;
  std::unique_ptr<Workspace> Kept; ///< from update to update, while the connectivity stays
};

#endif
