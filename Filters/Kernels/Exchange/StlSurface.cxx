#include "Exchange/PolygonFile.h"
#include "TextWords.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

namespace FlipFree
{
namespace
{

constexpr std::size_t StlHeader = 84;
constexpr std::size_t StlTriangle = 50;

std::size_t NumberOfStlTriangles(const std::string& bytes)
{
  std::uint32_t count = 0;
  std::memcpy(&count, &bytes[StlHeader - sizeof(count)], sizeof(count));
  return count;
}

/// Files of text begin with `solid`, and so do some binary ones.
bool IsBinaryStl(const std::string& bytes)
{
  const bool beginsAsText = InSmallLetters(bytes.substr(0, 5)) == "solid";
  const bool isWhole = bytes.size() >= StlHeader &&
    bytes.size() >= StlHeader + StlTriangle * NumberOfStlTriangles(bytes);
  if (!beginsAsText && !isWhole)
  {
    RefusePolygons("it holds fewer triangles than its header says");
  }
  return !beginsAsText || (isWhole && InSmallLetters(bytes).find("facet") == std::string::npos);
}

/// Corners of triangles; those in the same place become one vertex.
class StlCorners
{
public:
  void Add(const std::array<double, 3>& point)
  {
    if (std::any_of(point.begin(), point.end(), [](double x) { return std::isnan(x); }))
    {
      this->Found.AddPoint(point.data()); // refuses what has no order among places
    }
    const auto found =
      this->Vertices.emplace(point, static_cast<std::int64_t>(this->Vertices.size()));
    if (found.second)
    {
      this->Found.AddPoint(point.data());
    }
    this->Corners.push_back(found.first->second);
  }

  bool IsFull(const std::string& bytes) const
  {
    return this->Corners.size() == 3 * NumberOfStlTriangles(bytes);
  }

  CheckedPolygons Surface(bool isRas)
  {
    if (this->Corners.size() % 3 != 0)
    {
      RefusePolygons("its last triangle is incomplete");
    }
    for (auto corner = this->Corners.begin(); corner != this->Corners.end(); corner += 3)
    {
      this->Found.AddFace({ corner, corner + 3 });
    }
    if (isRas)
    {
      this->Found.SwapRasLps();
    }
    return std::move(this->Found);
  }

private:
  std::map<std::array<double, 3>, std::int64_t> Vertices;
  std::vector<std::int64_t> Corners;
  CheckedPolygons Found;
};

} // namespace

CheckedPolygons ReadStl(const std::string& bytes)
{
  StlCorners corners;
  if (IsBinaryStl(bytes))
  {
    for (std::size_t at = StlHeader; at + StlTriangle <= bytes.size() && !corners.IsFull(bytes);
         at += StlTriangle)
    {
      float numbers[12]; // the normal, and three corners
      std::memcpy(numbers, &bytes[at], sizeof(numbers));
      for (int corner = 1; corner <= 3; ++corner)
      {
        corners.Add({ { numbers[3 * corner], numbers[3 * corner + 1], numbers[3 * corner + 2] } });
      }
    }
    return corners.Surface(SaysRas(bytes.substr(0, StlHeader)));
  }
  std::istringstream words(bytes);
  for (std::string word; words >> word;)
  {
    if (InSmallLetters(word) == "vertex")
    {
      std::array<double, 3> point;
      for (double& coordinate : point)
      {
        word.clear();
        words >> word;
        coordinate = static_cast<float>(NumberIn(word));
      }
      corners.Add(point);
    }
  }
  return corners.Surface(SaysRas(bytes.substr(0, bytes.find('\n'))));
}

} // namespace FlipFree
