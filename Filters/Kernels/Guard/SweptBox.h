/**
 * The bounding volume of all that a motion passes: one box around both ends of every way.
 *
 * Where two of them are apart, so are their contents, however far each vertex is let go. That is
 * less often than for boxes that move along, but it need not be asked again when the motion is
 * scaled back.
 */
#ifndef FlipFreeSweptBox_h
#define FlipFreeSweptBox_h

#include "Guard/MotionCertificate.h"

#include <algorithm>
#include <array>
#include <limits>

namespace FlipFree
{

class alignas(32) SweptBox
{
public:
  /// Holds nothing yet.
  SweptBox() = default;

  /// A triangle, with a margin around it. The boxes of one motion can be compared with each other.
  SweptBox(const RoughMotion& motion, const std::array<int, 3>& triangle, float margin)
  {
    Lanes low = motion.Ends[0][triangle[0]];
    Lanes high = low;
    for (const auto& points : motion.Ends)
    {
      for (int vertex : triangle)
      {
        low = low.min(points[vertex]);
        high = high.max(points[vertex]);
      }
    }
    // The fourth lane holds the greatest coordinate: their rounding is relative to that. Where
    // numbers underflow it is not, but far below the least margin.
    const float outwards = std::max(margin, MinimumMargin) + high[3] * Rounding;
    this->Low = low - outwards;
    this->High = high + outwards;
    this->Low[3] = 0;
    this->High[3] = 0;
  }

  void Merge(const SweptBox& other)
  {
    this->Low = this->Low.min(other.Low);
    this->High = this->High.max(other.High);
  }

  bool IsApartFrom(const SweptBox& other) const
  {
    return (other.Low - this->High).max(this->Low - other.High).maxCoeff() > 0;
  }

private:
  // Single precision, and a fourth lane that stays zero, for the vector units.
  using Lanes = Eigen::Array4f;
  // Of the conversion, of the margin, of the sum.
  static constexpr float Rounding = 4 * std::numeric_limits<float>::epsilon();
  static constexpr float MinimumMargin = 1e-30F;

  Lanes Low;
  Lanes High;
};

} // namespace FlipFree

#endif
