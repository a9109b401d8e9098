/**
 * Private to the module: the records of the iterations as the columns of a vtkTable.
 */
#ifndef FlipFreeConvergenceTable_h
#define FlipFreeConvergenceTable_h

#include "Deformation/OrganSegmentation.h"

#include <vector>

class vtkTable;

namespace FlipFree
{

void FillConvergenceTable(const std::vector<IterationRecord>& records, vtkTable* table);

} // namespace FlipFree

#endif
