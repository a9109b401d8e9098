#include "PolygonFile.h"

#include "CheckedPolygons.h"

#include <sstream>

namespace Command
{
namespace
{

/// `12`, `12/3`, `12//5` or `12/3/5`; counted from 1, or, where negative, back from the last
/// vertex.
vtkIdType ObjVertex(const std::string& word, vtkIdType numberOfPoints)
{
  const vtkIdType index = IndexIn(NumberIn(word.substr(0, word.find('/'))));
  return index < 0 ? numberOfPoints + index : index - 1;
}

} // namespace

vtkSmartPointer<vtkPolyData> ReadObj(const std::string& name)
{
  std::istringstream file(Contents(name));
  CheckedPolygons polygons;
  std::vector<std::vector<vtkIdType>> faces; // may refer to later vertices
  for (std::string line; std::getline(file, line);)
  {
    std::string rest;
    while (!line.empty() && line.back() == '\\' && std::getline(file, rest))
    {
      line.back() = ' ';
      line += rest;
    }
    std::istringstream stream(line);
    std::string word;
    stream >> word;
    if (word == "v")
    {
      double point[3];
      for (double& coordinate : point)
      {
        word.clear();
        stream >> word;
        coordinate = NumberIn(word);
      }
      polygons.AddPoint(point);
    }
    else if (word == "f")
    {
      faces.emplace_back();
      while (stream >> word)
      {
        faces.back().push_back(ObjVertex(word, polygons.NumberOfPoints()));
      }
    }
  }
  for (const std::vector<vtkIdType>& face : faces)
  {
    polygons.AddFace(face);
  }
  return polygons.Surface();
}

} // namespace Command
