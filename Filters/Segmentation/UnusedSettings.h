/**
 * Private to the toolkit, never installed. A filter that takes only the parameters of another one
 * refuses what else is set there and would have no effect, rather than ignore it.
 */
#ifndef FlipFreeUnusedSettings_h
#define FlipFreeUnusedSettings_h

#include "Error.h"

#include "vtkAlgorithm.h"
#include "vtkNew.h"

#include <algorithm>
#include <string>

namespace FlipFree
{

/// `owner` is how to get the filter, such as `GetFeature()`.
inline void RequireNoConnection(const std::string& owner, vtkAlgorithm* filter)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (filter->GetNumberOfInputConnections(port) > 0)
    {
      throw Error(ErrorCode::OutOfRange,
        owner + " has an input on port " + std::to_string(port) +
          ", which is not used; disconnect it, or set another object");
    }
  }
}

/// `instead` is where the seed belongs.
template <typename Filter>
void RequireNoSeed(const std::string& owner, Filter* filter, const std::string& instead)
{
  vtkNew<Filter> unset;
  if (!std::equal(filter->GetSeedCenter(), filter->GetSeedCenter() + 3, unset->GetSeedCenter()) ||
    filter->GetSeedRadius() != unset->GetSeedRadius())
  {
    throw Error(ErrorCode::OutOfRange,
      owner + " has a seed sphere, which is not used; give it to " + instead +
        ", and leave SeedCenter and SeedRadius of " + owner + " at their defaults");
  }
}

} // namespace FlipFree

#endif
