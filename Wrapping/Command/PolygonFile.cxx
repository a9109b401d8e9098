#include "PolygonFile.h"

#include "Failure.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

namespace Command
{
namespace
{

std::string Contents(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw Failure("it may not be read");
  }
  return bytes;
}

/// Checks polygons as they come.
class Polygons
{
public:
  Polygons() { this->Points->SetDataTypeToDouble(); }

  vtkIdType NumberOfPoints() const { return this->Points->GetNumberOfPoints(); }

  void AddPoint(const double* point)
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

  /// After all points.
  void AddFace(const std::vector<vtkIdType>& vertices)
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

  vtkSmartPointer<vtkPolyData> Surface() const
  {
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(this->Points);
    surface->SetPolys(this->Cells);
    return surface;
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
};

/// A number that takes up the whole word.
double NumberIn(const std::string& word)
{
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || end != word.c_str() + word.size())
  {
    throw Failure("a word is no number where one is wanted");
  }
  return number;
}

vtkIdType IndexIn(double number)
{
  constexpr double greatest = 9e15; // whole numbers are exact so far
  if (!(std::abs(number) < greatest) || number != std::floor(number))
  {
    throw Failure("an index or a count is no whole number");
  }
  return static_cast<vtkIdType>(number);
}

enum class PlyForm
{
  Text,
  LittleEndian,
  BigEndian
};

struct PlyProperty
{
  std::string Name;
  std::string Type;
  std::string CountType; ///< of a list
};

struct PlyElement
{
  std::string Name;
  vtkIdType Count = 0;
  std::vector<PlyProperty> Properties;
};

class PlyFile
{
public:
  explicit PlyFile(const std::string& name)
    : Bytes(Contents(name))
  {
  }

  vtkSmartPointer<vtkPolyData> Read()
  {
    this->ReadHeader();
    for (const PlyElement& element : this->Elements)
    {
      for (vtkIdType index = 0; index < element.Count; ++index)
      {
        this->ReadElement(element);
      }
    }
    Polygons polygons; // faces may stand before vertices
    for (std::size_t begin = 0; begin < this->Positions.size(); begin += 3)
    {
      polygons.AddPoint(&this->Positions[begin]);
    }
    for (const std::vector<vtkIdType>& face : this->Faces)
    {
      polygons.AddFace(face);
    }
    return polygons.Surface();
  }

private:
  std::vector<std::string> LineOfHeader()
  {
    const std::size_t end = this->Bytes.find('\n', this->At);
    if (end == std::string::npos)
    {
      throw Failure("its header does not end");
    }
    std::istringstream line(this->Bytes.substr(this->At, end - this->At));
    this->At = end + 1;
    return { std::istream_iterator<std::string>(line), {} };
  }

  void ReadHeader()
  {
    if (this->LineOfHeader() != std::vector<std::string>{ "ply" })
    {
      throw Failure("it does not begin with 'ply'");
    }
    static const std::map<std::string, PlyForm> forms{ { "ascii", PlyForm::Text },
      { "binary_little_endian", PlyForm::LittleEndian },
      { "binary_big_endian", PlyForm::BigEndian } };
    bool hasForm = false;
    for (auto words = this->LineOfHeader(); words != std::vector<std::string>{ "end_header" };
         words = this->LineOfHeader())
    {
      const std::string first = words.empty() ? "comment" : words.front();
      if (first == "format" && words.size() == 3 && forms.count(words[1]))
      {
        this->Form = forms.at(words[1]);
        hasForm = true;
      }
      else if (first == "element" && words.size() == 3)
      {
        this->Elements.push_back({ words[1], IndexIn(NumberIn(words[2])), {} });
      }
      else if (first == "property" && (words.size() == 3 || words.size() == 5) &&
        !this->Elements.empty() && (words.size() == 3) == (words[1] != "list"))
      {
        const bool isList = words.size() == 5;
        this->Elements.back().Properties.push_back(
          { words.back(), words[words.size() - 2], isList ? words[2] : "" });
      }
      else if (first != "comment" && first != "obj_info")
      {
        throw Failure("a line of its header is not understood");
      }
    }
    if (!hasForm)
    {
      throw Failure("its header does not tell the format");
    }
    for (const PlyElement& element : this->Elements)
    {
      // Each takes at least a byte, so that a wrong count ends with the file.
      if (element.Count < 0 || (element.Properties.empty() && element.Count > 0))
      {
        throw Failure("it cannot hold so many elements");
      }
    }
  }

  void ReadElement(const PlyElement& element)
  {
    double position[3] = { 0, 0, 0 };
    int coordinates = 0;
    for (const PlyProperty& property : element.Properties)
    {
      if (!property.CountType.empty())
      {
        this->ReadList(property, element.Name == "face");
        continue;
      }
      const double value = this->Number(property.Type);
      if (property.Name == "x" || property.Name == "y" || property.Name == "z")
      {
        position[property.Name[0] - 'x'] = value;
        ++coordinates;
      }
    }
    if (element.Name == "vertex")
    {
      if (coordinates != 3)
      {
        throw Failure("its vertices have no x, y and z");
      }
      this->Positions.insert(this->Positions.end(), position, position + 3);
    }
  }

