/**
 * Errors and warnings of filters.
 */
#ifndef FlipFreeFilterErrors_h
#define FlipFreeFilterErrors_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

namespace FlipFree
{

/// Collects the errors of an algorithm, and separately those of its executive, instead of printing
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

/// Collects the warnings of an object instead of printing them.
inline void KeepWarnings(vtkObject* object, std::vector<std::string>& warnings)
{
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&warnings);
  keep->SetCallback([](vtkObject*, unsigned long, void* list, void* text)
    { static_cast<std::vector<std::string>*>(list)->emplace_back(static_cast<char*>(text)); });
  object->AddObserver(vtkCommand::WarningEvent, keep);
}

/// Updates an algorithm; its only error, or else the number of its errors.
inline std::string ErrorOfUpdate(vtkAlgorithm* algorithm)
{
  FilterErrors errors(algorithm);
  algorithm->Update();
  std::string message = errors.Only();
  algorithm->RemoveAllObservers();
  algorithm->GetExecutive()->RemoveAllObservers();
  return message;
}

/// Whether an output holds anything at all.
inline bool IsEmpty(vtkDataObject* output)
{
  for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
  {
    if (output->GetNumberOfElements(type) > 0)
    {
      return false;
    }
  }
  return true;
}

/// Updates an algorithm that must refuse its input: with a single error of its own, which contains
/// all parts and, behind a semicolon, a remedy; with an error code; and with empty outputs. The
/// message is printed, so that a run of these tests lists what users read.
inline void ExpectRefusal(vtkAlgorithm* algorithm, const std::vector<std::string>& parts)
{
  const std::string message = ErrorOfUpdate(algorithm);
  for (const std::string& part : parts)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
  }
  const std::size_t remedy = message.find("; ");
  EXPECT_NE(remedy, std::string::npos) << "no remedy in: " << message;
  EXPECT_EQ(message.find_first_of("{}"), std::string::npos) << "quantities in: " << message;
  EXPECT_NE(algorithm->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    EXPECT_TRUE(IsEmpty(algorithm->GetOutputDataObject(port))) << "output " << port;
  }
  // VTK puts file, line and class in front, and an empty line behind.
  const std::size_t begin = message.find("): ");
  std::cout << "  " << algorithm->GetClassName() << ": "
            << message.substr(begin == std::string::npos ? 0 : begin + 3,
                 message.find_last_not_of('\n') - begin - 2)
            << std::endl;
}

/// The same for input that VTK's pipeline refuses before the algorithm runs: a missing one, or one
/// of another type.
inline void ExpectPipelineRefusal(vtkAlgorithm* algorithm, const std::string& part)
{
  FilterErrors errors(algorithm);
  algorithm->Update();
  EXPECT_EQ(errors.OfFilter.size(), 0u);
  ASSERT_EQ(errors.OfExecutive.size(), 1u);
  EXPECT_NE(errors.OfExecutive[0].find(part), std::string::npos) << errors.OfExecutive[0];
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    EXPECT_TRUE(IsEmpty(algorithm->GetOutputDataObject(port))) << "output " << port;
  }
  algorithm->RemoveAllObservers();
  algorithm->GetExecutive()->RemoveAllObservers();
}

} // namespace FlipFree

#endif
