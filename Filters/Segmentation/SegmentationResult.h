/**
 * Private to the module: the outputs of the last run, from which any iteration can be copied again.
 */
#ifndef FlipFreeSegmentationResult_h
#define FlipFreeSegmentationResult_h

#include "IterationHistory.h"

#include "Deformation/VolumeSegmentation.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkTimeStamp.h"

#include <string>

class vtkInformationVector;

namespace FlipFree
{

struct SegmentationResult
{
  vtkNew<vtkPolyData> Surface;
  vtkNew<vtkImageData> Labels;
  vtkNew<vtkTable> Convergence;
  vtkNew<vtkTable> Questions;
  IterationHistory History;
  std::string Provenance; ///< of the surface
  vtkTimeStamp Time;

  /// The tables and, unless the run was aborted, the surface.
  void Store(const VolumeSegmentation& result, bool guarded);

  /// Whether nothing has changed since: neither the filter, last modified at `filterTime`, nor its
  /// inputs.
  bool IsUpToDate(vtkInformationVector** inputs, vtkMTimeType filterTime) const;

  /// The surface is that of the time that the pipeline asks for.
  void CopyTo(vtkInformationVector* outputs) const;
};

} // namespace FlipFree

#endif
