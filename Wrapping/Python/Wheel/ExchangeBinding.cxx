// Headers of image files, and the voxels that they describe.
#include "Bindings.h"
#include "Numpy.h"

#include "Exchange/FileNames.h"
#include "Exchange/LabelNameTable.h"
#include "Exchange/NiftiHeader.h"
#include "Exchange/PolygonFile.h"
#include "Exchange/SurfaceBytes.h"
#include "Exchange/TableText.h"
#include "Exchange/VolumeFileHeader.h"
#include "Exchange/VoxelDecoding.h"
#include "Exchange/VtpBytes.h"
#include "Exchange/VtpHeader.h"
#include "Mesh/SurfaceTopology.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/variant.h>

namespace FlipFree
{
namespace
{

using Values = nb::ndarray<nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

std::string TextOf(const nb::bytes& bytes)
{
  return { bytes.c_str(), bytes.size() };
}

/// Names of files, in whichever encoding.
std::vector<nb::bytes> FilesOf(const VolumeFileHeader& header)
{
  std::vector<nb::bytes> files;
  for (const std::string& file : header.Storage.Files)
  {
    files.emplace_back(file.data(), file.size());
  }
  return files;
}

void SetFiles(VolumeFileHeader& header, const std::vector<nb::bytes>& files)
{
  header.Storage.Files.clear();
  for (const nb::bytes& file : files)
  {
    header.Storage.Files.push_back(TextOf(file));
  }
}

/// As many of the values, from `first` on, as the bytes hold.
void DecodePart(const VolumeFileHeader& header, const nb::bytes& stored, Values& values,
  std::size_t first)
{
  const std::size_t count = stored.size() / SizeOf(header.Storage.Type);
  const std::size_t size = SizeOf(header.ValueType());
  if (values.itemsize() != size || first > values.size() || count > values.size() - first)
  {
    throw std::out_of_range("more voxels than values");
  }
  DecodeVoxels(header, stored.c_str(), count, static_cast<char*>(values.data()) + first * size);
}

void DecodeAllDigits(const VolumeFileHeader& header, const nb::bytes& stored, Values& values)
{
  if (values.itemsize() != SizeOf(header.ValueType()) ||
    values.size() != header.NumberOfStoredVoxels())
  {
    throw std::out_of_range("another number of voxels than of values");
  }
  DecodeDigits(header, TextOf(stored), values.data());
}

nb::bytes NiftiBytes(const std::string& name, const std::string& type, const Triple& size,
  const Triple& spacing, const Triple& origin, const Nine& direction)
{
  ImageGeometry grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Dimensions[axis] = static_cast<int>(size[axis]);
  }
  grid.Spacing = Eigen::Vector3d(spacing.data());
  grid.Origin = Eigen::Vector3d(origin.data());
  grid.Direction = Eigen::Map<const RowMajorMatrix>(direction.data());
  int code = 0;
  while (type != NameOf(static_cast<VoxelType>(code)))
  {
    if (static_cast<VoxelType>(code++) == VoxelType::Float64)
    {
      throw std::invalid_argument("voxels of type " + type);
    }
  }
  const std::string bytes = NiftiHeaderOf(name, grid, static_cast<VoxelType>(code));
  return nb::bytes(bytes.data(), bytes.size());
}

// The cells of each line, and what separates them.
nb::tuple TableOf(const std::string& name, const std::string& text)
{
  const TableText table = ReadTableText(name, text);
  std::vector<std::vector<std::string>> lines;
  for (const TableLine& line : table.Lines)
  {
    lines.push_back(line.Cells);
  }
  return nb::make_tuple(lines, std::string(1, table.Separator));
}

// Points, corners and offsets of faces.
nb::tuple PolygonsIn(const std::string& name, const nb::bytes& bytes)
{
  const CheckedPolygons polygons = ReadPolygonFile(name, TextOf(bytes));
  const std::size_t points = polygons.GetPoints().size() / 3;
  std::vector<int> corners = polygons.GetCorners();
  std::vector<int> offsets = polygons.GetOffsets();
  const std::size_t cornerCount = corners.size();
  const std::size_t offsetCount = offsets.size();
  return nb::make_tuple(ArrayOf<double>(std::vector<double>(polygons.GetPoints()), { points, 3 }),
    ArrayOf<int>(std::move(corners), { cornerCount }),
    ArrayOf<int>(std::move(offsets), { offsetCount }));
}

using Triangles =
  nb::ndarray<nb::numpy, const int, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Column = nb::ndarray<nb::numpy, nb::ro, nb::c_contig, nb::device::cpu>;

Eigen::Map<const PointList> PointsOf(const Rows3& points)
{
  return { points.data(), static_cast<Eigen::Index>(points.shape(0)), 3 };
}

Eigen::Map<const TriangleList> TrianglesOf(const Triangles& triangles)
{
  return { triangles.data(), static_cast<Eigen::Index>(triangles.shape(0)), 3 };
}

FaceList FacesOf(const Indices& corners, const Indices& offsets)
{
  return { { offsets.data(), offsets.data() + offsets.size() },
    { corners.data(), corners.data() + corners.size() } };
}

void RequireValid(const Rows3& points, const FaceList& faces)
{
  RequireValidFaces(PointsOf(points), faces, "the surface");
}

nb::bytes BytesOf(const std::string& bytes)
{
  return nb::bytes(bytes.data(), bytes.size());
}

/// By a format of triangles.
template <std::string (
  *Bytes)(const PointView&, const TriangleView&, const std::vector<std::string>&)>
nb::bytes BytesOfTriangles(const Rows3& points, const Triangles& triangles,
  const std::vector<std::string>& comments)
{
  RequireValid(points, FlipFree::FacesOf(TrianglesOf(triangles)));
  return BytesOf(Bytes(PointsOf(points), TrianglesOf(triangles), comments));
}

VtpArray VtpArrayOf(const std::string& name, const Column& column)
{
  const nb::dlpack::dtype type = column.dtype();
  const void* const data = column.data();
  if (type == nb::dtype<float>())
  {
    return VtpNumbers(name, static_cast<const float*>(data), column.size());
  }
  if (type == nb::dtype<int>())
  {
    return VtpNumbers(name, static_cast<const int*>(data), column.size());
  }
  if (type == nb::dtype<unsigned char>())
  {
    return VtpNumbers(name, static_cast<const unsigned char*>(data), column.size());
  }
  if (type != nb::dtype<double>())
  {
    throw std::invalid_argument("numbers of a type that no array of a surface has");
  }
  return VtpNumbers(name, static_cast<const double*>(data), column.size(),
    column.ndim() == 2 ? static_cast<int>(column.shape(1)) : 1);
}

// By name: numbers, arrays of them, or texts.
std::vector<VtpArray> VtpArraysOf(const nb::dict& columns)
{
  std::vector<VtpArray> arrays;
  for (const auto [key, value] : columns)
  {
    const auto name = nb::cast<std::string>(key);
    if (nb::isinstance<nb::str>(value))
    {
      arrays.push_back(VtpText(name, nb::cast<std::string>(value)));
    }
    else if (nb::isinstance<nb::float_>(value))
    {
      const auto number = nb::cast<double>(value);
      arrays.push_back(VtpNumbers(name, &number, 1));
    }
    else
    {
      arrays.push_back(VtpArrayOf(name, nb::cast<Column>(value)));
    }
  }
  return arrays;
}

} // namespace

