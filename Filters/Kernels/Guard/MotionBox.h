/**
 * The bounding volume of moving vertices: one box around their positions at the start and one
 * around those at the end.
 *
 * Claim: if one volume lies below the other along the same axis in both boxes, their contents are
 * apart at all times. Proof: along that axis the difference between a vertex of one and a vertex of
 * the other is linear in time and positive at both ends. Shared motion cancels, however long it is.
 *
 * Rounding: boxes are kept in single precision. Conversion is monotone, so that a box that is below
 * another after conversion was below it before. Margins are added in double precision, which rounds
 * a sum by at most u = 2^-53 of itself. Two boxes lose at most 2 u of a coordinate of their margins
 * that way, which is far less than the margins: these are at least 1e-12 of any coordinate.
 */
#ifndef FlipFreeMotionBox_h
#define FlipFreeMotionBox_h

#include "Guard/MotionTest.h"

#include <array>

namespace FlipFree
{

// A cache line each.
class alignas(64) MotionBox
{
public:
  /// Holds nothing yet.
  MotionBox() = default;

  /// The box of some vertices, with a margin around them. Coordinates must be in the range of a
  /// float.
  template <std::size_t N>
  MotionBox(const Motion& motion, const std::array<int, N>& vertices, double margin)
  {
    for (int end = 0; end < 2; ++end)
    {
      const PointList& points = end == 0 ? motion.From : motion.To;
      Eigen::Array3d low = points.row(vertices[0]);
      Eigen::Array3d high = low;
      for (std::size_t i = 1; i < N; ++i)
      {
        const Eigen::Array3d point = points.row(vertices[i]);
        low = low.min(point);
        high = high.max(point);
      }
      this->Low[end] << (low - margin).cast<float>(), 0;
      this->High[end] << (high + margin).cast<float>(), 0;
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
  // Three coordinates and a fourth lane that stays zero, for the vector units.
  using Lanes = Eigen::Array4f;

  std::array<Lanes, 2> Low;
  std::array<Lanes, 2> High;
};

} // namespace FlipFree

#endif
