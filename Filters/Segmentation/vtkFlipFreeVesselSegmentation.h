/**
 * @class   vtkFlipFreeVesselSegmentation
 * @brief   from points in a vessel to its surface
 *
 * Follows a vessel, or a tree of vessels, between points (vtkVesselPath), outlines it in
 * cross-sections along the path, and deforms a quadrilateral mesh onto the outline, from coarse to
 * fine. The mesh begins within the outline, as the surface of cells of a grid: closed, without
 * holes or handles, with four neighbors at every vertex, so that a tree, too, is a single surface.
 * At the end, faces of more than four corners are cut into triangles.
 * The guard limits every motion, as in vtkFlipFreeSegmentation: the surface stays embedded, however
 * its faces are cut into triangles, and vertices lie at single-precision numbers.
 *
 * A vessel ends in a disk across the path at each end point. See vtkVesselAlgorithm for points,
 * input and errors.
 *
 * Points correct the result, as in vtkFlipFreeSegmentation: AddInsidePoint() and similar methods,
 * and input port 1. The path stays 3 mm away from an outside point where it can; the outline near a
 * point is moved; and the surface obeys every point: inside and outside points exactly, a boundary
 * point to within half of the image's smallest spacing.
 *
 * Input port 1, optional, repeatable: vtkPointSet, such points, with the point array `Constraint`
 * (0 outside, 1 inside, 2 on the boundary); vtkConstraintPointSource makes a data set of a single
 * point.
 *
 * Further errors:
 * - a correction outside the image, or one that contradicts another;
 * - an outside point within 0.5 mm of a point of the vessel, or within about 1 mm of the path;
 * - an inside or boundary point farther from the path than three radii and 10 mm;
 * - a correction that no surface of one piece can obey;
 * - a further seed.
 *
 * Output port 0: vtkPolyData, the surface, with the arrays of vtkFlipFreeSegmentation.
 * Output port 1: vtkImageData, unsigned char `Labels` of the input's geometry: LabelValue inside.
 * Output port 2: vtkPolyData, the centerline, as vtkVesselPath gives it.
 * Output port 3: vtkTable `Convergence`, as from vtkFlipFreeSegmentation.
 *
 * Warnings, which still give a result: GetConfidence() is below 0.45, with the place where it is
 * lowest; the surface could not be refined, or it extends far beyond the disks at the ends.
 */
#ifndef vtkFlipFreeVesselSegmentation_h
#define vtkFlipFreeVesselSegmentation_h

#include "FlipFreeSegmentationModule.h"
#include "vtkVesselAlgorithm.h"

class vtkImageData;
class vtkPointSet;
class vtkPolyData;
class vtkTable;

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeVesselSegmentation : public vtkVesselAlgorithm
{
public:
  static vtkFlipFreeVesselSegmentation* New();
  vtkTypeMacro(vtkFlipFreeVesselSegmentation, vtkVesselAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The outputs, after Update(); GetOutput() is the surface, too.
   */
  vtkPolyData* GetSurface();
  vtkImageData* GetLabelMap();
  vtkPolyData* GetCenterline();
  vtkTable* GetConvergence();
  ///@}

  ///@{
  /**
   * Connects or sets the points that correct the result (input port 1), replacing earlier ones;
   * adds more; disconnects all.
   */
  void SetConstraintConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetConstraintData(vtkPointSet* points);
  void AddConstraintConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void AddConstraintData(vtkPointSet* points);
  void RemoveAllConstraintConnections() { this->RemoveAllInputConnections(1); }
  ///@}

  ///@{
  /**
   * Adds a point that corrects the result, in millimeters, to those of input port 1: one that lies
   * inside the vessel, outside it, or on its boundary.
   */
  void AddInsidePoint(double x, double y, double z);
  void AddOutsidePoint(double x, double y, double z);
  void AddBoundaryPoint(double x, double y, double z);
  ///@}

  ///@{
  /**
   * The number of these points, not counting those of input port 1; removes all of them.
   */
  int GetNumberOfCorrections() const;
  void RemoveAllCorrections();
  ///@}

  ///@{
  /**
   * Number of levels from coarse to fine. Default 2; 1 to 4. At the first level, vertices are about
   * half the thinnest branch's radius apart; each further level doubles the resolution.
   */
  void SetLevels(int value);
  int GetLevels() const;
  ///@}

  ///@{
  /**
   * Maximum number of iterations at each level. Default 20; 0 to 1000.
   */
  void SetMaximumIterations(int value);
  int GetMaximumIterations() const;
  ///@}

  ///@{
  /**
   * Value of the vessel's voxels in the label map. Default 1; 1 to 255.
   */
  void SetLabelValue(int value);
  int GetLabelValue() const;
  ///@}

  ///@{
  /**
   * Why the last level ended, after Update(): one of vtkFlipFreeSegmentation::StopReasons, or the
   * same in words.
   */
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString() const;
  ///@}

  /**
   * Pairs of faces of the result that intersect for some way of cutting them into triangles,
   * counted exactly and independently of the guard; -1 before Update().
   */
  vtkGetMacro(NumberOfSelfIntersections, int);

  /**
   * The mean contrast across the outline in cross-sections, as a fraction of 25 gray values (HU; MR
   * scaled to CT): 1 where gray values inside and outside differ by that much or more everywhere, 0
   * where they do not differ. 0 before Update().
   */
  vtkGetMacro(Support, double);

  /**
   * How far the vessel can be trusted, 0 to 1: where it is least, over 30 mm, how well the image
   * shows the outline, as in GetSupport(), and how like the vessel at the points is what the path
   * runs through. Doubtful below 0.45. 0 before Update().
   */
  vtkGetMacro(Confidence, double);

  ///@{
  /**
   * Seconds of the last Update() by stage: path and outline, start surface, deformation, label map.
   */
  vtkGetVector4Macro(StageSeconds, double);
  ///@}

protected:
  vtkFlipFreeVesselSegmentation();
  ~vtkFlipFreeVesselSegmentation() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int StopReason = 0;
  int NumberOfSelfIntersections = -1;
  double Support = 0;
  double Confidence = 0;
  double StageSeconds[4] = { 0, 0, 0, 0 };

private:
  void Segment(vtkImageData* image, vtkInformationVector* corrections,
    vtkInformationVector* outputs);

  vtkFlipFreeVesselSegmentation(const vtkFlipFreeVesselSegmentation&) = delete;
  void operator=(const vtkFlipFreeVesselSegmentation&) = delete;
};

#endif
