/**
 * The columns of the convergence table.
 */
#ifndef FlipFreeConvergenceColumns_h
#define FlipFreeConvergenceColumns_h

#include "Deformation/OrganSegmentation.h"

#include <vector>

namespace FlipFree
{

struct ConvergenceColumn
{
  const char* Name;
  bool IsCount; ///< whole numbers
  double (*Read)(const IterationRecord&);
};

const std::vector<ConvergenceColumn>& ConvergenceColumns();

} // namespace FlipFree

#endif
