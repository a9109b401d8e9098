/**
 * @class   vtkCorrespondenceSearch
 * @brief   from each vertex along its normal to the organ's boundary
 *
 * Correspondence search (section 3.3 and Eq. 2 of the paper). A vertex in the foreground looks
 * outward for a run of background voxels, one in the background inward for a run of foreground; the
 * target is the point where the line enters that run. A vertex that finds none is solitary. Lines
 * are walked voxel by voxel, exactly, under any direction matrix.
 *
 * Input port 0: vtkPolyData, closed, with four neighbors at every vertex.
 * Input port 1: vtkImageData, the feature: one scalar component, 0 to 1 (SetFeatureConnection).
 * Input port 2, optional: vtkImageData, the smoothed image of the same grid, in whose edges the
 * target is refined (SetEdgeConnection); needed if EdgeWindow is not zero. Output port 0: the
 * surface with the point arrays `Displacement` (3 doubles, mm: target minus point; zero where
 * solitary) and `Correspondence` (unsigned char: 0 solitary, 1 matched). Field data `MeanDistance`
 * (1 double, mm): mean distance to the targets found, before they are limited.
 *
 * Errors: a surface that is open or not four-valent; images without scalars, with several
 * components or with voxels that are not finite; an edge image that is missing or has another grid
 * than the feature; `FeatureThreshold` or `EdgeRamp` of another size or not finite.
 */
#ifndef vtkCorrespondenceSearch_h
#define vtkCorrespondenceSearch_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

class vtkImageData;

class FLIPFREESEGMENTATION_EXPORT vtkCorrespondenceSearch : public vtkPolyDataAlgorithm
{
public:
  static vtkCorrespondenceSearch* New();
  vtkTypeMacro(vtkCorrespondenceSearch, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The feature image (input port 1).
   */
  void SetFeatureConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetFeatureData(vtkImageData* feature);
  ///@}

  ///@{
  /**
   * The image in whose edges targets are refined (input port 2).
   */
  void SetEdgeConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }
  void SetEdgeData(vtkImageData* image);
  ///@}

  ///@{
  /**
   * Gamma: features at or above it are foreground. Default 0: the feature's field data
   * `FeatureThreshold`, or 0.5 without it.
   */
  vtkSetClampMacro(Threshold, double, 0, 1);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * Greatest length of a line, in millimeters. Default 40.
   */
  vtkSetClampMacro(SearchDistance, double, 0, 1e6);
  vtkGetMacro(SearchDistance, double);
  ///@}

  ///@{
  /**
   * Length of the run, in millimeters. Default 2; zero counts RunVoxels instead.
   */
  vtkSetClampMacro(RunLength, double, 0, 1000);
  vtkGetMacro(RunLength, double);
  ///@}

  ///@{
  /**
   * Length of the run in voxels: the paper's N + 1. Default 4.
   */
  vtkSetClampMacro(RunVoxels, int, 1, 1000);
  vtkGetMacro(RunVoxels, int);
  ///@}

  ///@{
  /**
   * Vertices in the background look inward. Default on; off is Eq. 2 read literally.
   */
  vtkSetMacro(SearchInward, bool);
  vtkGetMacro(SearchInward, bool);
  vtkBooleanMacro(SearchInward, bool);
  ///@}

  ///@{
  /**
   * A vertex this near the image's end, in millimeters, takes it for its target. Default 0:
   * solitary.
   */
  vtkSetClampMacro(ImageBoundaryDistance, double, 0, 1e6);
  vtkGetMacro(ImageBoundaryDistance, double);
  ///@}

  ///@{
  /**
   * Standard deviation in millimeters of the window in which the target moves to the strongest
   * edge. Default 0: it stays on the voxel's face.
   */
  vtkSetClampMacro(EdgeWindow, double, 0, 1000);
  vtkGetMacro(EdgeWindow, double);
  ///@}

  ///@{
  /**
   * Passes of averaging over neighbors that the normals get. Default 2.
   */
  vtkSetClampMacro(NormalSmoothingIterations, int, 0, 1000);
  vtkGetMacro(NormalSmoothingIterations, int);
  ///@}

  ///@{
  /**
   * Targets farther from those of the two-ring than this many robust deviations plus a voxel are
   * dropped. Default 3; zero keeps all.
   */
  vtkSetClampMacro(OutlierStandardDeviations, double, 0, 1e6);
  vtkGetMacro(OutlierStandardDeviations, double);
  ///@}

  ///@{
  /**
   * Greatest displacement, in voxels of the feature (of the greatest spacing). Default 0: not
   * limited.
   */
  vtkSetClampMacro(MaximumDisplacement, double, 0, 1e6);
  vtkGetMacro(MaximumDisplacement, double);
  ///@}

protected:
  vtkCorrespondenceSearch();
  ~vtkCorrespondenceSearch() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Threshold = 0;
  double SearchDistance = 40;
  double RunLength = 2;
  int RunVoxels = 4;
  bool SearchInward = true;
  double ImageBoundaryDistance = 0;
  double EdgeWindow = 0;
  int NormalSmoothingIterations = 2;
  double OutlierStandardDeviations = 3;
  double MaximumDisplacement = 0;

private:
  vtkCorrespondenceSearch(const vtkCorrespondenceSearch&) = delete;
  void operator=(const vtkCorrespondenceSearch&) = delete;
};

#endif
