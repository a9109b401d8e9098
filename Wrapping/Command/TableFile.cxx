#include "TableFile.h"

#include "OutputFile.h"

#include "Exchange/TableText.h"

#include "vtkAbstractArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

namespace Command
{
namespace
{

FlipFree::TableCell CellOf(vtkAbstractArray* column, vtkIdType row)
{
  const vtkVariant value = column->GetVariantValue(row);
  if (value.IsString())
  {
    return value.ToString();
  }
  if (value.IsFloat() || value.IsDouble())
  {
    return value.ToDouble();
  }
  return std::int64_t{ value.ToTypeInt64() };
}

} // namespace

void WriteTable(const std::string& name, vtkTable* table)
{
  std::vector<std::string> columns;
  std::vector<std::vector<FlipFree::TableCell>> rows(table->GetNumberOfRows());
  for (vtkIdType number = 0; number < table->GetNumberOfColumns(); ++number)
  {
    vtkAbstractArray* const column = table->GetColumn(number);
    columns.emplace_back(column->GetName());
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      rows[row].push_back(CellOf(column, static_cast<vtkIdType>(row)));
    }
  }
  WriteText(name, FlipFree::TextOfTable(columns, rows));
}

} // namespace Command
