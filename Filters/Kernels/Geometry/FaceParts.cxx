#include "Geometry/FaceParts.h"

#include <iterator>

namespace FlipFree
{

FaceParts::FaceParts(const FaceList& faces)
{
  const auto append = [&](int face, const auto& corners, unsigned int sides)
  {
    CornerSet part;
    std::for_each(std::begin(corners), std::end(corners), [&](int vertex) { part.Add(vertex); });
    this->Corners.push_back(part);
    this->Faces.push_back(face);
    this->Sides.push_back(static_cast<unsigned char>(sides));
  };
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const corners = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size <= MaximumCorners)
    {
      append(face, std::vector<int>(corners, corners + size), (1U << MaximumCorners) - 1);
      continue;
    }
    for (int corner = 2; corner < size; ++corner)
    {
      const unsigned int sides = (corner == 2 ? 1U : 0U) | 2U | (corner + 1 == size ? 4U : 0U);
      append(face, std::array<int, 3>{ { corners[0], corners[corner - 1], corners[corner] } },
        sides);
    }
  }
}

bool FaceParts::AreNeighbors(int part, int one, int two) const
{
  const CornerSet& corners = this->Corners[part];
  for (int corner = 0; corner < corners.size(); ++corner)
  {
    const int next = corners[(corner + 1) % corners.size()];
    if ((this->Sides[part] >> corner & 1U) != 0 &&
      ((corners[corner] == one && next == two) || (corners[corner] == two && next == one)))
    {
      return true;
    }
  }
  return false;
}

} // namespace FlipFree
