/**
 * Watches the progress of a filter, and aborts it on demand.
 */
#ifndef FlipFreeProgressWatch_h
#define FlipFreeProgressWatch_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

namespace FlipFree
{

constexpr double NoAbort = 2; ///< a progress that no filter reports

class ProgressWatch
{
public:
  /// Aborts the filter as soon as it reports this progress, or at this report, counted from 1.
  explicit ProgressWatch(vtkAlgorithm* filter, double abortAt = NoAbort, int abortAtReport = 0)
    : Filter(filter)
    , AbortAt(abortAt)
    , AbortAtReport(abortAtReport)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* progress)
      { static_cast<ProgressWatch*>(self)->Look(*static_cast<double*>(progress)); });
    filter->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }
  ~ProgressWatch()
  {
    this->Filter->RemoveObserver(this->Command);
    if (this->Aborted())
    {
      this->Filter->AbortExecuteOff(); // from VTK 9.2 on, a request stands until it is taken back
    }
  }
  ProgressWatch(const ProgressWatch&) = delete;
  void operator=(const ProgressWatch&) = delete;

  bool Aborted() const { return this->ReportsAfterAbort >= 0; }

  /// After at most the report that was on its way and the pipeline's of the end.
  bool StoppedSoon() const { return this->Aborted() && this->ReportsAfterAbort <= 2; }

  int Reports = 0;
  int ReportsAfterAbort = -1; ///< -1: not aborted
  double Last = 0;            ///< progress
  double ProgressOfAbort = 0;

private:
  void Look(double progress)
  {
    EXPECT_GE(progress, this->Last);
    this->Last = progress;
    ++this->Reports;
    if (this->Aborted())
    {
      ++this->ReportsAfterAbort;
    }
    else if (progress >= this->AbortAt || this->Reports == this->AbortAtReport)
    {
      this->ReportsAfterAbort = 0;
      this->ProgressOfAbort = progress;
      this->Filter->AbortExecuteOn();
    }
  }

  vtkAlgorithm* Filter;
  double AbortAt;
  int AbortAtReport;
  vtkNew<vtkCallbackCommand> Command;
};

} // namespace FlipFree

#endif
