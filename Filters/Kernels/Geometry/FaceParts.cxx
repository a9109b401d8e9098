#include "Geometry/FaceParts.h"

#include <iterator>

namespace FlipFree
{

FaceParts::FaceParts(const FaceList& faces)
{
  const auto append = [&](int face, const auto& corners)
  {
    CornerSet part;
    std::for_each(std::begin(corners), std::end(corners), [&](int vertex) { part.Add(vertex); });
    this->Corners.push_back(part);
    this->Faces.push_back(face);
  };
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const corners = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size <= MaximumCorners)
    {
      append(face, std::vector<int>(corners, corners + size));
      continue;
    }
    for (int corner = 2; corner < size; ++corner)
    {
      append(face, std::array<int, 3>{ { corners[0], corners[corner - 1], corners[corner] } });
    }
  }
}

} // namespace FlipFree
