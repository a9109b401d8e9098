#include "Run.h"

#include "Failure.h"
#include "Interrupt.h"
#include "Messages.h"
#include "ProgressBar.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <chrono>

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

double Run(vtkAlgorithm* algorithm, const std::string& title, const std::function<void()>& work)
{
  StopIfInterrupted();
  TakeVtkError(); // nothing from before is this one's fault
  vtkNew<Watcher> watcher;
  watcher->Title = title;
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, watcher);
  const auto start = std::chrono::steady_clock::now();
  if (work)
  {
    work();
  }
  else
  {
    algorithm->Update();
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  algorithm->RemoveObserver(tag);
  ProgressBar::Clear();
  StopIfInterrupted();
  const std::string error = TakeVtkError();
  if (!error.empty())
  {
    throw Failure(error);
  }
  return seconds.count();
}

void StopIfInterrupted()
{
  if (WasInterrupted())
  {
    throw Interrupted();
  }
}

} // namespace Command
