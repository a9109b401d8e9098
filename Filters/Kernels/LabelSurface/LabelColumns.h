/**
 * The columns of the table of a label map's surfaces, for all front ends. They add the labels' names
 * after the first column, Name, and where there are files, those at the end, File.
 */
#ifndef FlipFreeLabelColumns_h
#define FlipFreeLabelColumns_h

#include "LabelSurface/LabelMeasures.h"
#include "TableColumn.h"

#include <vector>

namespace FlipFree
{

const std::vector<TableColumn<LabelMeasures>>& LabelColumns();

} // namespace FlipFree

#endif
