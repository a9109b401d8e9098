/**
 * Why a segmentation ended.
 */
#ifndef FlipFreeStopReason_h
#define FlipFreeStopReason_h

namespace FlipFree
{

enum class StopReason
{
  NotRun,                 ///< nothing has been segmented
  DistanceBelowTolerance, ///< the mean distance to the targets is small enough
  Converged,              ///< the mean distance no longer falls
  IterationLimit,
  NoBoundaryFound, ///< by any vertex; takes precedence over NotRefined
  NotRefined,      ///< the coarse surface could not be refined without intersecting itself
  Aborted
};

/// Of a surface that could not be refined and ended its last level for `reason`.
inline StopReason ReasonOfUnrefined(StopReason reason)
{
  return reason == StopReason::NoBoundaryFound ? reason : StopReason::NotRefined;
}

/// In words, such as "converged"; empty for NotRun.
inline const char* ToString(StopReason reason)
{
  switch (reason)
  {
    case StopReason::NotRun:
      return "";
    case StopReason::DistanceBelowTolerance:
      return "distance below tolerance";
    case StopReason::Converged:
      return "converged";
    case StopReason::IterationLimit:
      return "iteration limit";
    case StopReason::NoBoundaryFound:
      return "no boundary found";
    case StopReason::NotRefined:
      return "the coarse surface could not be refined";
    case StopReason::Aborted:
      return "aborted";
  }
  return "";
}

} // namespace FlipFree

#endif
