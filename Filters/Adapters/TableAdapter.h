/**
 * Private to the modules, never installed: numbers as the columns of a vtkTable.
 */
#ifndef FlipFreeTableAdapter_h
#define FlipFreeTableAdapter_h

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>

namespace FlipFree
{

template <typename ArrayType, typename T>
void AddColumnOf(vtkTable* table, const char* name, const T& value)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}

/// Adds a column to a table of one row.
inline void AddColumn(vtkTable* table, const char* name, double value)
{
  AddColumnOf<vtkDoubleArray>(table, name, value);
}
inline void AddColumn(vtkTable* table, const char* name, int value)
{
  AddColumnOf<vtkIntArray>(table, name, value);
}
inline void AddColumn(vtkTable* table, const char* name, const std::string& value)
{
  AddColumnOf<vtkStringArray>(table, name, value);
}

} // namespace FlipFree

#endif
