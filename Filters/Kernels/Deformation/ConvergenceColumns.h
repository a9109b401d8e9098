/**
 * The columns of the convergence table.
 */
#ifndef FlipFreeConvergenceColumns_h
#define FlipFreeConvergenceColumns_h

#include "Deformation/OrganSegmentation.h"
#include "TableColumn.h"

#include <vector>

namespace FlipFree
{

const std::vector<TableColumn<IterationRecord>>& ConvergenceColumns();

} // namespace FlipFree

#endif
