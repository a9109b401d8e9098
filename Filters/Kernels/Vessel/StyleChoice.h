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

/// A wide outline that is wider than the thin one by this factor is taken to contain it.
constexpr double ClearlyWider = 1.2;

/// A vessel that was traced as a thin one may be wide if its mean radius is at least this fraction
/// of the radius at which wide vessels begin.
constexpr double LeastRadiusOfWide = 0.7;

/// Whether a vessel that was traced as a thin one, with this mean radius, may be a wide one.
inline bool MayBeWide(double radius, double wideRadius)
{
  return radius >= LeastRadiusOfWide * wideRadius;
}

/// What was traced in one style: the outline's mean radius in mm, and how well the image supports
/// it.
struct TracedStyle
{
  double Radius;
  double Support;
};

/// Whether the wide one is the vessel. The support that it needs decreases linearly with the thin
/// one's radius: from clearly more than the thin one's, where a vessel may just be wide, to clearly
/// less, where wide vessels begin. It decreases to twice as much less if the wide outline contains
/// the thin one: then the thin one follows something within the vessel, or beside it.
inline bool IsWideRather(const TracedStyle& wide, const TracedStyle& thin, double wideRadius)
{
  const double width = (thin.Radius / wideRadius - LeastRadiusOfWide) / (1 - LeastRadiusOfWide);
  const double less = (wide.Radius >= ClearlyWider * thin.Radius ? 2 : 1) * ClearlyMore;
  return wide.Support >
    thin.Support + ClearlyMore - (ClearlyMore + less) * std::clamp(width, 0.0, 1.0);
}

} // namespace FlipFree

#endif
