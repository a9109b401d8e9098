#include "Geometry/FaceHulls.h"

namespace FlipFree
{

FaceHulls::FaceHulls(const PointList& layout, const FaceList& faces)
  : NumberOfPoints(static_cast<int>(layout.rows()))
  , Polygons(faces)
{
  const FaceParts parts(faces);
  std::vector<Hull> hulls;
  for (std::size_t part = 0; part < parts.Corners.size(); ++part)
  {
    Cover(parts.Corners[part],
      [&](const Hull& hull)
      {
        hulls.push_back(hull);
        this->Faces.push_back(parts.Faces[part]);
      });
  }
  this->Hulls.resize(static_cast<Eigen::Index>(hulls.size()), 4);
  for (std::size_t hull = 0; hull < hulls.size(); ++hull)
  {
    this->Hulls.row(static_cast<Eigen::Index>(hull)) =
      Eigen::Map<const Eigen::RowVector4i>(hulls[hull].data());
  }
  this->TreeOfHulls = TriangleTree(layout, this->Hulls);
}

std::vector<std::pair<int, int>> FaceHulls::VisitAdjacentPairs(bool covered,
  const HullPairVisitor& visit) const
{
  return VisitAdjacentParts(FaceParts(this->Polygons), this->NumberOfPoints, covered, visit);
}

std::vector<std::pair<int, int>> FaceHulls::FindOverlappingFaces() const
{
  return this->VisitAdjacentPairs(true, [](const std::vector<HullPair>&) {});
}

bool FaceHulls::AreDisjoint(int one, int two) const
{
  const Hull first = this->HullAt(one);
  const Hull second = this->HullAt(two);
  return std::none_of(first.begin(), first.end(),
    [&](int vertex) { return std::find(second.begin(), second.end(), vertex) != second.end(); });
}

} // namespace FlipFree
