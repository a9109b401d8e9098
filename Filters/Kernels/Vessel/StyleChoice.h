/**
 * Thin or wide: in doubt, both are sought, and the image decides. A wide vessel that is mistaken
 * for a thin one comes out too narrow, or the path leads elsewhere; either way, the image supports
 * the outline less.
 */
#ifndef FlipFreeStyleChoice_h
#define FlipFreeStyleChoice_h

namespace FlipFree
{

/// Support by which one result is clearly better than another.
constexpr double ClearlyMore = 0.05;

/// By the mean radius of what was found as a thin vessel, of that from which on vessels are wide.
inline bool MayBeWide(double radius, double wideRadius)
{
  return radius >= 0.7 * wideRadius;
}

/// What the support of a wide vessel must exceed, given that of the thin one in its place.
inline double LeastSupportOfWide(double radius, double support, double wideRadius)
{
  return radius >= wideRadius ? support - ClearlyMore : support + ClearlyMore;
}

} // namespace FlipFree

#endif
