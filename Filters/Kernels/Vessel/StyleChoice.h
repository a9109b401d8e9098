/**
 * Thin or wide: in doubt, both are sought, and the image decides. A wide vessel that is mistaken
 * for a thin one comes out too narrow, or the path leads elsewhere; either way, the image supports
 * the outline less.
 */
#ifndef FlipFreeStyleChoice_h
#define FlipFreeStyleChoice_h

#include <algorithm>

namespace FlipFree
{

/// Support by which one result is clearly better than another.
constexpr double ClearlyMore = 0.05;

/// Of the radius from which on vessels are wide, what the mean radius of a wide one is at least
/// where it was found as a thin one.
constexpr double LeastRadiusOfWide = 0.7;

/// By the mean radius of what was found as a thin vessel, of that from which on vessels are wide.
inline bool MayBeWide(double radius, double wideRadius)
{
  return radius >= LeastRadiusOfWide * wideRadius;
}

/// What the support of a wide vessel must exceed, given that of the thin one in its place: clearly
/// more at the least radius that may be a wide vessel's, clearly less at that from which on vessels
/// are wide, and in between in proportion.
inline double LeastSupportOfWide(double radius, double support, double wideRadius)
{
  const double width = (radius / wideRadius - LeastRadiusOfWide) / (1 - LeastRadiusOfWide);
  return support + ClearlyMore * (1 - 2 * std::clamp(width, 0.0, 1.0));
}

} // namespace FlipFree

#endif
