#include "SegmentationRun.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkTable.h"
#include "vtkVariant.h"

StageSeconds StageSecondsOf(vtkFlipFreeSegmentation* filter)
{
  const double* stages = filter->GetStageSeconds();
  vtkTable* convergence = filter->GetConvergence();
  StageSeconds seconds;
  seconds.Smoothing = stages[0];
  seconds.Feature = stages[1];
  seconds.Deformation = stages[2];
  seconds.Labels = stages[3];
  seconds.Iterations = static_cast<int>(convergence->GetNumberOfRows());
  seconds.Search = SumOfColumn(convergence, "SearchSeconds");
  seconds.Flips = SumOfColumn(convergence, "FlipSeconds");
  seconds.Solve = SumOfColumn(convergence, "SolveSeconds");
  seconds.Guard = SumOfColumn(convergence, "GuardSeconds");
  return seconds;
}

double SumOfColumn(vtkTable* table, const char* name)
{
  double total = 0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    total += table->GetValueByName(row, name).ToDouble();
  }
  return total;
}
