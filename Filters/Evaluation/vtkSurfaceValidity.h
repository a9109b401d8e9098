/**
 * @class   vtkSurfaceValidity
 * @brief   check that a surface is valid, and mark where it is not
 *
 * Passes a surface of polygons through, marks its invalid cells, and counts the defects. A surface
 * is valid when it is closed (every edge is on two consistently oriented faces), does not intersect
 * itself, and has no flipped corner. Polygons may be cut into triangles along any of their
 * diagonals (polygons with more than eight corners only along those from the first corner).
 * Self-intersections are pairs of faces that some cuts make intersect in more than a shared vertex
 * or edge, decided exactly; a face whose own triangles may overlap is paired with itself. Two faces
 * that can be cut along the same diagonal are such a pair, since that would be an edge of more than
 * two triangles. The
 * surface may be open, of any genus, and have any of these defects.
 *
 * Input port 0: vtkPolyData, the surface.
 *
 * Input port 1, optional: vtkPolyData with the same polygons at other positions, such as the start
 * of a deformation (SetReferenceSurfaceData or SetReferenceSurfaceConnection). A corner of a face
 * is flipped when its normal has turned by 90 degrees or more relative to it.
 *
 * Output port 0: vtkPolyData, the surface with the cell arrays
 *  - `Defects`, unsigned char: the sum of 1 self-intersecting, 2 with a flipped corner, 4 on a
 *    boundary edge, 8 on an edge of three faces or more, or of two that are oriented differently;
 *  - `ScaledJacobian`, double: the minimum over the face's corners of the sine of the angle,
 *    divided by that of a regular polygon; negative where it turns the wrong way. 1 is best, 0
 *    degenerate.
 *
 * Output port 1: vtkTable with one row (GetMeasures) and the columns Valid (0 or 1),
 * SelfIntersections (pairs of faces), FlippedCorners (-1 without a reference), EulerNumber,
 * BoundaryEdges, NonManifoldEdges, MisorientedEdges, all int; MinimumScaledJacobian,
 * FirstPercentileScaledJacobian, MinimumDihedralAngle (degrees, 180 is flat), MinimumGap (mm,
 * between the convex hulls of faces that share no vertex; 0 where there are self-intersections) and
 * EdgeLengthVariation (standard deviation over mean), double.
 *
 * Errors, with a code of FlipFreeErrorCode.h and with empty outputs: a surface without points or
 * polygons, with triangle strips, or with a coordinate that is not finite; a reference with
 * different polygons.
 */
#ifndef vtkSurfaceValidity_h
#define vtkSurfaceValidity_h

#include "FlipFreeEvaluationModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <string> // for std::string

class vtkTable;

class FLIPFREEEVALUATION_EXPORT vtkSurfaceValidity : public vtkPolyDataAlgorithm
{
public:
  static vtkSurfaceValidity* New();
  vtkTypeMacro(vtkSurfaceValidity, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Bits of the array Defects.
   */
  enum DefectType
  {
    SELF_INTERSECTING = 1,
    FLIPPED_CORNER = 2,
    BOUNDARY_EDGE = 4,
    BAD_EDGE = 8
  };

  ///@{
  /**
   * The same polygons at other positions (input port 1), against which flipped corners are counted.
   */
  void SetReferenceSurfaceData(vtkPolyData* surface);
  void SetReferenceSurfaceConnection(vtkAlgorithmOutput* output);
  ///@}

  /**
   * The table on output port 1, of the last update.
   */
  vtkTable* GetMeasures();

  /**
   * Whether the surface of the last update is valid; false before the first update and after one
   * that failed.
   */
  bool IsValid();

  /**
   * The main measures of the last update in one line; empty before the first update and after one
   * that failed.
   */
  std::string GetSummary() const { return this->Summary; }

protected:
  vtkSurfaceValidity();
  ~vtkSurfaceValidity() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSurfaceValidity(const vtkSurfaceValidity&) = delete;
  void operator=(const vtkSurfaceValidity&) = delete;

  std::string Summary;
};

#endif
