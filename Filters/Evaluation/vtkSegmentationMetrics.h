/**
 * @class   vtkSegmentationMetrics
 * @brief   overlap and surface distance of a segmentation and a reference
 *
 * Compares a segmentation, given as a label map or as a surface, with a reference label map:
 *  - overlap of the voxels: Dice 2 |A and B| / (|A| + |B|), Jaccard |A and B| / |A or B| (the
 *    paper's "volume overlap"), and the relative volume difference (|A| - |B|) / |B|, negative
 *    where the segmentation A is smaller than the reference B;
 *  - distance of the surfaces in millimeters, from area-weighted samples of both surfaces to the
 *    closest point of the other one: the average (ASD) and the root mean square (RMS) over the
 *    pooled samples, the 95th percentile (HD95, the greater one of the two directions) and the
 *    maximum (HD).
 *
 * The surface of a label map runs halfway between the voxels inside and outside and includes their
 * steps: ASD is 2.7 mm between spheres 3 mm apart on voxels of 1.2 x 1.2 x 3 mm, and 0.3 mm
 * between a sphere and its own voxels. LabelSmoothing removes the steps, which is more exact for
 * smooth shapes (2.9 and 0.15 mm). A segmentation that is a surface is voxelized on the reference's
 * grid for the overlap, as by vtkSurfaceToLabelMap. Its distances are measured directly, or from
 * the surface of its voxels if ScoreVoxelization is on; the table says which. Voxel spacing and
 * direction matrices are honored.
 *
 * Input port 0: the segmentation, a vtkImageData (label map, scalars of one component of any type)
 * or a vtkPolyData (closed surface of polygons, in the reference's physical coordinates).
 *
 * Input port 1: vtkImageData, the reference label map (SetReferenceData or SetReferenceConnection).
 * The voxels of two label maps must lie in the same places, up to a tenth of the least spacing;
 * either may be cropped, and have its axes in any order. Both are compared on a grid that holds
 * them: what lies outside the grid of one of them counts as not in it.
 *
 * Output port 0: vtkTable with one row and the columns Dice, Jaccard, RelativeVolumeDifference
 * (fractions), ASD, RMS, HD95, HD (mm), SegmentationVolume, ReferenceVolume (ml, of the voxels),
 * all double, and two strings: OverlapOf, "label map" or "voxelized mesh", and DistanceOf, "surface
 * of label map", "mesh" or "surface of voxelized mesh".
 *
 * Errors, with a code of FlipFreeErrorCode.h and with an empty table and measures that are not a
 * number: an empty mask on either port, gray values in place of labels (fractions, more than three
 * values that are no labels, or more than 255 values, 1000 if one of them is chosen), label maps
 * with other voxels, a label map without scalars, with several components, of bits, or with a
 * spacing that is not positive, a surface that is empty, open or not finite, or encloses no voxel
 * center of the reference, a surface that would need more than a hundred million samples (raise
 * SampleSpacing), a SampleSpacing that is not a number. Warnings, which still give measures:
 *  - a reference of several labels, if none of them was chosen and the segmentation has only one;
 *  - labels beside a few negative numbers;
 *  - a surface that lies, in part, more than a voxel outside the reference's grid, or label maps
 *    with voxels outside the grid of the other.
 *
 * Definitions: L. Maier-Hein et al., Metrics reloaded, Nature Methods 21 (2024), but with
 * area-weighted samples instead of boundary voxels, by which many other programs measure: their ASD
 * of the same masks was 0.59 to 1.14 times this one in 23 organs.
 */
#ifndef vtkSegmentationMetrics_h
#define vtkSegmentationMetrics_h

#include "FlipFreeEvaluationModule.h"
#include "vtkTableAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkImageData;

namespace FlipFree
{
struct ScoreSettings;
struct SegmentationScores;
}

class FLIPFREEEVALUATION_EXPORT vtkSegmentationMetrics : public vtkTableAlgorithm
{
public:
  static vtkSegmentationMetrics* New();
  vtkTypeMacro(vtkSegmentationMetrics, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The reference label map (input port 1).
   */
  void SetReferenceData(vtkImageData* labelMap);
  void SetReferenceConnection(vtkAlgorithmOutput* output);
  ///@}

  ///@{
  /**
   * Value of the voxels of the segmentation that count as inside; a negative one stands for every
   * value but 0. Not used where the segmentation is a surface. Default -1.
   */
  void SetSegmentationLabel(int value);
  int GetSegmentationLabel() const;
  ///@}

  ///@{
  /**
   * Value of the voxels of the reference that count as inside; a negative one stands for every
   * value but 0. Default -1.
   */
  void SetReferenceLabel(int value);
  int GetReferenceLabel() const;
  ///@}

  ///@{
  /**
   * Maximum distance in mm between neighboring samples of a surface; smaller triangles have one
   * sample, and none has more than 512 x 512. Default 1; 0.001 to 1000.
   */
  void SetSampleSpacing(double value);
  double GetSampleSpacing() const;
  ///@}

  ///@{
  /**
   * Iterations of windowed sinc smoothing (as by vtkWindowedSincPolyDataFilter, pass band 0.1) of
   * the surfaces of label maps. 20 are customary; they keep the volume, but round off corners and
   * parts thinner than a few voxels. Default 0, none; 0 to 100.
   */
  void SetLabelSmoothing(int value);
  int GetLabelSmoothing() const;
  ///@}

  ///@{
  /**
   * Whether distances are those of the voxelized surface, to compare a surface on equal terms with
   * segmentations that are label maps. Default off: the surface itself is measured.
   */
  void SetScoreVoxelization(bool value);
  bool GetScoreVoxelization() const;
  vtkBooleanMacro(ScoreVoxelization, bool);
  ///@}

  ///@{
  /**
   * The measures of the last update, as in the table. Not a number before the first update and
   * after one that failed or was aborted.
   */
  double GetDice() const;
  double GetJaccard() const;
  double GetRelativeVolumeDifference() const;
  double GetASD() const;
  double GetRMS() const;
  double GetHD95() const;
  double GetHD() const;
  double GetSegmentationVolume() const;
  double GetReferenceVolume() const;
  std::string GetOverlapOf() const;
  std::string GetDistanceOf() const;
  ///@}

  /**
   * The measures of the last update in a few lines, with units; empty before the first update and
   * after one that failed or was aborted.
   */
  std::string GetSummary() const;

protected:
  vtkSegmentationMetrics();
  ~vtkSegmentationMetrics() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSegmentationMetrics(const vtkSegmentationMetrics&) = delete;
  void operator=(const vtkSegmentationMetrics&) = delete;

  FlipFree::SegmentationScores Measure(vtkDataObject* input, vtkImageData* referenceImage);

  const std::unique_ptr<FlipFree::ScoreSettings> Settings;
  const std::unique_ptr<FlipFree::SegmentationScores> Scores;
};

#endif
