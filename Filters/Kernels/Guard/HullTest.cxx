#include "Guard/HullTest.h"

namespace FlipFree
{
namespace
{

template <typename Item, typename Visit>
void ForEach(const std::vector<Item>& items, const ParallelFor& parallelFor, const Visit& visit)
{
  parallelFor(0, static_cast<std::ptrdiff_t>(items.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    { std::for_each(items.begin() + first, items.begin() + last, visit); });
}

// A place near most vertices, even if one lies astray. There is at least one vertex.
Eigen::Vector3d MedianOfThree(const PointList& points)
{
  const Eigen::Vector3d first = points.row(0);
  const Eigen::Vector3d middle = points.row(points.rows() / 2);
  const Eigen::Vector3d last = points.row(points.rows() - 1);
  return first.cwiseMin(middle).cwiseMax(first.cwiseMax(middle).cwiseMin(last));
}

} // namespace

HullTest::HullTest(const FaceList& faces, const CandidatePairs& candidates, const PointList& points,
  const MinimumDistance& distance)
  : Faces(faces)
  , Candidates(candidates)
  , Distance(distance)
  , Rounded(points.rows(), MedianOfThree(points))
{
}

void HullTest::Run(const std::vector<char>& changed, StepLimiter& step,
  const ParallelFor& parallelFor)
{
  const Motion motion = step.Path();
  parallelFor(0, motion.From.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
      {
        if (changed[vertex])
        {
          this->Rounded.Update(motion, static_cast<int>(vertex));
        }
      }
    });
  const auto test = [&](const Hull& one, const Hull& two)
  {
    if (HaveSeparatingDirection(this->Rounded, one, two, this->Distance.Wanted))
    {
      return;
    }
    // An impact may no longer matter at all.
    const double latest = step.LatestUsefulTime(one, two);
    const double time = latest > 0 ? TimeOfImpact(motion, one, two, this->Distance, latest) : 1;
    if (!(time >= 1))
    {
      step.Limit(one, time);
      step.Limit(two, time);
    }
  };
  this->Candidates.VisitDisjointHulls(motion, this->Distance.Wanted, changed, this->Boxes, test,
    parallelFor);
  std::vector<char> isFaceChanged(this->Faces.NumberOfFaces());
  for (int face = 0; face < this->Faces.NumberOfFaces(); ++face)
  {
    isFaceChanged[face] = HasFlaggedVertex(changed, this->Faces, face) ? 1 : 0;
  }
  ForEach(this->Candidates.AdjacentPairs(), parallelFor,
    [&](const HullPair& pair)
    {
      if (isFaceChanged[pair.Faces[0]] || isFaceChanged[pair.Faces[1]])
      {
        test(pair.One, pair.Two);
      }
    });
}

void HullTest::RunObstacles(const PointList& obstacles, const std::vector<VertexRange>& ranges,
  const std::vector<char>& changed, StepLimiter& step, const ParallelFor& parallelFor) const
{
  if (obstacles.rows() == 0)
  {
    return;
  }
  const Motion motion = step.Path();
  const FaceHulls& hulls = this->Candidates.Hulls();
  parallelFor(0, hulls.NumberOfHulls(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const Hull hull = hulls.HullAt(static_cast<int>(index));
        if (std::none_of(hull.begin(), hull.end(), [&](int v) { return changed[v] != 0; }))
        {
          continue;
        }
        for (Eigen::Index row = 0; row < obstacles.rows(); ++row)
        {
          const Eigen::Vector3d obstacle = obstacles.row(row);
          if (!ranges[row].Holds(hull[0]) ||
            !MayComeNear(motion, hull, obstacle, this->Distance.Wanted))
          {
            continue;
          }
          const double time = TimeToObstacle(motion, hull, obstacle, this->Distance);
          if (!(time >= 1))
          {
            step.Limit(hull, time);
          }
        }
      }
    });
}

} // namespace FlipFree
