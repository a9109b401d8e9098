/**
 * @class   vtkConstraintPointSource
 * @brief   a point that says what is wrong with a segmentation
 *
 * Makes one point for the correction ports of vtkFlipFreeSegmentation, vtkFlipFreeOrganGroup and
 * vtkFlipFreeVesselSegmentation. These ports take any number of such sources, in any order: one for
 * each point, which can be moved by a handle in ParaView. To remove a point, disconnect its source,
 * or turn Enabled off.
 *
 * Output port 0: vtkPolyData, the point as a vertex, with the point arrays
 *  - `Constraint`, unsigned char: 0 outside the organ, 1 inside, 2 on its boundary, 3 a seed;
 *  - `Radius`, double, in millimeters: that of a seed sphere, 0 for other points;
 *  - `Organ`, int: the organ's number, from 1, which vtkFlipFreeOrganGroup reads.
 *
 * Errors, with a code of FlipFreeErrorCode.h: a Position, or the Radius of a seed, that is not
 * finite. The output is then empty.
 */
#ifndef vtkConstraintPointSource_h
#define vtkConstraintPointSource_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkConstraintPointSource : public vtkPolyDataAlgorithm
{
public:
  static vtkConstraintPointSource* New();
  vtkTypeMacro(vtkConstraintPointSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Values of Kind.
   */
  enum KindType
  {
    OUTSIDE = 0,
    INSIDE = 1,
    BOUNDARY = 2,
    SEED = 3
  };

  ///@{
  /**
   * Where the point lies: OUTSIDE the organ (default), INSIDE it, or on its BOUNDARY; or SEED, the
   * center of a seed sphere within the organ, whose radius is Radius.
   */
  vtkSetClampMacro(Kind, int, OUTSIDE, SEED);
  vtkGetMacro(Kind, int);
  void SetKindToOutside() { this->SetKind(OUTSIDE); }
  void SetKindToInside() { this->SetKind(INSIDE); }
  void SetKindToBoundary() { this->SetKind(BOUNDARY); }
  void SetKindToSeed() { this->SetKind(SEED); }
  ///@}

  ///@{
  /**
   * The point, in millimeters (physical coordinates of the image). Default (0, 0, 0). It is best
   * placed in the middle of the part that is missing or wrongly included.
   */
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}

  ///@{
  /**
   * Radius of a seed sphere, in millimeters. Default 10; positive. Other points have none.
   */
  void SetRadius(double value);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Whether there is a point. Default on; off removes it without disconnecting the source: the
   * output is then empty.
   */
  vtkSetMacro(Enabled, bool);
  vtkGetMacro(Enabled, bool);
  vtkBooleanMacro(Enabled, bool);
  ///@}

  ///@{
  /**
   * Number of the organ that the point belongs to, where there are several. Default 1; 1 to 255.
   */
  vtkSetClampMacro(Organ, int, 1, 255);
  vtkGetMacro(Organ, int);
  ///@}

protected:
  vtkConstraintPointSource();
  ~vtkConstraintPointSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Kind = OUTSIDE;
  double Position[3] = { 0, 0, 0 };
  double Radius = 10;
  int Organ = 1;
  bool Enabled = true;

private:
  vtkConstraintPointSource(const vtkConstraintPointSource&) = delete;
  void operator=(const vtkConstraintPointSource&) = delete;
};

#endif
