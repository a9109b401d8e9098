/**
 * @class   vtkCorrespondenceSearch
 * @brief   from each vertex along its normal to the organ's boundary
 *
 * Correspondence search (section 3.3 and Eq. 2 of the paper). A vertex in the foreground looks
 * outward for a run of background voxels; one in the background looks inward for a run of
 * foreground voxels. The target is the point where the line enters that run. A vertex that finds
 * none is solitary. Lines are walked voxel by voxel, exactly, under any direction matrix.
 *
 * Input port 0: vtkPolyData, closed, with four neighbors at every vertex.
 * Input port 1: vtkImageData, the feature: one scalar component, 0 to 1 (SetFeatureConnection);
 * where it is not finite there is no data, and a search line ends as at the image's border.
 * Its field data `FeatureThreshold` (1 double), `SeedRadius` (1 double, mm) and `EdgeRamp` (3
 * doubles), as vtkGMMFeatureFilter attaches them, are used where present.
 * Input port 2, optional: vtkImageData, the smoothed image of the same grid, in whose edges the
 * target is refined (SetEdgeConnection).
 * Output port 0: the surface with the point arrays `Displacement` (3 doubles, mm: target minus
 * point; zero where solitary) and `Correspondence` (unsigned char: 0 solitary, 1 matched). Field
 * data `MeanDistance` (1 double, mm): mean distance to the targets found, before they are limited.
 *
 * The images, the foreground and the mesh's contours are kept between updates: after
 * writing voxels in place, call Modified() on the image.
 *
 * Errors, with a code of FlipFreeErrorCode.h: a surface that is open or not four-valent; images
 * without scalars or with several components; an edge image with a grid other than the feature's;
 * field data of another size or not finite; a property that is NaN.
 */
#ifndef vtkCorrespondenceSearch_h
#define vtkCorrespondenceSearch_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkImageData;

namespace FlipFree
{
struct TargetSettings;
}

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
   * Gamma of Eq. 2, 0 to 1: features at or above it are foreground. Default 0: the feature's field
   * data `FeatureThreshold`, or 0.5 without it. vtkFlipFreeSegmentation refuses
   * others; there, FeatureThreshold of vtkGMMFeatureFilter counts.
   */
  void SetThreshold(double value);
  double GetThreshold() const;
  ///@}

  ///@{
  /**
   * Length of the search lines, in millimeters. Default 0, 0 to 1e6; 0 derives it from SearchScale.
   */
  void SetSearchDistance(double value);
  double GetSearchDistance() const;
  ///@}

  ///@{
  /**
   * Length of the search lines in seed radii, clamped to 15 to 60 mm. Default 1.6; 0 to 1e6.
   * Used only if SearchDistance is 0. The radius is the feature's field data `SeedRadius`, or 25 mm
   * without it.
   */
  void SetSearchScale(double value);
  double GetSearchScale() const;
  ///@}

  ///@{
  /**
   * Length of the run of voxels beyond the boundary (Eq. 2), in millimeters. Default 2, 0 to 1000;
   * 0 counts RunVoxels instead.
   */
  void SetRunLength(double value);
  double GetRunLength() const;
  ///@}

  ///@{
  /**
   * Length of the run in voxels, the paper's N + 1. Default 4; 1 to 1000. Used only if
   * RunLength is 0.
   */
  void SetRunVoxels(int value);
  int GetRunVoxels() const;
  ///@}

  ///@{
  /**
   * Vertices in the background look inward for the foreground. Default on; off reads Eq. 2
   * literally.
   */
  void SetSearchInward(bool value);
  bool GetSearchInward() const;
  vtkBooleanMacro(SearchInward, bool);
  ///@}

  ///@{
  /**
   * Standard deviation of the Gaussian window, in millimeters, in which a target snaps to the
   * strongest edge of the image on port 2. Default 3, 0 to 1000; at most 1.5 voxels are used. With
   * 0, or without that image, targets stay on the faces of voxels. The whole method snaps at its
   * finest level only, and not to a carved foreground, which ends at the edge by a rule of its own.
   */
  void SetEdgeWindow(double value);
  double GetEdgeWindow() const;
  ///@}

  ///@{
  /**
   * A vertex this close to the image's boundary, in millimeters along its line, takes the boundary
   * as its target. Default 12, 0 to 1e6; with 0 it is solitary.
   */
  void SetImageBoundaryDistance(double value);
  double GetImageBoundaryDistance() const;
  ///@}

  ///@{
  /**
   * Passes that average the normals over neighbors before the search. Default 2; 0 to 1000.
   */
  void SetNormalSmoothingIterations(int value);
  int GetNormalSmoothingIterations() const;
  ///@}

  ///@{
  /**
   * Targets farther from the median of their two-ring than this many robust standard deviations,
   * plus a voxel, are dropped. Default 3, 0 to 1e6; 0 keeps all.
   */
  void SetOutlierStandardDeviations(double value);
  double GetOutlierStandardDeviations() const;
  ///@}

  ///@{
  /**
   * Maximum displacement in one iteration, in voxels of the greatest spacing. Default 8, 0 to 1e6;
   * 0 does not limit it.
   */
  void SetMaximumDisplacement(double value);
  double GetMaximumDisplacement() const;
  ///@}

protected:
  vtkCorrespondenceSearch();
  ~vtkCorrespondenceSearch() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Threshold = 0;

private:
  friend class vtkFlipFreeSegmentation; // takes the settings as a whole

  void RequireProperties() const;

  const std::unique_ptr<FlipFree::TargetSettings> Settings;

  vtkCorrespondenceSearch(const vtkCorrespondenceSearch&) = delete;
  void operator=(const vtkCorrespondenceSearch&) = delete;

  struct Workspace;
  std::unique_ptr<Workspace> Kept; ///< from update to update, while the inputs stay
};

#endif
