#include "Measures/ScoreParameters.h"

namespace FlipFree
{

const ParameterTable<ScoreSettings>& ScoreParameters()
{
  using Settings = ScoreSettings;
  static const ParameterTable<Settings> table{ FLIPFREE_SCORE_PARAMETERS(FLIPFREE_PARAMETER,
    settings.) };
  return table;
}

} // namespace FlipFree