void BindExchange(nb::module_& module)
{
  module.def("read_table", &TableOf);
  module.def("with_decimal_points", &WithDecimalPoints);
  module.def("read_polygons", &PolygonsIn);
  module.def("validate_vtp",
    [](const std::string& name, const nb::bytes& bytes) { ValidateVtp(name, TextOf(bytes)); });
  module.def("stl_bytes", &BytesOfTriangles<StlBytes>);
  module.def("ply_bytes", &BytesOfTriangles<PlyBytes>);
  module.def("obj_bytes",
    [](const Rows3& points, const Indices& corners, const Indices& offsets,
      const std::vector<std::string>& comments)
    {
      const FaceList faces = FacesOf(corners, offsets);
      RequireValid(points, faces);
      return BytesOf(ObjBytes(PointsOf(points), faces, comments));
    });
  module.def(
    "vtp_bytes",
    [](const Rows3& points, const Indices& corners, const Indices& offsets, const nb::dict& fields,
      const nb::dict& pointData, const nb::dict& cellData, bool areLines)
    {
      const FaceList faces = FacesOf(corners, offsets);
      if (!areLines)
      {
        RequireValid(points, faces);
      }
      return BytesOf(VtpBytes(PointsOf(points), faces,
        { VtpArraysOf(fields), VtpArraysOf(pointData), VtpArraysOf(cellData), areLines }));
    },
    nb::arg("points"), nb::arg("corners"), nb::arg("offsets"), nb::arg("fields"),
    nb::arg("point_data"), nb::arg("cell_data") = nb::dict(), nb::arg("are_lines") = false);
  module.def("read_label_names", &ReadLabelNameTable);
  module.def("label_file_name", &LabelFileName);
  nb::class_<VolumeFileHeader>(module, "VolumeFileHeader")
    .def("__init__",
      [](VolumeFileHeader* header, const std::string& name, const nb::bytes& start)
      { new (header) VolumeFileHeader(ReadVolumeFileHeader(name, TextOf(start))); })
    .def_ro("name", &VolumeFileHeader::Name)
    .def_ro("warnings", &VolumeFileHeader::Warnings)
    .def_ro("pairs", &VolumeFileHeader::Pairs)
    .def_prop_ro("value_type",
      [](const VolumeFileHeader& header) { return NameOf(header.ValueType()); })
    .def_prop_ro("voxel_bytes",
      [](const VolumeFileHeader& header) { return SizeOf(header.Storage.Type); })
    .def_prop_ro("size", [](const VolumeFileHeader& header) { return header.Geometry.Dimensions; })
    .def_prop_ro("layers", [](const VolumeFileHeader& header) { return header.Layers.Count; })
    .def_prop_ro("are_interleaved",
      [](const VolumeFileHeader& header) { return header.Layers.AreInterleaved; })
    .def_prop_ro("spacing",
      [](const VolumeFileHeader& header)
      {
        const Eigen::Vector3d& spacing = header.Geometry.Spacing;
        return Triple{ { spacing[0], spacing[1], spacing[2] } };
      })
    .def_prop_ro("origin",
      [](const VolumeFileHeader& header)
      {
        const Eigen::Vector3d& origin = header.Geometry.Origin;
        return Triple{ { origin[0], origin[1], origin[2] } };
      })
    .def_prop_ro("direction",
      [](const VolumeFileHeader& header)
      {
        Nine direction;
        Eigen::Map<RowMajorMatrix>(direction.data()) = header.Geometry.Direction;
        return direction;
      })
    .def_prop_rw("files", &FilesOf, &SetFiles)
    .def_prop_ro("may_be_packed",
      [](const VolumeFileHeader& header) { return header.Storage.MayBePacked; })
    .def("take_packed", [](VolumeFileHeader& header) { TakePacked(header.Storage); })
    .def_prop_ro("form", [](const VolumeFileHeader& header) { return NameOf(header.Storage.Form); })
    .def_prop_ro("offset", [](const VolumeFileHeader& header) { return header.Storage.Offset; })
    .def_prop_ro("lines", [](const VolumeFileHeader& header) { return header.Storage.Lines; })
    .def_prop_ro("skipped", [](const VolumeFileHeader& header) { return header.Storage.Skipped; })
    .def_prop_ro("is_at_end", [](const VolumeFileHeader& header) { return header.Storage.IsAtEnd; })
    .def("require_files", &RequireFiles)
    .def("decode", &DecodePart)
    .def("decode_digits", &DecodeAllDigits);
  module.def("header_files", &HeaderFilesOf);
  module.def("nifti_header", &NiftiBytes);
  module.def("table_text", &TextOfTable);
  module.def("broken_stream",
    [](const std::string& name)
    { return std::string(IncompleteVoxels(name, Incompleteness::BrokenStream).what()); });
  module.def("too_few_voxels",
    [](const std::string& name)
    { return std::string(IncompleteVoxels(name, Incompleteness::TooFewVoxels).what()); });
  module.attr("HEADER_BYTES") = BytesOfHeader;
  module.attr("PACKED_MARK") = nb::bytes(PackedMark, 2);
  module.attr("MISSING_FILE") = MissingFile;
  module.attr("IRREGULAR_FILE") = IrregularFile;
}

} // namespace FlipFree
