/**
 * Private to the modules, never installed: what sources of images and filters that look at whole
 * images tell the pipeline.
 */
#ifndef FlipFreePipelineAdapter_h
#define FlipFreePipelineAdapter_h

#include "KernelTypes.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace FlipFree
{

/// Asks for the whole extent of an input. Does nothing for a missing input (null) or one without
/// an extent.
inline void RequestWholeExtent(vtkInformation* input)
{
  using Executive = vtkStreamingDemandDrivenPipeline;
  if (input && input->Has(Executive::WHOLE_EXTENT()))
  {
    input->Set(Executive::UPDATE_EXTENT(), input->Get(Executive::WHOLE_EXTENT()), 6);
  }
}

/// Announces an image of one component, whose extent starts at zero.
inline void AnnounceImage(const ImageGeometry& geometry, int scalarType, vtkInformation* image)
{
  const int extent[6] = { 0, geometry.Dimensions[0] - 1, 0, geometry.Dimensions[1] - 1, 0,
    geometry.Dimensions[2] - 1 };
  const RowMajorMatrix direction = geometry.Direction;
  image->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  image->Set(vtkDataObject::SPACING(), geometry.Spacing.data(), 3);
  image->Set(vtkDataObject::ORIGIN(), geometry.Origin.data(), 3);
  image->Set(vtkDataObject::DIRECTION(), direction.data(), 9);
  vtkDataObject::SetPointDataActiveScalarInfo(image, scalarType, 1);
}

/// Announces a label map with the geometry of an image.
inline void AnnounceLabelMap(vtkInformation* image, vtkInformation* labelMap)
{
  labelMap->CopyEntry(image, vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  labelMap->CopyEntry(image, vtkDataObject::SPACING());
  labelMap->CopyEntry(image, vtkDataObject::ORIGIN());
  labelMap->CopyEntry(image, vtkDataObject::DIRECTION());
  vtkDataObject::SetPointDataActiveScalarInfo(labelMap, VTK_UNSIGNED_CHAR, 1);
}

} // namespace FlipFree

#endif
