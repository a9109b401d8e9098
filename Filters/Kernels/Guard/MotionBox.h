/**
 * The bounding volume of a motion: one box at the start and one at the end.
 *
 * If one volume lies below the other along the same axis in both boxes, the two are apart at all
 * times between, since all positions are linear in time. Motion that both share does not matter,
 * however far it goes.
 */
#ifndef FlipFreeMotionBox_h
#define FlipFreeMotionBox_h

#include "Guard/MotionCertificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace FlipFree
{

// A cache line each.
class alignas(64) MotionBox
{
public:
  /// Holds nothing yet.
  MotionBox() = default;

  /// A vertex, with a margin around it. Coordinates must be in the range of a float.
  MotionBox(const Motion& motion, int vertex, double margin)
  {
    for (int end = 0; end < 2; ++end)
    {
      this->Low[end][3] = 0;
      this->High[end][3] = 0;
      const PointList& points = end == 0 ? motion.From : motion.To;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double low = points(vertex, axis) - margin;
        const double high = points(vertex, axis) + margin;
        // Rounded outwards.
        this->Low[end][axis] = static_cast<float>(low - std::abs(low) * Rounding);
        this->High[end][axis] = static_cast<float>(high + std::abs(high) * Rounding);
      }
    }
  }

  void Merge(const MotionBox& other)
  {
    for (int end = 0; end < 2; ++end)
    {
      this->Low[end] = this->Low[end].min(other.Low[end]);
      this->High[end] = this->High[end].max(other.High[end]);
    }
  }

  bool StaysApartFrom(const MotionBox& other) const
  {
    const Lanes below = (other.Low[0] - this->High[0]).min(other.Low[1] - this->High[1]);
    const Lanes above = (this->Low[0] - other.High[0]).min(this->Low[1] - other.High[1]);
    return below.max(above).maxCoeff() > 0;
  }

private:
  // Single precision, and a fourth lane that stays zero, for the vector units.
  using Lanes = Eigen::Array4f;
  static constexpr double Rounding = 2.0 * std::numeric_limits<float>::epsilon();

  std::array<Lanes, 2> Low;
  std::array<Lanes, 2> High;
};

} // namespace FlipFree

#endif
