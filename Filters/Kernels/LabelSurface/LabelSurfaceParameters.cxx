#include "LabelSurface/LabelSurfaceParameters.h"

namespace FlipFree
{

const ParameterTable<LabelSurfaceSettings>& LabelSurfaceParameters()
{
  using Settings = LabelSurfaceSettings;
  static const ParameterTable<Settings> table{ FLIPFREE_LABEL_SURFACE_PARAMETERS(FLIPFREE_PARAMETER,
    settings.) };
  return table;
}

} // namespace FlipFree
