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
 * Where labels touch only by an edge or a corner of voxels, they are joined if most of the eight
 * voxels there are theirs, and apart if not.
 *
 * The mesh is that of surface nets (S. Gibson, Constrained elastic surface nets, 1998): a vertex
 * where voxels of different labels meet.
 *
 * Input port 0: vtkImageData, the label map: scalars of any type with one component, whole numbers
 * from 0, which is background, to 2147483647. Its field data `SegmentLabels` (numbers) and
 * `SegmentNames` (texts), if there are any, say how labels are called.
 *
 * Output port 0: vtkPolyData, all walls, as triangles. Cell data `BoundaryLabels`, int, two
 * components: the labels on both sides. Triangles are counter-clockwise seen from the second; that
 * is background, or else the greater one. Points are float. Field data (double): `WrongVoxels`,
 * `GreatestDistance` and `Certified` (1).
 * Output port 1: vtkMultiBlockDataSet, a vtkPolyData for each label, ascending, under its name or
 * else its number: closed, counter-clockwise seen from outside. Field data: `Label` (double) and
 * `Certified` (1).
 * Output port 2: vtkTable, a row per label: Label, Name (empty where it has none), Milliliters
 * (inside), Voxels, VoxelMilliliters (of the voxels), WrongVoxels (whose center is inside but has
 * another label, or the reverse), Area (square millimeters), EulerNumber (2 for each piece, less 2
 * for each tunnel), Triangles.
 *
 * Errors, with a code of FlipFreeErrorCode.h and with empty outputs: an image without voxels,
 * scalars of one component or a proper grid; a voxel that is negative or no whole number; no
 * labels, more than 100,000 of them, or none of a value that AddLabel() asks for; voxels so small,
 * so far from the origin, that single precision cannot hold the surfaces; a Distance that
 * is not a number.
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

protected:
  vtkFlipFreeLabelSurfaces();
  ~vtkFlipFreeLabelSurfaces() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkIdType NumberOfWrongVoxels = 0;
  double GreatestDistance = 0;

private:
  friend class FlipFree::FilterSettings;
  std::vector<int> Labels;
  const std::unique_ptr<FlipFree::LabelSurfaceSettings> Settings;

  vtkFlipFreeLabelSurfaces(const vtkFlipFreeLabelSurfaces&) = delete;
  void operator=(const vtkFlipFreeLabelSurfaces&) = delete;
};

#endif
