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

/// A vessel that was traced as a thin one may be wide if its mean radius is at least this fraction
/// of the radius at which wide vessels begin.
constexpr double LeastRadiusOfWide = 0.7;

/// Whether a vessel that was traced as a thin one, with this mean radius, may be a wide one.
inline bool MayBeWide(double radius, double wideRadius)
{
  return radius >= LeastRadiusOfWide * wideRadius;
}

/// The support above which a wide vessel takes the place of a thin one of this mean radius and
/// support. It decreases linearly with the radius, from clearly more than the thin one's support,
/// where a vessel may just be wide, to clearly less, where wide vessels begin.
inline double LeastSupportOfWide(double radius, double support, double wideRadius)
{
  const double width = (radius / wideRadius - LeastRadiusOfWide) / (1 - LeastRadiusOfWide);
  return support + ClearlyMore * (1 - 2 * std::clamp(width, 0.0, 1.0));
}

} // namespace FlipFree

#endif
