#include "Exchange/CheckedPolygons.h"

#include "Exchange/FileProblem.h"
#include "TextWords.h"

#include <climits>
#include <cmath>

namespace FlipFree
{

void RefusePolygons(const std::string& fault)
{
  throw FileProblem(FileProblem::Kind::Unusable, fault);
}

void CheckedPolygons::AddPoint(const double* point)
{
  constexpr double greatest = 1e9; // mm
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point[axis]) <= greatest))
    {
      RefusePolygons("the position of vertex " + std::to_string(this->NumberOfPoints()) +
        " is not finite, or beyond 1e9 mm");
    }
  }
  this->Points.insert(this->Points.end(), point, point + 3);
}

void CheckedPolygons::AddFace(const std::vector<std::int64_t>& vertices)
{
  const std::string face = "face " + std::to_string(this->Offsets.size() - 1);
  if (vertices.size() < 3)
  {
    RefusePolygons(face + " has fewer than three vertices");
  }
  if (vertices.size() > INT_MAX - this->Corners.size())
  {
    RefusePolygons("its faces have more than 2^31 - 1 corners");
  }
  for (const std::int64_t vertex : vertices)
  {
    if (vertex < 0 || vertex >= this->NumberOfPoints() || vertex > INT_MAX)
    {
      RefusePolygons(face + " has a vertex that does not exist");
    }
    this->Corners.push_back(static_cast<int>(vertex));
  }
  this->Offsets.push_back(static_cast<int>(this->Corners.size()));
}

void CheckedPolygons::SwapRasLps()
{
  for (std::size_t index = 0; index < this->Points.size(); ++index)
  {
    this->Points[index] *= index % 3 < 2 ? -1 : 1;
  }
}

double NumberIn(const std::string& word)
{
  double number = 0;
  constexpr std::size_t exact = 15; // digits
  if (!word.empty() && word.size() <= exact &&
    word.find_first_not_of("0123456789") == std::string::npos)
  {
    for (const char digit : word) // indices, of which there are most, in a fraction of the time
    {
      number = 10 * number + (digit - '0');
    }
    return number;
  }
  if (!ToNumber(word, number))
  {
    RefusePolygons("a word is not a number where one is expected");
  }
  return number;
}

std::int64_t IndexIn(double number)
{
  constexpr double greatest = 9e15; // whole numbers are exact up to here
  if (!(std::abs(number) < greatest) || number != std::floor(number))
  {
    RefusePolygons("an index or a count is not a whole number");
  }
  return static_cast<std::int64_t>(number);
}

bool SaysRas(const std::string& comment)
{
  return comment.find("SPACE=RAS") != std::string::npos;
}

} // namespace FlipFree
