/**
 * Private to the modules, never installed: what filters that look at whole images tell the
 * pipeline.
 */
#ifndef FlipFreePipelineAdapter_h
#define FlipFreePipelineAdapter_h

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
