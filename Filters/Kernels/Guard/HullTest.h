/**
 * The guard's test of hulls, with what it keeps between the passes of a step: whether they stay
 * apart from each other and from obstacles.
 */
#ifndef FlipFreeHullTest_h
#define FlipFreeHullTest_h

#include "Guard/CandidatePairs.h"
#include "Guard/ObstacleTest.h"
#include "Guard/SeparatingDirection.h"
#include "Guard/StepLimiter.h"

#include <algorithm>
#include <vector>

namespace FlipFree
{

/// Whether a vertex of the face has its flag set.
inline bool HasFlaggedVertex(const std::vector<char>& flags, const FaceList& faces, int face)
{
  const int* const vertices = faces.Face(face);
  return std::any_of(vertices, vertices + faces.FaceSize(face),
    [&](int vertex) { return flags[vertex] != 0; });
}

class HullTest
{
public:
  /// Refers to the faces and pairs. `points` are where the step starts, at least one.
  HullTest(const FaceList& faces, const CandidatePairs& candidates, const PointList& points,
    const MinimumDistance& distance);

  /// Tests the hulls with a vertex that has changed since the last pass, and limits those that
  /// come too near to each other.
  void Run(const std::vector<char>& changed, StepLimiter& step, const ParallelFor& parallelFor);

  /// The same with obstacles, each of which stops the vertices of its range alone.
  void RunObstacles(const PointList& obstacles, const std::vector<VertexRange>& ranges,
    const std::vector<char>& changed, StepLimiter& step, const ParallelFor& parallelFor) const;

private:
  const FaceList& Faces;
  const CandidatePairs& Candidates;
  const MinimumDistance Distance;
  SinglePrecisionMotion Rounded;
  std::vector<MotionBox> Boxes;
};

} // namespace FlipFree

#endif
