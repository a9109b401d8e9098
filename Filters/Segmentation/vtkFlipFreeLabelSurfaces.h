/**
 * @class   vtkFlipFreeLabelSurfaces
 * @brief   the surfaces of all labels of a label map, with shared walls
 *
 * Makes a closed surface for each label of a label map. Each is a 2-manifold without
 * self-intersections, whatever the labels are, and two labels have one wall between them. That is
 * proven (WallTriangles.h and LabelCells.h in Filters/Kernels/LabelSurface), and goes for the
 * positions as single precision, and so a file, holds them. What touches the border of the image is
 * closed there.
 *
 * With Exact on, each voxel center stays on the side of its own label: voxelized again, the
 * surfaces are the label map, voxel by voxel. Within these bounds they are as smooth as can be.
 * Off, the default, voxels next to a wall may change sides where that makes surfaces smoother; no
 * label falls apart or disappears by that, but a tunnel may open or close where voxels of a label
 * touch only by an edge or a corner. WrongVoxels says how many there are. Either way, volumes are
 * those of the voxels, as far as the bounds allow.
 *
 * SmallestPart and FillCavities, both off by default, take parts away before: small ones of labels,
 * and background that labels enclose. What goes takes the label with which it has the most faces of
 * voxels in common, or background, if that is it: so there is still one wall between two labels,
 * and all else is as if the label map had come like that. Its voxels count as wrong ones. So do
 * those that FillTunnels gives to a label, before that, to close narrow tunnels through it.
 *
 * Where labels touch only by an edge or a corner of voxels, they are joined if most of the eight
 * voxels there are theirs, and apart if not.
 *
 * The mesh is that of surface nets (S. Gibson, Constrained elastic surface nets, 1998): a vertex
 * where voxels of different labels meet. EdgeLength and Triangles make it coarser, by collapses of
 * edges of which each is certified: what is connected stays so, walls remain shared and apart from
 * each other, and none moves by more than Tolerance, or, with Exact on, over a voxel center.
 *
 * Input port 0: vtkImageData, the label map: scalars of any type with one component, whole numbers
 * from 0, which is background, to 2147483647. Its field data `SegmentLabels` (numbers) and
 * `SegmentNames` (texts), if there are any, say how labels are called.
 *
 * Output port 0: vtkPolyData, all walls, as triangles. Cell data `BoundaryLabels`, int, two
 * components: the labels on both sides. Triangles are counter-clockwise seen from the second; that
 * is background, or else the greater one. Points are float. Field data (double): `WrongVoxels`,
 * `GreatestDistance`, `CollapseDistance` and `Certified` (1).
 * Output port 1: vtkMultiBlockDataSet, a vtkPolyData for each label, ascending, under its name or
 * else its number: closed, counter-clockwise seen from outside; empty if no part of the label is
 * left. Field data: `Label` (double) and `Certified` (1).
 * Output port 2: vtkTable, a row per label: Label, Name (empty where it has none), Milliliters
 * (inside), Voxels, VoxelMilliliters (of the voxels), WrongVoxels (whose center is inside but has
 * another label, or the reverse), Area (square millimeters), EulerNumber (2 for each piece
 * and each cavity, less 2 for each tunnel), Triangles.
 *
 * Errors, with a code of FlipFreeErrorCode.h and with empty outputs: an image without voxels,
 * scalars of one component or a proper grid; a voxel that is negative or no whole number; no
 * labels, more than 65,000 of them, or none of a value that AddLabel() asks for; voxels so small,
 * so far from the origin, that single precision cannot hold the surfaces; no part of any label that
 * is as large as SmallestPart; a property that is not a number.
 *
 * @sa vtkFlipFreeSegmentation, vtkSurfaceToLabelMap, vtkSurfaceNets3D
 */
#ifndef vtkFlipFreeLabelSurfaces_h
#define vtkFlipFreeLabelSurfaces_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <vector> // for the labels

class vtkMultiBlockDataSet;
class vtkTable;

