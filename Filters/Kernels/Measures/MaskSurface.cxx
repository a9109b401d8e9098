#include "Measures/MaskSurface.h"

#include "Measures/CellTriangles.h"
#include "Mesh/WindowedSinc.h"

#include <string_view>

namespace FlipFree
{
namespace
{

// Slice by slice through the bounding box with a margin of one voxel, which closes the surface.
// Points are numbered when a triangle first needs them.
class Boundary
{
public:
  explicit Boundary(const BitMask& mask)
    : Mask(mask)
    , Box(mask.Bounds())
    , Columns(this->Box.Size(0) + 2)
    , Rows(this->Box.Size(1) + 2)
    , Lower(this->Columns * this->Rows)
    , Upper(this->Columns * this->Rows)
  {
    for (std::vector<int>* points :
      { &this->AlongX[0], &this->AlongX[1], &this->AlongY[0], &this->AlongY[1], &this->AlongZ })
    {
      points->assign(this->Columns * this->Rows, None);
    }
  }

  void Trace()
  {
    this->ReadSlice(this->Box.Begin[2] - 1, this->Upper);
    for (int k = this->Box.Begin[2] - 1; k < this->Box.End[2]; ++k)
    {
      this->Lower.swap(this->Upper);
      this->ReadSlice(k + 1, this->Upper);
      this->AlongX[0].swap(this->AlongX[1]);
      this->AlongY[0].swap(this->AlongY[1]);
      this->AlongX[1].assign(this->AlongX[1].size(), None);
      this->AlongY[1].assign(this->AlongY[1].size(), None);
      this->AlongZ.assign(this->AlongZ.size(), None);
      for (std::ptrdiff_t j = 0; j + 1 < this->Rows; ++j)
      {
        this->TraceRow(j, k);
      }
    }
  }

  MaskSurface Get() const
  {
    using Eigen::Index;
    MaskSurface surface;
    surface.Points = Eigen::Map<const PointList>(this->Points.data(),
      static_cast<Index>(this->Points.size() / 3), 3);
    surface.Triangles = Eigen::Map<const TriangleList>(this->Corners.data(),
      static_cast<Index>(this->Corners.size() / 3), 3);
    return surface;
  }

private:
  static constexpr int None = -1;

  void ReadSlice(int k, std::vector<unsigned char>& slice) const
  {
    slice.assign(slice.size(), 0);
    if (k < this->Box.Begin[2] || k >= this->Box.End[2])
    {
      return;
    }
    this->Mask.ForEachRun(k, k + 1,
      [&](int begin, int end, int j, int)
      {
        const std::ptrdiff_t row = (j - this->Box.Begin[1] + 1) * this->Columns;
        const std::ptrdiff_t first = row + begin - this->Box.Begin[0] + 1;
        std::fill_n(slice.begin() + first, end - begin, static_cast<unsigned char>(1));
      });
  }

  void TraceRow(std::ptrdiff_t j, int k)
  {
    const std::ptrdiff_t row = j * this->Columns;
    const std::array<const unsigned char*, 4> rows{ { &this->Lower[row],
      &this->Lower[row + this->Columns], &this->Upper[row], &this->Upper[row + this->Columns] } };
    unsigned int inside = 0; // the cell's corners, one bit each, x fastest
    for (std::ptrdiff_t i = 0; i + 1 < this->Columns; ++i)
    {
      inside = (inside >> 1U) & 0x55U;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        inside |= static_cast<unsigned int>(rows[corner][i + 1]) << (2 * corner + 1);
      }
      for (const char edge : TrianglesOfCell(inside))
      {
        this->Corners.push_back(this->PointOn(EdgeOfDigit(edge), i, j, k));
      }
    }
  }

  // An edge: its axis, and where it begins among the cell's corners.
  int PointOn(const CellEdge& edge, std::ptrdiff_t i, std::ptrdiff_t j, int k)
  {
    const std::ptrdiff_t place = i + edge.Begin[0] + (j + edge.Begin[1]) * this->Columns;
    std::vector<int>& points = edge.Axis == 2 ? this->AlongZ
      : edge.Axis == 0                        ? this->AlongX[edge.Begin[2]]
                                              : this->AlongY[edge.Begin[2]];
    if (points[place] == None)
    {
      points[place] = static_cast<int>(this->Points.size() / 3);
      const std::array<double, 3> cell{ { static_cast<double>(this->Box.Begin[0] - 1 + i),
        static_cast<double>(this->Box.Begin[1] - 1 + j), static_cast<double>(k) } };
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Points.push_back(cell[axis] + edge.Begin[axis] + (axis == edge.Axis ? 0.5 : 0.0));
      }
    }
    return points[place];
  }

  const BitMask& Mask;
  const VoxelBox Box;
  const std::ptrdiff_t Columns;
  const std::ptrdiff_t Rows;
  std::vector<unsigned char> Lower; // slices of voxels: 1 inside
  std::vector<unsigned char> Upper;
  // The points on the grid's edges, by where these begin; of the lower and the upper slice.
  std::array<std::vector<int>, 2> AlongX;
  std::array<std::vector<int>, 2> AlongY;
  std::vector<int> AlongZ;
  std::vector<double> Points; // voxel indices
  std::vector<int> Corners;
};

} // namespace

MaskSurface SurfaceOf(const BitMask& mask, int smoothingIterations)
{
  if (mask.Bounds().IsEmpty())
  {
    return {};
  }
  Boundary boundary(mask);
  boundary.Trace();
  MaskSurface surface = boundary.Get();
  if (smoothingIterations > 0)
  {
    constexpr double passBand = 0.1;
    SmoothByWindowedSinc(surface.Triangles, smoothingIterations, passBand, surface.Points);
  }
  const ImageGeometry& geometry = mask.GetGeometry();
  const Eigen::Matrix3d toPhysical = geometry.Direction * geometry.Spacing.asDiagonal();
  surface.Points =
    ((surface.Points * toPhysical.transpose()).rowwise() + geometry.Origin.transpose()).eval();
  if (toPhysical.determinant() < 0)
  {
    surface.Triangles.col(1).swap(surface.Triangles.col(2));
  }
  return surface;
}

} // namespace FlipFree
