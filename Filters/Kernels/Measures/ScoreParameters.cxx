#include "Measures/ScoreParameters.h"

namespace FlipFree
{

const ParameterTable<ScoreSettings>& ScoreParameters()
{
#define ENTRY(Name, type, field, minimum, maximum)                                                 \
  NumberParameter<type, ScoreSettings>(                                                            \
    #Name, [](auto& settings) -> auto& { return field; }, minimum, maximum),
  static const ParameterTable<ScoreSettings> table{ FLIPFREE_SCORE_PARAMETERS(ENTRY, settings.) };
#undef ENTRY
  return table;
}

} // namespace FlipFree
