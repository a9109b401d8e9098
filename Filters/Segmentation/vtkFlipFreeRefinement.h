/**
 * @class   vtkFlipFreeRefinement
 * @brief   refines a surface to four times as many vertices, to work from coarse to fine
 *
 * Refines a closed mesh with four neighbors at every vertex into one of the same kind (D. Doo and
 * M. Sabin, 1978): the sphere of resolution n becomes that of 2 n. With Check on, the refined
 * surface is embedded when the input is: where it would intersect itself, it is pulled toward the
 * old vertices, and if necessary the old surface is smoothed first.
 *
 * Input port 0: vtkPolyData, closed. Unless every vertex has four neighbors, the mesh of the
 * midpoints of its edges, which has them, is refined in its place.
 * Output port 0: the refined surface, without arrays.
 *
 * Errors, with a code of FlipFreeErrorCode.h: a surface that is open, not a consistently
 * oriented 2-manifold, or, with Check on, self-intersecting or impossible to refine.
 */
#ifndef vtkFlipFreeRefinement_h
#define vtkFlipFreeRefinement_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeRefinement : public vtkPolyDataAlgorithm
{
public:
  static vtkFlipFreeRefinement* New();
  vtkTypeMacro(vtkFlipFreeRefinement, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Ensure that the result is embedded. Default on.
   */
  vtkSetMacro(Check, bool);
  vtkGetMacro(Check, bool);
  vtkBooleanMacro(Check, bool);
  ///@}

protected:
  vtkFlipFreeRefinement() = default;
  ~vtkFlipFreeRefinement() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  bool Check = true;

private:
  vtkFlipFreeRefinement(const vtkFlipFreeRefinement&) = delete;
  void operator=(const vtkFlipFreeRefinement&) = delete;
};

#endif
