/**
 * Scales the displacements of a step down where the guard's tests ask for it.
 *
 * Every vertex has a scale, the part of its displacement that it keeps: 1 at first. A test that
 * fails limits the vertices involved to the time until which the motion was proven; ScaleDown then
 * multiplies their scales by at most one half, and lowers those of neighbors as well where the
 * scale would change too abruptly.
 *
 * Claim: repeating tests and ScaleDown until nothing fails ends, without a limit on the number of
 * passes. Proof: parts at rest never fail a test, so at least one vertex of every failing test
 * has a positive scale, and that scale is at least halved. Below 1/64 it becomes
 * zero, so that a vertex is halved at most seven times; scales never grow. After at most seven
 * times as many failing passes as there are vertices, everything is at rest.
 *
 * Claim: in a pass after which nothing has failed, every pair was tested up to time 1 with its
 * present motion, or is at rest, although tests end at LatestUsefulTime and pairs without a changed
 * vertex are not tested again. Proof: LatestUsefulTime is below 1 only if every moving vertex of
 * the pair has been limited in the same pass. Then the pass has failed, and ScaleDown lowers the
 * scale of each of them and returns it as changed, so that the pair is tested again before a pass
 * can end clean. (Where its end is rounded to the same numbers as before, its motion is the same;
 * it is tested again all the same.) A pair without a changed vertex has the motion with which its
 * last test was not cut short.
 */
#ifndef FlipFreeStepLimiter_h
#define FlipFreeStepLimiter_h

#include "Guard/MotionTest.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

namespace FlipFree
{

class StepLimiter
{
public:
  /// Refers to the points and neighbors; `maximumShear` (mm) is how much farther a vertex
  /// may move at its own scale than it would at a neighbor's. Vertices that move end at
  /// single-precision numbers, if these are fine enough for the typical edge length (mm;
  /// SinglePrecision.h): what is tested is the motion to there.
  StepLimiter(const PointList& points, const PointList& displacements,
    const std::vector<std::array<int, 4>>& neighbors, double maximumShear, double edgeLength);

  Motion Path() const { return { this->From, this->To }; }

  /// A test of these vertices failed: they are safe only until `time`. A negative time, or NaN,
  /// means that they are not proven to be apart at the start. May be called from several threads at
  /// once; the lowest time is used.
  template <std::size_t N>
  void Limit(const std::array<int, N>& vertices, double time)
  {
    const double safe = time >= 0 ? time : -1; // NaN would limit nothing
    for (int vertex : vertices)
    {
      double present = this->SafeTimes[vertex].load(std::memory_order_relaxed);
      while (safe < present &&
        !this->SafeTimes[vertex].compare_exchange_weak(present, safe, std::memory_order_relaxed))
      {
      }
    }
    this->NothingFailed.store(false, std::memory_order_relaxed);
  }

  /// An impact of the two after this time cannot change what ScaleDown does, because their vertices
  /// are limited by other tests or at rest. So the order of the tests does not matter.
  template <std::size_t N>
  double LatestUsefulTime(const std::array<int, N>& one, const std::array<int, N>& two) const
  {
    double latest = 0;
    for (std::size_t i = 0; i < N; ++i)
    {
      latest = std::max({ latest, this->SafeTimeOf(one[i]), this->SafeTimeOf(two[i]) });
    }
    // Beyond these bounds, all times are cut to the same part of the motion.
    return latest >= 1                           ? 1.0
      : SafetyFactor * latest <= MinimumFraction ? 0.0
                                                 : std::min(latest, MaximumFraction / SafetyFactor);
  }

  /// Which vertices have been slowed or stopped: 1, others 0.
  std::vector<char> IsScaled() const
  {
    std::vector<char> scaled(this->Scales.size());
    std::transform(this->Scales.begin(), this->Scales.end(), scaled.begin(),
      [](double scale) { return static_cast<char>(scale < 1 ? 1 : 0); });
    return scaled;
  }

  /// Whether no test has failed since the last ScaleDown.
  bool IsClean() const { return this->NothingFailed; }

  /// Scales down what was limited. Returns the vertices whose scale it has lowered.
  std::vector<int> ScaleDown();

private:
  // A limited vertex keeps this fraction of its motion up to the time of impact, clamped to
  // [MinimumFraction, MaximumFraction]. The lower bound leaves it room to move once others have
  // slowed.
  static constexpr double SafetyFactor = 0.9;
  static constexpr double MaximumFraction = 0.5;
  static constexpr double MinimumFraction = 0.12;

  // Zero for a vertex at rest, which no test needs to limit.
  double SafeTimeOf(int vertex) const
  {
    return this->Scales[vertex] > 0 ? this->SafeTimes[vertex].load(std::memory_order_relaxed) : 0;
  }

  // Sets where the vertex ends at its present scale.
  void Place(Eigen::Index vertex);

  const PointList& From;
  const std::vector<std::array<int, 4>>& Neighbors;
  const double MaximumShear;
  const double EdgeLength;
  const PointList Wanted;
  PointList To;
  std::vector<double> Scales;
  std::vector<std::atomic<double>> SafeTimes; // 1 for vertices of which no test has failed
  std::atomic<bool> NothingFailed{ true };
};

} // namespace FlipFree

#endif
