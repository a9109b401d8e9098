/**
 * Private to the modules, never installed: how a filter reports an error or a warning of a kernel,
 * so that VTK says it with the names of properties, and other front ends with theirs.
 *
 * While the filter's observers are told, its information holds the message with quantities in
 * braces, under the key MESSAGE of FlipFree. A front end that runs a filter observes ErrorEvent and
 * WarningEvent, and words what it finds there (QuantityNames.h).
 */
#ifndef FlipFreeFilterReport_h
#define FlipFreeFilterReport_h

#include "Error.h"

#include "vtkAlgorithm.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationKeyLookup.h"
#include "vtkInformationStringKey.h"

#include <string>

namespace FlipFree
{

/// One for all modules, each of which compiles this.
inline vtkInformationStringKey* FindOrMakeMessageKey()
{
  vtkInformationKey* const known = vtkInformationKeyLookup::Find("MESSAGE", "FlipFree");
  return known ? static_cast<vtkInformationStringKey*>(known)
               : vtkInformationStringKey::MakeKey("MESSAGE", "FlipFree");
}

// When the module is loaded, since VTK's list of keys is not safe for threads.
inline vtkInformationStringKey* const MessageKey = FindOrMakeMessageKey();

inline unsigned long ErrorCodeOf(const std::exception& error)
{
  const auto* const known = dynamic_cast<const Error*>(&error);
  return vtkErrorCode::UserError + (known ? static_cast<int>(known->GetCode()) : 0);
}

/// The filter has the message as long as this object lives.
class FilterMessage
{
public:
  FilterMessage(vtkAlgorithm* filter, const std::string& message)
    : Filter(filter)
  {
    this->Filter->GetInformation()->Set(MessageKey, message);
  }
  ~FilterMessage() { this->Filter->GetInformation()->Remove(MessageKey); }
  FilterMessage(const FilterMessage&) = delete;
  void operator=(const FilterMessage&) = delete;

private:
  vtkAlgorithm* Filter;
};

/// What the filter is reporting, with quantities in braces; null for another's text.
inline const char* ReportOf(vtkObject* filter)
{
  auto* const algorithm = vtkAlgorithm::SafeDownCast(filter);
  return algorithm ? algorithm->GetInformation()->Get(MessageKey) : nullptr;
}

} // namespace FlipFree

/// In a filter: vtkErrorMacro. `before` and `after` enclose the message of the error.
#define FlipFreeReportMacro(before, error, after)                                                  \
  do                                                                                               \
  {                                                                                                \
    const std::string reportedText = (before) + FlipFree::MessageOf(error) + (after);              \
    const FlipFree::FilterMessage reportedMessage(this, reportedText);                             \
    vtkErrorMacro(<< FlipFree::WithNames(reportedText));                                           \
  } while (false)

/// The same where the filter's work has failed: with the error's code.
#define FlipFreeErrorMacro(before, error, after)                                                   \
  do                                                                                               \
  {                                                                                                \
    const auto& reportedError = error;                                                             \
    this->SetErrorCode(FlipFree::ErrorCodeOf(reportedError));                                      \
    FlipFreeReportMacro(before, reportedError, after);                                             \
  } while (false)

/// In a filter: vtkWarningMacro for a kernel's message.
#define FlipFreeWarningMacro(text)                                                                 \
  do                                                                                               \
  {                                                                                                \
    const std::string& reportedText = (text);                                                      \
    const FlipFree::FilterMessage reportedMessage(this, reportedText);                             \
    vtkWarningMacro(<< FlipFree::WithNames(reportedText));                                         \
  } while (false)

#endif
