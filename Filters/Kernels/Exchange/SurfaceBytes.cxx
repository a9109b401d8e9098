#include "Exchange/SurfaceBytes.h"

#include "Exchange/ByteOrder.h"
#include "MessageText.h"

#include <Eigen/Geometry>

namespace FlipFree
{
namespace
{

constexpr std::size_t StlHeaderSize = 80;

template <typename Numbers>
void AppendSingle(std::string& bytes, const Numbers& numbers)
{
  for (Eigen::Index index = 0; index < numbers.size(); ++index)
  {
    AppendLittleEndian(bytes, static_cast<float>(numbers[index]));
  }
}

} // namespace

std::string StlBytes(const PointView& points, const TriangleView& triangles,
  const std::vector<std::string>& comments)
{
  std::string bytes = comments.empty() ? std::string() : comments.front();
  bytes.resize(StlHeaderSize, ' ');
  AppendLittleEndian(bytes, static_cast<std::uint32_t>(triangles.rows()));
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a = points.row(triangles(triangle, 0));
    const Eigen::Vector3d b = points.row(triangles(triangle, 1));
    const Eigen::Vector3d c = points.row(triangles(triangle, 2));
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double length = normal.norm();
    AppendSingle(bytes, normal / (length > 0 ? length : 1));
    AppendSingle(bytes, a);
    AppendSingle(bytes, b);
    AppendSingle(bytes, c);
    AppendLittleEndian(bytes, std::uint16_t{ 0 });
  }
  return bytes;
}

std::string PlyBytes(const PointView& points, const TriangleView& triangles,
  const std::vector<std::string>& comments)
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments)
  {
    bytes += "comment " + comment + "\n";
  }
  bytes += "element vertex " + std::to_string(points.rows()) +
    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
    std::to_string(triangles.rows()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    AppendSingle(bytes, points.row(point));
  }
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    AppendLittleEndian(bytes, std::uint8_t{ 3 });
    for (int corner = 0; corner < 3; ++corner)
    {
      AppendLittleEndian(bytes, std::int32_t{ triangles(triangle, corner) });
    }
  }
  return bytes;
}

std::string ObjBytes(const PointView& points, const FaceList& faces,
  const std::vector<std::string>& comments)
{
  std::string bytes;
  for (const std::string& comment : comments)
  {
    bytes += "# " + comment + "\n";
  }
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    bytes += 'v';
    for (int axis = 0; axis < 3; ++axis)
    {
      bytes += ' ' + ExactTextOf(points(point, axis));
    }
    bytes += '\n';
  }
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    bytes += 'f';
    for (int corner = 0; corner < faces.FaceSize(face); ++corner)
    {
      bytes += ' ' + std::to_string(faces.Face(face)[corner] + 1);
    }
    bytes += '\n';
  }
  return bytes;
}

} // namespace FlipFree
