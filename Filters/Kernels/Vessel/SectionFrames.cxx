#include "Vessel/SectionFrames.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

Eigen::Vector3d TangentAt(const PointList& line, Eigen::Index point)
{
  const Eigen::Index before = std::max<Eigen::Index>(0, point - 1);
  const Eigen::Index after = std::min(line.rows() - 1, point + 1);
  Eigen::Vector3d tangent = line.row(after) - line.row(before);
  if (!(tangent.norm() > 0)) // the line turns back on itself
  {
    tangent = line.row(after) - line.row(point);
  }
  return tangent.normalized();
}

Eigen::Vector3d Reflected(const Eigen::Vector3d& vector, const Eigen::Vector3d& normal)
{
  const double square = normal.squaredNorm();
  return square > 0 ? vector - 2 * vector.dot(normal) / square * normal : vector;
}

// Rounding must not accumulate along the line.
void Orthonormalize(SectionFrame& frame)
{
  frame.First -= frame.First.dot(frame.Tangent) * frame.Tangent;
  if (!(frame.First.norm() > 1e-6))
  {
    frame.First = frame.Tangent.unitOrthogonal();
  }
  frame.First.normalize();
  frame.Second = frame.Tangent.cross(frame.First);
}

} // namespace

std::vector<SectionFrame> MakeSectionFrames(const PointList& line)
{
  std::vector<SectionFrame> frames(line.rows());
  frames[0].Origin = line.row(0);
  frames[0].Tangent = TangentAt(line, 0);
  frames[0].First = frames[0].Tangent.unitOrthogonal();
  Orthonormalize(frames[0]);
  for (Eigen::Index point = 1; point < line.rows(); ++point)
  {
    const SectionFrame& before = frames[point - 1];
    SectionFrame& now = frames[point];
    now.Origin = line.row(point);
    now.Tangent = TangentAt(line, point);
    const Eigen::Vector3d chord = now.Origin - before.Origin;
    const Eigen::Vector3d first = Reflected(before.First, chord);
    const Eigen::Vector3d tangent = Reflected(before.Tangent, chord);
    now.First = Reflected(first, now.Tangent - tangent);
    Orthonormalize(now);
  }
  return frames;
}

} // namespace FlipFree
