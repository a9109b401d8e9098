#include "Exchange/PolygonFile.h"

#include <sstream>
#include <vector>

namespace FlipFree
{
namespace
{

/// `12`, `12/3`, `12//5` or `12/3/5`; counted from 1, or, where negative, back from the last
/// vertex.
std::int64_t ObjVertex(const std::string& word, std::int64_t numberOfPoints)
{
  const std::int64_t index = IndexIn(NumberIn(word.substr(0, word.find('/'))));
  return index < 0 ? numberOfPoints + index : index - 1;
}

} // namespace

CheckedPolygons ReadObj(const std::string& bytes)
{
  std::istringstream file(bytes);
  CheckedPolygons polygons;
  bool isRas = false;
  std::vector<std::vector<std::int64_t>> faces; // may refer to later vertices
  for (std::string line; std::getline(file, line);)
  {
    std::string rest;
    while (!line.empty() && line.back() == '\\' && std::getline(file, rest))
    {
      line.back() = ' ';
      line += rest;
    }
    isRas = isRas || (line.rfind('#', 0) == 0 && SaysRas(line));
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
  for (const std::vector<std::int64_t>& face : faces)
  {
    polygons.AddFace(face);
  }
  if (isRas)
  {
    polygons.SwapRasLps();
  }
  return polygons;
}

} // namespace FlipFree
