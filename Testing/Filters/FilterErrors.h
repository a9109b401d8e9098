/**
 * What a filter says when it is given bad input.
 */
#ifndef FlipFreeFilterErrors_h
#define FlipFreeFilterErrors_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// Collects the errors of an algorithm and, apart, those of its executive, instead of printing
/// them.
class FilterErrors
{
public:
  explicit FilterErrors(vtkAlgorithm* algorithm)
  {
    Listen(algorithm, this->OfFilter);
    Listen(algorithm->GetExecutive(), this->OfExecutive);
  }
  FilterErrors(const FilterErrors&) = delete;
  void operator=(const FilterErrors&) = delete;

  /// The message of the only error that the filter reported; otherwise how many there were.
  std::string Only() const
  {
    return this->OfFilter.size() == 1 ? this->OfFilter[0]
                                      : std::to_string(this->OfFilter.size()) + " errors";
  }

  std::vector<std::string> OfFilter;
  std::vector<std::string> OfExecutive;

private:
  static void Listen(vtkObject* object, std::vector<std::string>& messages)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&messages);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* client, void* message) {
        static_cast<std::vector<std::string>*>(client)->push_back(
          static_cast<const char*>(message));
      });
    object->AddObserver(vtkCommand::ErrorEvent, command);
  }
};

/// Updates an algorithm and gives the only error that it reports itself, or how many it reported.
inline std::string ErrorOfUpdate(vtkAlgorithm* algorithm)
{
  FilterErrors errors(algorithm);
  algorithm->Update();
  std::string message = errors.Only();
  algorithm->RemoveAllObservers();
  algorithm->GetExecutive()->RemoveAllObservers();
  return message;
}

} // namespace FlipFree

#endif