  void ReadList(const PlyProperty& property, bool isOfFace)
  {
    const vtkIdType count = IndexIn(this->Number(property.CountType));
    std::vector<vtkIdType> list;
    const bool isFace =
      isOfFace && (property.Name == "vertex_indices" || property.Name == "vertex_index");
    for (vtkIdType index = 0; index < count; ++index)
    {
      const double number = this->Number(property.Type);
      if (isFace)
      {
        list.push_back(IndexIn(number));
      }
    }
    if (isFace)
    {
      this->Faces.push_back(list);
    }
  }

  double Number(const std::string& type)
  {
    return this->Form == PlyForm::Text ? NumberIn(this->Word()) : this->BinaryNumber(type);
  }

  std::string Word()
  {
    const char* const blanks = " \t\r\n";
    const std::size_t begin = this->Bytes.find_first_not_of(blanks, this->At);
    if (begin == std::string::npos)
    {
      throw Failure("it ends too early");
    }
    this->At = std::min(this->Bytes.find_first_of(blanks, begin), this->Bytes.size());
    return this->Bytes.substr(begin, this->At - begin);
  }

  template <typename T>
  double Take()
  {
    char bytes[sizeof(T)];
    if (this->Bytes.size() - this->At < sizeof(T))
    {
      throw Failure("it ends too early");
    }
    std::copy_n(&this->Bytes[this->At], sizeof(T), bytes);
    this->At += sizeof(T);
    if (this->Form == PlyForm::BigEndian) // no machine is, on which VTK is built
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }

  double BinaryNumber(const std::string& type)
  {
    using Reader = double (PlyFile::*)();
    static const std::map<std::string, Reader> readers{ { "char", &PlyFile::Take<std::int8_t> },
      { "int8", &PlyFile::Take<std::int8_t> }, { "uchar", &PlyFile::Take<std::uint8_t> },
      { "uint8", &PlyFile::Take<std::uint8_t> }, { "short", &PlyFile::Take<std::int16_t> },
      { "int16", &PlyFile::Take<std::int16_t> }, { "ushort", &PlyFile::Take<std::uint16_t> },
      { "uint16", &PlyFile::Take<std::uint16_t> }, { "int", &PlyFile::Take<std::int32_t> },
      { "int32", &PlyFile::Take<std::int32_t> }, { "uint", &PlyFile::Take<std::uint32_t> },
      { "uint32", &PlyFile::Take<std::uint32_t> }, { "float", &PlyFile::Take<float> },
      { "float32", &PlyFile::Take<float> }, { "double", &PlyFile::Take<double> },
      { "float64", &PlyFile::Take<double> } };
    const auto found = readers.find(type);
    if (found == readers.end())
    {
      throw Failure("a property has no known type");
    }
    return (this->*found->second)();
  }

  std::string Bytes;
  std::size_t At = 0;
  PlyForm Form = PlyForm::Text;
  std::vector<PlyElement> Elements;
  std::vector<double> Positions;
  std::vector<std::vector<vtkIdType>> Faces;
};

/// `12`, `12/3`, `12//5` or `12/3/5`; counted from 1, or, where negative, back from the last
/// vertex.
vtkIdType ObjVertex(const std::string& word, vtkIdType numberOfPoints)
{
  const vtkIdType index = IndexIn(NumberIn(word.substr(0, word.find('/'))));
  return index < 0 ? numberOfPoints + index : index - 1;
}

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
  const bool beginsAsText = bytes.compare(0, 5, "solid") == 0;
  const bool isWhole = bytes.size() >= StlHeader &&
    bytes.size() >= StlHeader + StlTriangle * NumberOfStlTriangles(bytes);
  if (!beginsAsText && !isWhole)
  {
    throw Failure("it holds fewer triangles than its header says");
  }
  return !beginsAsText || (isWhole && bytes.find("facet") == std::string::npos);
}

/// Corners of triangles; those in the same place become one vertex.
class StlCorners
{
public:
  void Add(const std::array<double, 3>& point)
  {
    const auto found = this->Vertices.emplace(point, static_cast<vtkIdType>(this->Vertices.size()));
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

  vtkSmartPointer<vtkPolyData> Surface()
  {
    if (this->Corners.size() % 3 != 0)
    {
      throw Failure("its last triangle is not whole");
    }
    for (auto corner = this->Corners.begin(); corner != this->Corners.end(); corner += 3)
    {
      this->Found.AddFace({ corner, corner + 3 });
    }
    return this->Found.Surface();
  }

private:
  std::map<std::array<double, 3>, vtkIdType> Vertices;
  std::vector<vtkIdType> Corners;
  Polygons Found;
};

} // namespace

vtkSmartPointer<vtkPolyData> ReadPly(const std::string& name)
{
  return PlyFile(name).Read();
}

vtkSmartPointer<vtkPolyData> ReadObj(const std::string& name)
{
  std::istringstream file(Contents(name));
  Polygons polygons;
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

vtkSmartPointer<vtkPolyData> ReadStl(const std::string& name)
{
  const std::string bytes = Contents(name);
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
    return corners.Surface();
  }
  std::istringstream words(bytes);
  for (std::string word; words >> word;)
  {
    if (word == "vertex")
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
  return corners.Surface();
}

vtkSmartPointer<vtkPolyData> JudgedPolygons(vtkPolyData* surface)
{
  if (!surface->GetPolys()->IsValid())
  {
    throw Failure("its list of faces is damaged");
  }
  Polygons polygons;
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
  return polygons.Surface();
}

} // namespace Command
