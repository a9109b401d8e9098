#include "CheckedPolygons.h"

#include "Failure.h"
#include "PolygonFile.h"

#include "vtkIdList.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace Command
{

void CheckedPolygons::AddPoint(const double* point)
{
  constexpr double greatest = 1e9; // mm
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point[axis]) <= greatest))
    {
      throw Failure("the position of vertex " + std::to_string(this->NumberOfPoints()) +
        " is not finite, or beyond 1e9 mm");
    }
  }
  this->Points->InsertNextPoint(point);
}

void CheckedPolygons::AddFace(const std::vector<vtkIdType>& vertices)
{
  const std::string face = "face " + std::to_string(this->Cells->GetNumberOfCells());
  if (vertices.size() < 3)
  {
    throw Failure(face + " has fewer than three vertices");
  }
  for (const vtkIdType vertex : vertices)
  {
    if (vertex < 0 || vertex >= this->NumberOfPoints())
    {
      throw Failure(face + " has a vertex that does not exist");
    }
  }
  this->Cells->InsertNextCell(static_cast<vtkIdType>(vertices.size()), vertices.data());
}

vtkSmartPointer<vtkPolyData> CheckedPolygons::Surface() const
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(this->Points);
  surface->SetPolys(this->Cells);
  return surface;
}

std::string Contents(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw Failure("it cannot be opened");
  }
  return bytes;
}

double NumberIn(const std::string& word)
{
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || end != word.c_str() + word.size())
  {
    throw Failure("a word is not a number where one is expected");
  }
  return number;
}

vtkIdType IndexIn(double number)
{
  constexpr double greatest = 9e15; // whole numbers are exact up to here
  if (!(std::abs(number) < greatest) || number != std::floor(number))
  {
    throw Failure("an index or a count is not a whole number");
  }
  return static_cast<vtkIdType>(number);
}

vtkSmartPointer<vtkPolyData> JudgedPolygons(vtkPolyData* surface)
{
  if (!surface->GetPolys()->IsValid() || !surface->GetStrips()->IsValid())
  {
    throw Failure("its list of faces is damaged");
  }
  CheckedPolygons polygons;
  double point[3];
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    surface->GetPoint(vertex, point);
    polygons.AddPoint(point);
  }
  vtkNew<vtkIdList> vertices;
  std::vector<vtkIdType> face;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); ++cell)
  {
    surface->GetPolys()->GetCellAtId(cell, vertices);
    face.assign(vertices->begin(), vertices->end());
    polygons.AddFace(face);
  }
  for (vtkIdType strip = 0; strip < surface->GetNumberOfStrips(); ++strip)
  {
    surface->GetStrips()->GetCellAtId(strip, vertices);
    for (vtkIdType first = 0; first + 2 < vertices->GetNumberOfIds(); ++first)
    {
      // Every other triangle of a strip is turned round.
      const vtkIdType turn = first % 2;
      polygons.AddFace({ vertices->GetId(first + turn), vertices->GetId(first + 1 - turn),
        vertices->GetId(first + 2) });
    }
  }
  return polygons.Surface();
}

} // namespace Command
