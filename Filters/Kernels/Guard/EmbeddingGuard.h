/**
 * Limits a step of the deformation so that the surface neither intersects itself nor flips a face
 * during the step. If the first surface is embedded, so is every iterate.
 *
 * The whole motion is certified, every vertex moving along a straight line, by
 *
 *   CandidatePairs        finds the parts that may meet,
 *   HullTest              tests these by the next two, and obstacles by ObstacleTest,
 *   SeparatingDirection   settles most of these quickly,
 *   MotionTest            computes conservative times of impact of the others, and of flips,
 *   QuadFold              computes conservative times until a quad is folded,
 *   ObstacleTest          computes those of impact on fixed points,
 *   StepLimiter           scales displacements down where something fails,
 *   SinglePrecision       rounds where they end, so that files can hold what is certified.
 *
 * This is repeated until a pass is clean.
 */
#ifndef FlipFreeEmbeddingGuard_h
#define FlipFreeEmbeddingGuard_h

#include "Guard/CandidatePairs.h"
#include "Guard/ObstacleTest.h"
#include "Mesh/ContourMesh.h"

#include <array>
#include <utility>
#include <vector>

namespace FlipFree
{

class StepLimiter;

struct GuardReport
{
  int Guarded = 0;             ///< vertices whose displacement was scaled down
  std::vector<char> IsGuarded; ///< one flag per vertex
  int Passes = 0;              ///< number of test passes; 1 if nothing had to be scaled down
  PointList Positions;         ///< where the vertices end, without the rounding error of a sum
};

class EmbeddingGuard
{
public:
  /// Precomputes everything that depends only on the connectivity.
  explicit EmbeddingGuard(const ContourMesh& mesh, const ParallelFor& parallelFor = SerialFor);

  /// Fixed points, one row each (mm), that the surface must not pass: each stays on its side, and
  /// keeps the distance that faces without a common vertex keep (ObstacleTest.h). None at first. A
  /// face whose hull holds one at the start stays at rest. With several surfaces, an obstacle stops
  /// only the vertices in its range; without ranges, each stops all.
  void SetObstacles(PointList obstacles, std::vector<VertexRange> ranges = {})
  {
    this->Obstacles = std::move(obstacles);
    this->Ranges = std::move(ranges);
    this->Ranges.resize(this->Obstacles.rows());
  }

  /// Scales displacements down, conservatively, until two things are proven of the motion of every
  /// vertex straight from `points` to `points + displacements`. If the surface is embedded at
  /// `points`, it stays so, however its faces are cut into triangles (FaceHulls.h). And no normal
  /// of a corner of a face, or of a triangle of the fan about its first vertex, turns by 90 degrees
  /// or more: of triangles and quads, these are all triangles of every cut.
  ///
  /// Both arguments have one row per vertex, in millimeters; a displacement of more than a hundred
  /// times the surface's extent is cut to that first. Faces without a common vertex keep a distance
  /// of a thousandth of the typical edge length, or the one they start with if that is less; so do
  /// parts of adjacent faces. Corners that are degenerate at the start (TimeOfFlip) are not tested.
  /// Quads do not become folded (QuadFold.h). Hulls that overlap at the start although no cut
  /// intersects stay at rest. Vertices that move end at single-precision numbers, so that a file of
  /// single precision holds the surface that was certified, if these are fine enough
  /// (SinglePrecision.h). `monitor` is asked between passes; if it returns false, the displacements
  /// become zero. Throws Error for a wrong number of rows, a number that is not finite, a
  /// coordinate beyond 1e30 mm, and, naming the first pair of faces, if the surface intersects
  /// itself at `points`. That is not tested again where the last step ended, which the guard
  /// remembers; so it must not be called from two threads at once.
  GuardReport Limit(const PointList& points, PointList& displacements,
    const ParallelFor& parallelFor, const Monitor& monitor);

  /// Of the mesh's faces.
  const FaceHulls& Hulls() const { return this->Candidates.Hulls(); }
  /// Parts of adjacent faces, or of one.
  const std::vector<HullPair>& AdjacentPairs() const { return this->Candidates.AdjacentPairs(); }

private:
  void RequireFinite(const PointList& points, const char* what, double maximum) const;
  void RequireEmbeddedAtRest(const Motion& motion, const ParallelFor& parallelFor) const;

  // Tests the corners and quads with a changed vertex; limits the vertices of those that fail.
  void TestShapes(const std::vector<char>& changed, StepLimiter& step,
    const ParallelFor& parallelFor) const;

  FaceList Faces;
  std::vector<std::array<int, 4>> Neighbors;
  CandidatePairs Candidates;
  PointList Embedded; // where the last certified step ended
  PointList Obstacles = PointList(0, 3);
  std::vector<VertexRange> Ranges; // of the obstacles
};

} // namespace FlipFree

#endif
