/**
 * Private to the module: what constraints do not change, kept from one run to the next while image,
 * start, seed and parameters stay the same.
 */
#ifndef FlipFreeSegmentationState_h
#define FlipFreeSegmentationState_h

#include "Deformation/VolumeSegmentation.h"

#include "vtkDataArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <memory>

class vtkImageData;

namespace FlipFree
{

/// Of what the segmenter was made. The seed is compared, the rest by modification times.
struct SegmentationStateKey
{
  vtkImageData* Image = nullptr;
  vtkMTimeType ImageTime = 0;
  vtkPolyData* Start = nullptr;
  vtkMTimeType StartTime = 0;
  vtkImageData* Labels = nullptr;
  vtkMTimeType LabelsTime = 0;
  vtkMTimeType ParameterTime = 0;
  SeedSphere Seed;
};

class SegmentationState
{
public:
  /// Keeps the voxels alive, not the image.
  SegmentationState(const SegmentationStateKey& key, vtkDataArray* voxels,
    std::unique_ptr<VolumeSegmenter> segmenter);

  bool IsOf(const SegmentationStateKey& key) const;
  VolumeSegmenter& Segmenter() const { return *this->Volume; }

private:
  const SegmentationStateKey MadeOf;
  const vtkSmartPointer<vtkDataArray> Voxels;
  const std::unique_ptr<VolumeSegmenter> Volume;
};

} // namespace FlipFree

#endif
