#include "Deformation/ConvergenceColumns.h"

namespace FlipFree
{

const std::vector<TableColumn<IterationRecord>>& ConvergenceColumns()
{
  using Record = const IterationRecord&;
  static const std::vector<TableColumn<IterationRecord>> columns{
    { "Iteration", true, [](Record r) -> double { return r.Iteration; } },
    { "Level", true, [](Record r) -> double { return r.Level; } },
    { "Vertices", true, [](Record r) -> double { return r.Vertices; } },
    { "MeanDistance", false, [](Record r) { return r.Targets.MeanDistance; } },
    { "Matched", true, [](Record r) -> double { return r.Targets.Matched; } },
    { "Solitary", true, [](Record r) -> double { return r.Targets.Solitary; } },
    { "Flipping", true, [](Record r) -> double { return r.Step.Flipping; } },
    { "Guarded", true, [](Record r) -> double { return r.Step.Guarded; } },
    { "SearchSeconds", false, [](Record r) { return r.SearchSeconds; } },
    { "FlipSeconds", false, [](Record r) { return r.Step.FlipSeconds; } },
    { "SolveSeconds", false, [](Record r) { return r.Step.SolveSeconds; } },
    { "GuardSeconds", false, [](Record r) { return r.Step.GuardSeconds; } },
  };
  return columns;
}

} // namespace FlipFree
