/**
 * Proofs that parts of a surface stay apart while its vertices move along straight lines.
 *
 * They rest on one observation: along a fixed direction, the separation of two moving points is
 * linear in time. A direction that separates two sets of vertices at the beginning and at the end
 * of an interval therefore separates their convex hulls throughout, whatever motion they share. How
 * the direction is found needs no trust: a poor one proves nothing, it never proves too much.
 */
#ifndef FlipFreeMotionCertificate_h
#define FlipFreeMotionCertificate_h

#include "KernelTypes.h"

#include <array>
#include <vector>

namespace FlipFree
{

/// Every vertex moves from its row of `From` to its row of `To`, in unit time.
struct Motion
{
  const PointList& From;
  const PointList& To;

  Eigen::Vector3d At(int vertex, double time) const
  {
    return (1 - time) * this->From.row(vertex) + time * this->To.row(vertex);
  }
  bool IsAtRest(int vertex) const { return this->From.row(vertex) == this->To.row(vertex); }
};

/// The distance that is to be kept, in millimeters. Where parts are nearer than `Wanted` at the
/// start, they may not come nearer; nearer than `Resolution`, the size of rounding errors, they may
/// not move at all.
struct MotionGap
{
  double Wanted = 0;
  double Resolution = 0;
};

/// The time until which the normal of the corner before-vertex-after has turned by less than 90
/// degrees; 1 or more means always. Always for a corner at rest, and for one that has no normal at
/// the start.
double UprightUntil(const Motion& motion, const std::array<int, 3>& corner);

/// The time until which a vertex and a face, two edges, two triangles without common vertices are
/// proven to keep their gap; 1 or more means always. Always for parts that do not move at all.
/// Negative for parts that are not proven to be apart at the start. The search may end at a time of
/// less than 1 that is not before `enough`.
double ApartUntil(const Motion& motion, const std::array<int, 1>& vertex,
  const std::array<int, 3>& face, const MotionGap& gap, double enough = 1);
double ApartUntil(const Motion& motion, const std::array<int, 2>& one,
  const std::array<int, 2>& two, const MotionGap& gap, double enough = 1);
double ApartUntil(const Motion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, const MotionGap& gap, double enough = 1);

/// A motion in single precision, for the vector units. The origin does not matter but for rounding:
/// it should be near the points.
struct RoughMotion
{
  RoughMotion(Eigen::Index count, const Eigen::Vector3d& origin);

  /// Takes this vertex from the motion.
  void Update(const Motion& motion, int vertex);

  // Three coordinates, and the greatest of their absolute values.
  std::vector<Eigen::Array4f> Ends[2];
  Eigen::Vector3d Origin;
};

/// Of two triangles, what the few directions that are quickly tried can prove of a gap; each proof
/// includes those before it.
enum class QuickProof
{
  None,
  ApartAtStart,
  ApartThroughout,
  ApartOnAnyPart ///< also when each vertex is only let go a part of its way
};
QuickProof ProveApart(const RoughMotion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, double gap);

} // namespace FlipFree

#endif
