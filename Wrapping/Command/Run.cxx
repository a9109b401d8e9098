#include "Run.h"

#include "Failure.h"
#include "Interrupt.h"
#include "ProgressBar.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"

namespace Command
{
namespace
{

class Watcher : public vtkCommand
{
public:
  static Watcher* New() { return new Watcher; }

  void Execute(vtkObject* caller, unsigned long, void* progress) override
  {
    if (WasInterrupted())
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
    else if (progress)
    {
      ProgressBar::Show(this->Title, *static_cast<double*>(progress));
    }
  }

  std::string Title;
};

} // namespace

void Run(vtkAlgorithm* algorithm, const std::string& title, const FlipFree::QuantityNames& names,
  const std::function<void()>& work)
{
  StopIfInterrupted();
  const FilterReports reports(algorithm, names);
  vtkNew<Watcher> watcher;
  watcher->Title = title;
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, watcher);
  if (work)
  {
    work();
  }
  else
  {
    algorithm->Update();
  }
  algorithm->RemoveObserver(tag);
  ProgressBar::Clear();
  StopIfInterrupted();
  const std::string error = reports.Error();
  if (!error.empty())
  {
    throw Failure(error);
  }
}

void StopIfInterrupted()
{
  if (WasInterrupted())
  {
    throw Interrupted();
  }
}

} // namespace Command
