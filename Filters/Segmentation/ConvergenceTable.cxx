#include "ConvergenceTable.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkTable.h"

namespace FlipFree
{
namespace
{

template <typename Array, typename Read>
void AddColumn(const std::vector<IterationRecord>& records, const char* name, const Read& read,
  vtkTable* table)
{
  vtkNew<Array> column;
  column->SetName(name);
  column->Allocate(static_cast<vtkIdType>(records.size()));
  for (const IterationRecord& record : records)
  {
    column->InsertNextValue(read(record));
  }
  table->AddColumn(column);
}

} // namespace

void FillConvergenceTable(const std::vector<IterationRecord>& records, vtkTable* table)
{
  const auto count = [&](const char* name, const auto& read)
  { AddColumn<vtkIntArray>(records, name, read, table); };
  const auto number = [&](const char* name, const auto& read)
  { AddColumn<vtkDoubleArray>(records, name, read, table); };
  count("Iteration", [](const IterationRecord& r) { return r.Iteration; });
  count("Level", [](const IterationRecord& r) { return r.Level; });
  count("Vertices", [](const IterationRecord& r) { return r.Vertices; });
  number("MeanDistance", [](const IterationRecord& r) { return r.Targets.MeanDistance; });
  count("Matched", [](const IterationRecord& r) { return r.Targets.Matched; });
  count("Solitary", [](const IterationRecord& r) { return r.Targets.Solitary; });
  count("Flipping", [](const IterationRecord& r) { return r.Step.Flipping; });
  count("Guarded", [](const IterationRecord& r) { return r.Step.Guarded; });
  number("SearchSeconds", [](const IterationRecord& r) { return r.SearchSeconds; });
  number("FlipSeconds", [](const IterationRecord& r) { return r.Step.FlipSeconds; });
  number("SolveSeconds", [](const IterationRecord& r) { return r.Step.SolveSeconds; });
  number("GuardSeconds", [](const IterationRecord& r) { return r.Step.GuardSeconds; });
}

} // namespace FlipFree