namespace FlipFree
{
class FilterSettings;
struct LabelSurfaceSettings;
}

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeLabelSurfaces : public vtkPolyDataAlgorithm
{
public:
  static vtkFlipFreeLabelSurfaces* New();
  vtkTypeMacro(vtkFlipFreeLabelSurfaces, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The labels that get surfaces; all others are background. Default: none are named, and all have
   * surfaces.
   */
  void AddLabel(int label);
  void RemoveAllLabels();
  int GetNumberOfLabels() const { return static_cast<int>(this->Labels.size()); }
  int GetLabel(int index) const;
  ///@}

  ///@{
  /**
   * Keep the center of each voxel on the side of its own label. Default off.
   */
  void SetExact(bool value);
  bool GetExact() const;
  vtkBooleanMacro(Exact, bool);
  ///@}

  ///@{
  /**
   * With Exact off: how far walls may go along each axis to be smooth, from the corner of voxels
   * where they start, before voxels change sides. Voxels; default 0.9, 0.5 to 1. A voxel whose
   * center the walls pass changes sides.
   */
  void SetDistance(double value);
  double GetDistance() const;
  ///@}

  ///@{
  /**
   * Of the smoothing. Default 50, 0 to 10,000. Without any, walls are those of the voxels' corners.
   */
  void SetIterations(int value);
  int GetIterations() const;
  ///@}

  ///@{
  /**
   * Parts of labels that are smaller get no surface. A part is what is connected of a label across
   * faces of voxels, and where labels that touch by an edge or a corner are joined. Cubic
   * millimeters; default 0, which keeps all, 0 to 10^9.
   */
  void SetSmallestPart(double value);
  double GetSmallestPart() const;
  ///@}

  ///@{
  /**
   * Fill background that labels enclose. Default off.
   */
  void SetFillCavities(bool value);
  bool GetFillCavities() const;
  vtkBooleanMacro(FillCavities, bool);
  ///@}

  ///@{
  /**
   * Close tunnels through the parts of labels if no ball of this diameter passes, by a sheet of
   * voxels where they are narrow. A tunnel through which another label runs stays open.
   * Millimeters, to a voxel along each axis; default 0, which leaves all open, 0 to 10^6.
   */
  void SetFillTunnels(double value);
  double GetFillTunnels() const;
  ///@}

  ///@{
  /**
   * Fewer triangles: collapse edges while none becomes longer than EdgeLength (millimeters), and
   * while there are more than Triangles, of all walls. Both are 0 by default: EdgeLength 0 to 10^6
   * and Triangles 0 to 2147483647, of which 0 sets no limit, and both 0 collapse none. An edge that
   * would take walls beyond the tolerance, or into each other, stays.
   */
  void SetEdgeLength(double value);
  double GetEdgeLength() const;
  void SetTriangles(int value);
  int GetTriangles() const;
  ///@}

  ///@{
  /**
   * How far walls may move where edges are collapsed. Voxels of the smallest spacing; default 0.5,
   * 0 to 10. With Exact on, each voxel center stays on its side as well.
   */
  void SetTolerance(double value);
  double GetTolerance() const;
  ///@}

  ///@{
  /**
   * Output ports 1 and 2.
   */
  vtkMultiBlockDataSet* GetSurfaces();
  vtkTable* GetTable();
  ///@}

  ///@{
  /**
   * Of the last update: how many voxels have a label in which the surfaces do not have them, and
   * the greatest distance (mm) of a vertex from the nearest corner of voxels of different labels.
   */
  vtkGetMacro(NumberOfWrongVoxels, vtkIdType);
  vtkGetMacro(GreatestDistance, double);
  ///@}

  ///@{
  /**
   * Of the last update: the greatest distance (mm) between the walls before and after edges were
   * collapsed, of all vertices and of the middles of the edges and triangles that are left. 0
   * where none were.
   */
  vtkGetMacro(CollapseDistance, double);
  ///@}

protected:
  vtkFlipFreeLabelSurfaces();
  ~vtkFlipFreeLabelSurfaces() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkIdType NumberOfWrongVoxels = 0;
  double GreatestDistance = 0;
  double CollapseDistance = 0;

private:
  friend class FlipFree::FilterSettings;
  std::vector<int> Labels;
  const std::unique_ptr<FlipFree::LabelSurfaceSettings> Settings;

  vtkFlipFreeLabelSurfaces(const vtkFlipFreeLabelSurfaces&) = delete;
  void operator=(const vtkFlipFreeLabelSurfaces&) = delete;
};

#endif
