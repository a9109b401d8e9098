/**
 * Writes tables as CSV files: a line of column names, then a line per row.
 */
#ifndef FlipFreeCommandTableFile_h
#define FlipFreeCommandTableFile_h

#include <string>

class vtkTable;

namespace Command
{

void WriteTable(const std::string& name, vtkTable* table);

} // namespace Command

#endif
