#include "LabelSurface/LabelSurfaceParameters.h"

namespace FlipFree
{

const ParameterTable<LabelSurfaceSettings>& LabelSurfaceParameters()
{
#define ENTRY(Name, type, field, minimum, maximum)                                                 \
  NumberParameter<type, LabelSurfaceSettings>(                                                     \
    #Name, [](auto& settings) -> auto& { return field; }, minimum, maximum),
  static const ParameterTable<LabelSurfaceSettings> table{ FLIPFREE_LABEL_SURFACE_PARAMETERS(ENTRY,
    settings.) };
#undef ENTRY
  return table;
}

} // namespace FlipFree
