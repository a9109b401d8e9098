/**
 * The numbers in the table of a label map's surfaces, by their columns. Front ends add the labels'
 * names after the first one, as Name, and those of files at the end, as File.
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
