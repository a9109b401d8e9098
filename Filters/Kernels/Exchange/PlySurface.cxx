#include "Exchange/PolygonFile.h"
#include "TextWords.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace FlipFree
{
namespace
{

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
  std::int64_t Count = 0;
  std::vector<PlyProperty> Properties;
};

class PlyFile
{
public:
  explicit PlyFile(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  CheckedPolygons Read()
  {
    this->ReadHeader();
    for (const PlyElement& element : this->Elements)
    {
      for (std::int64_t index = 0; index < element.Count; ++index)
      {
        this->ReadElement(element);
      }
    }
    CheckedPolygons polygons; // faces may stand before vertices
    for (std::size_t begin = 0; begin < this->Positions.size(); begin += 3)
    {
      polygons.AddPoint(&this->Positions[begin]);
    }
    for (const std::vector<std::int64_t>& face : this->Faces)
    {
      polygons.AddFace(face);
    }
    if (this->IsRas)
    {
      polygons.SwapRasLps();
    }
    return polygons;
  }

private:
  std::vector<std::string> LineOfHeader()
  {
    const std::size_t end = this->Bytes.find('\n', this->At);
    if (end == std::string::npos)
    {
      RefusePolygons("its header does not end");
    }
    std::vector<std::string> words = Words(this->Bytes.substr(this->At, end - this->At));
    this->At = end + 1;
    this->IsRas = this->IsRas ||
      (!words.empty() && words.front() == "comment" &&
        std::any_of(words.begin(), words.end(), SaysRas));
    return words;
  }

  void ReadHeader()
  {
    if (this->LineOfHeader() != std::vector<std::string>{ "ply" })
    {
      RefusePolygons("it does not begin with 'ply'");
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
        RefusePolygons("a line of its header is not understood");
      }
    }
    if (!hasForm)
    {
      RefusePolygons("its header does not state the format");
    }
    for (const PlyElement& element : this->Elements)
    {
      // Each takes at least a byte, so that a wrong count ends with the file.
      if (element.Count < 0 || (element.Properties.empty() && element.Count > 0))
      {
        RefusePolygons("it cannot hold so many elements");
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
        RefusePolygons("its vertices have no x, y and z");
      }
      this->Positions.insert(this->Positions.end(), position, position + 3);
    }
  }

  void ReadList(const PlyProperty& property, bool isOfFace)
  {
    const std::int64_t count = IndexIn(this->Number(property.CountType));
    std::vector<std::int64_t> list;
    const bool isFace =
      isOfFace && (property.Name == "vertex_indices" || property.Name == "vertex_index");
    for (std::int64_t index = 0; index < count; ++index)
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
      RefusePolygons("the file is truncated");
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
      RefusePolygons("the file is truncated");
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
      RefusePolygons("a property has no known type");
    }
    return (this->*found->second)();
  }

  const std::string& Bytes;
  std::size_t At = 0;
  PlyForm Form = PlyForm::Text;
  bool IsRas = false;
  std::vector<PlyElement> Elements;
  std::vector<double> Positions;
  std::vector<std::vector<std::int64_t>> Faces;
};

} // namespace

CheckedPolygons ReadPly(const std::string& bytes)
{
  return PlyFile(bytes).Read();
}

} // namespace FlipFree
