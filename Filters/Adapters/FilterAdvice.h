/**
 * Private to the modules, never installed: which filter of VTK does what a kernel's message asks
 * for. Kernels know no filter, and other front ends have other remedies.
 */
#ifndef FlipFreeFilterAdvice_h
#define FlipFreeFilterAdvice_h

#include "Error.h"

namespace FlipFree
{

/// What to add to the message of such an error; empty where no filter helps.
inline const char* AdviceFor(ErrorCode code)
{
  switch (code)
  {
    case ErrorCode::InsideOut:
      return ", as vtkReverseSense does";
    case ErrorCode::RepeatedPoint:
      return ", by vtkCleanPolyData for example";
    default:
      return "";
  }
}

/// Returns make(). Errors of kernels get the advice at their end.
template <typename Make>
auto WithAdvice(const Make& make)
{
  try
  {
    return make();
  }
  catch (const Error& error)
  {
    throw Error(error.GetCode(), error.GetText() + AdviceFor(error.GetCode()));
  }
}

} // namespace FlipFree

#endif
