/**
 * Private to the modules, never installed: numbers as the columns of a vtkTable.
 */
#ifndef FlipFreeTableAdapter_h
#define FlipFreeTableAdapter_h

#include "TableColumn.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>
#include <vector>

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

template <typename ArrayType, typename Record>
void AddColumnOf(vtkTable* table, const TableColumn<Record>& from,
  const std::vector<Record>& records)
{
  vtkNew<ArrayType> column;
  column->SetName(from.Name);
  column->Allocate(static_cast<vtkIdType>(records.size()));
  for (const Record& record : records)
  {
    column->InsertNextValue(static_cast<typename ArrayType::ValueType>(from.Read(record)));
  }
  table->AddColumn(column);
}

/// Adds columns with a row per record.
template <typename Record>
void AddColumns(vtkTable* table, const std::vector<TableColumn<Record>>& columns,
  const std::vector<Record>& records)
{
  for (const TableColumn<Record>& column : columns)
  {
    if (column.IsCount)
    {
      AddColumnOf<vtkIntArray>(table, column, records);
    }
    else
    {
      AddColumnOf<vtkDoubleArray>(table, column, records);
    }
  }
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
