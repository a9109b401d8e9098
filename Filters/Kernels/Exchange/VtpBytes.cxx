#include "Exchange/VtpBytes.h"

#include "Exchange/ByteOrder.h"

namespace FlipFree
{
namespace
{

template <typename T>
VtpArray ArrayOf(const std::string& name, const char* type, const T* values, std::size_t count,
  int components)
{
  VtpArray array{ name, type, components, {} };
  array.Bytes.reserve(count * sizeof(T));
  for (std::size_t index = 0; index < count; ++index)
  {
    AppendLittleEndian(array.Bytes, values[index]);
  }
  return array;
}

// Elements that say where their arrays begin in the data behind all of them.
class AppendedArrays
{
public:
  std::string Field(const VtpArray& array)
  {
    const bool isText = array.Type == std::string("String");
    return this->Element(isText ? "Array" : "DataArray", array, "NumberOfTuples=\"1\"");
  }

  std::string Data(const VtpArray& array)
  {
    return this->Element("DataArray", array,
      "NumberOfComponents=\"" + std::to_string(array.Components) + "\"");
  }

  std::string All(const std::vector<VtpArray>& arrays)
  {
    std::string text;
    for (const VtpArray& array : arrays)
    {
      text += this->Data(array);
    }
    return text;
  }

  const std::string& Bytes() const { return this->Appended; }

private:
  std::string Element(const std::string& element, const VtpArray& array, const std::string& size)
  {
    const std::size_t offset = this->Appended.size();
    AppendLittleEndian(this->Appended, static_cast<std::uint64_t>(array.Bytes.size()));
    this->Appended += array.Bytes;
    return "<" + element + " type=\"" + array.Type + "\" Name=\"" + array.Name + "\" " + size +
      R"( format="appended" offset=")" + std::to_string(offset) + "\"/>";
  }

  std::string Appended;
};

} // namespace

VtpArray VtpNumbers(const std::string& name, const double* values, std::size_t count,
  int components)
{
  return ArrayOf(name, "Float64", values, count, components);
}

VtpArray VtpNumbers(const std::string& name, const float* values, std::size_t count)
{
  return ArrayOf(name, "Float32", values, count, 1);
}

VtpArray VtpNumbers(const std::string& name, const int* values, std::size_t count)
{
  return ArrayOf(name, "Int32", values, count, 1);
}

VtpArray VtpNumbers(const std::string& name, const unsigned char* values, std::size_t count)
{
  return ArrayOf(name, "UInt8", values, count, 1);
}

VtpArray VtpText(const std::string& name, const std::string& text)
{
  return { name, "String", 1, text + '\0' };
}

std::string VtpBytes(const Eigen::Ref<const PointList>& points, const FaceList& cells,
  const VtpContent& content)
{
  const PointList rows = points; // one behind the other
  const std::string count = std::to_string(cells.NumberOfFaces());
  AppendedArrays arrays;
  std::string fields;
  for (const VtpArray& field : content.Fields)
  {
    fields += arrays.Field(field);
  }
  std::string text = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData>
<FieldData>)" +
    fields + "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(rows.rows()) +
    R"(" NumberOfVerts="0" NumberOfLines=")" + (content.AreLines ? count : "0") +
    R"(" NumberOfStrips="0" NumberOfPolys=")" + (content.AreLines ? "0" : count) + "\">\n";
  text += "<PointData>" + arrays.All(content.PointData) + "</PointData>\n";
  text += "<CellData>" + arrays.All(content.CellData) + "</CellData>\n";
  text += "<Points>" +
    arrays.Data(VtpNumbers("Points", rows.data(), static_cast<std::size_t>(rows.size()), 3)) +
    "</Points>\n";
  const std::string element = content.AreLines ? "Lines" : "Polys";
  text += "<" + element + ">" +
    arrays.Data(VtpNumbers("connectivity", cells.Connectivity.data(), cells.Connectivity.size())) +
    arrays.Data(VtpNumbers("offsets", cells.Offsets.data() + 1, cells.Offsets.size() - 1)) + "</" +
    element + ">\n";
  return text + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + arrays.Bytes() +
    "\n</AppendedData>\n</VTKFile>\n";
}

} // namespace FlipFree
