/**
 * Holds a step of the deformation back where the surface would touch itself or a face would flip on
 * the way, so that every iterate is embedded when the first one is.
 *
 * The whole motion is certified, every vertex moving along a straight line: its end alone would let
 * parts pass through each other. What fails is scaled back and certified again, until a whole pass
 * is clean. No motion always is, so this ends, and there is no limit after which it gives up.
 */
#ifndef FlipFreeEmbeddingGuard_h
#define FlipFreeEmbeddingGuard_h

#include "Geometry/TriangleTree.h"
#include "Guard/MotionBox.h"
#include "Guard/MotionCertificate.h"
#include "Guard/StrangerPairs.h"
#include "Guard/SweptBox.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/VertexIncidence.h"

#include <mutex>

namespace FlipFree
{

struct GuardReport
{
  int HeldBack = 0; ///< vertices whose displacement was scaled down
  int Passes = 0;   ///< times that the motion was tested; 1 when nothing had to be held back
};

class EmbeddingGuard
{
public:
  /// Keeps what depends on the connectivity only.
  explicit EmbeddingGuard(const ContourMesh& mesh);

  /// Scales displacements down, where and as little as it must, until it is certain that on the
  /// straight way from points to points + displacements no two triangles meet but in the vertex or
  /// edge they share, and no normal of a triangle or of a corner of a face turns by 90 degrees or
  /// more. Both have one row per vertex, in millimeters; a displacement of more than a hundred
  /// times the surface's extent is cut to that first. Triangles without a common vertex keep a
  /// distance of a thousandth of the mean edge length, or the one they start with if that is less;
  /// corners that have no normal at the start are not judged. Where the motion is long, a vertex
  /// that is held back holds its neighbors, too. `monitor` is asked between passes; when it
  /// returns false, the displacements become zero. Throws std::invalid_argument when there is
  /// another number of rows, when a number is not finite or a coordinate beyond 1e30 mm, or where a
  /// motion cannot be certified because the points are not embedded.
  GuardReport Limit(const PointList& points, PointList& displacements,
    const ParallelFor& parallelFor, const Monitor& monitor) const;

  /// Throws std::invalid_argument, naming the first pair of triangles, when the surface intersects
  /// itself at these points, and, as above, for points that it cannot compute with.
  void RequireEmbedded(const PointList& points, const ParallelFor& parallelFor) const;

private:
  using Corner = std::array<int, 3>; // before, vertex, after
  using TrianglePair = std::pair<int, int>;
  struct Attempt;
  // What pairs are tested with: boxes of the tree's nodes, and what a short motion leaves
  // unsettled.
  struct PairMemory
  {
    std::vector<MotionBox> MotionBoxes;
    std::vector<SweptBox> SweptBoxes;
    std::vector<std::vector<TrianglePair>> Unsettled;
  };
  class MemoryLoan;

  void RequireFinite(const PointList& points, const char* what, double greatest) const;
  void RequireEmbeddedNear(const PointList& points, const std::vector<char>& vertices,
    const ParallelFor& parallelFor) const;
  double MeanEdgeLength(const PointList& points) const;

  // The parts of a pass. Each tests what changed since it was run last, lowers the limits of the
  // vertices of what fails, and tells whether nothing did.
  bool TestCorners(Attempt& attempt, const ParallelFor& parallelFor) const;
  bool TestPairs(Attempt& attempt, const ParallelFor& parallelFor) const;

  // The parts of TestPairs.
  void TestPairsWithoutStrangers(Attempt& attempt, const ParallelFor& parallelFor) const;

  // Pairs that stay apart wherever on their ways their vertices are held are settled: only the
  // others are tested again when the motion has been scaled back. That is most pairs of a short
  // motion. Of a long one it is few, and boxes that move along leave fewer pairs to be tested.
  void TestPairsOfShortMotion(Attempt& attempt, const std::vector<int>& triangles,
    const ParallelFor& parallelFor) const;
  void TestPairsOfLongMotion(Attempt& attempt, const std::vector<int>& triangles,
    const ParallelFor& parallelFor) const;
  // Tests a pair, and tells whether that is settled.
  bool Settle(Attempt& attempt, const TrianglePair& pair) const;

  void ScaleBack(Attempt& attempt) const;

  std::array<int, 3> Triangle(int index) const
  {
    return { { this->Triangles(index, 0), this->Triangles(index, 1), this->Triangles(index, 2) } };
  }

  std::vector<std::array<int, 4>> Neighbors;
  TriangleList Triangles;
  std::vector<Corner> Corners;
  VertexIncidence CornersAt;
  VertexIncidence TrianglesAt;
  FeaturePairs WithoutStrangers;
  PointList Layout;
  TriangleTree Tree;
  TriangleTree::NodePartners Strangers;

  // The memory of a call, for the next one. A second call at the same time does without; of both,
  // the memory of the one that ends last is kept.
  mutable std::mutex SpareMutex;
  mutable PairMemory Spare;
};

} // namespace FlipFree

#endif
