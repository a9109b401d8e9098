/**
 * Private to the toolkit, never installed: all parameters of a filter at once, for front ends that
 * have them from the kernels' tables.
 */
#ifndef FlipFreeFilterSettings_h
#define FlipFreeFilterSettings_h

#include "Deformation/VolumeSegmentation.h"
#include "LabelSurface/LabelSurfaces.h"
#include "Vessel/VesselSegmentation.h"

#include "vtkFlipFreeLabelSurfaces.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkVesselAlgorithm.h"

#include <string>

namespace FlipFree
{

class FilterSettings
{
public:
  static VolumeSegmentationSettings Of(const vtkFlipFreeSegmentation* filter)
  {
    return filter->GetSettings();
  }

  /// Throws Error where its stages have what would have no effect.
  static void RequireNoUnusedOfStages(const vtkFlipFreeSegmentation* filter,
    const std::string& owner)
  {
    filter->RequireNoUnusedStageSettings(owner);
  }

  /// Of the stages, too.
  static void Set(vtkFlipFreeSegmentation* filter, const VolumeSegmentationSettings& settings)
  {
    filter->UseSettings(settings);
  }

  static void Set(vtkVesselAlgorithm* filter, const VesselSegmentationSettings& settings)
  {
    *filter->Settings = settings;
    filter->Modified();
  }

  static void Set(vtkFlipFreeLabelSurfaces* filter, const LabelSurfaceSettings& settings)
  {
    *filter->Settings = settings;
    filter->Modified();
  }
};

} // namespace FlipFree

#endif
