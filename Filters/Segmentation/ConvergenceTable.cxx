#include "ConvergenceTable.h"

#include "Deformation/ConvergenceColumns.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkTable.h"

namespace FlipFree
{
namespace
{

template <typename Array>
void AddColumn(const std::vector<IterationRecord>& records, const ConvergenceColumn& from,
  vtkTable* table)
{
  vtkNew<Array> column;
  column->SetName(from.Name);
  column->Allocate(static_cast<vtkIdType>(records.size()));
  for (const IterationRecord& record : records)
  {
    column->InsertNextValue(static_cast<typename Array::ValueType>(from.Read(record)));
  }
  table->AddColumn(column);
}

} // namespace

void FillConvergenceTable(const std::vector<IterationRecord>& records, vtkTable* table)
{
  for (const ConvergenceColumn& column : ConvergenceColumns())
  {
    if (column.IsCount)
    {
      AddColumn<vtkIntArray>(records, column, table);
    }
    else
    {
      AddColumn<vtkDoubleArray>(records, column, table);
    }
  }
}

} // namespace FlipFree
