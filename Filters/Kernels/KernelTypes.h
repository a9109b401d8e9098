/**
 * The few types that the kernels share: point and face lists as Eigen matrices (the memory layout
 * of VTK's arrays, so that a filter can view them without a copy), the geometry of a voxel grid,
 * and the two hooks by which a kernel is threaded and stopped from outside.
 */
#ifndef FlipFreeKernelTypes_h
#define FlipFreeKernelTypes_h

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

namespace FlipFree
{

/// One row per point: x, y, z in millimeters.
using PointList = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One row per triangle: the indices of its three points, counter-clockwise seen from outside.
using TriangleList = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A direction matrix row by row, as VTK, numpy and JSON have it.
using RowMajorMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Polygons as in vtkCellArray: face f has the vertices Connectivity[Offsets[f]] up to, not
/// including, Connectivity[Offsets[f + 1]], counter-clockwise seen from outside.
struct FaceList
{
  std::vector<int> Offsets{ 0 };
  std::vector<int> Connectivity;

  int NumberOfFaces() const { return static_cast<int>(this->Offsets.size()) - 1; }
  int FaceSize(int face) const { return this->Offsets[face + 1] - this->Offsets[face]; }
  const int* Face(int face) const { return this->Connectivity.data() + this->Offsets[face]; }
  void Append(std::initializer_list<int> face)
  {
    this->Connectivity.insert(this->Connectivity.end(), face);
    this->Offsets.push_back(static_cast<int>(this->Connectivity.size()));
  }
};

/// A voxel grid in physical space. `Direction` holds the grid's unit axes in its columns; it may be
/// permuted, oblique, left-handed, or sheared (axes not at right angles: tilted gantries).
/// `Origin` is the center of voxel (0, 0, 0).
struct ImageGeometry
{
  std::array<int, 3> Dimensions{ { 0, 0, 0 } };
  Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  Eigen::Matrix3d Direction = Eigen::Matrix3d::Identity();

  Eigen::Vector3d ToPhysical(const Eigen::Vector3d& index) const
  {
    return this->Origin + this->Direction * this->Spacing.cwiseProduct(index);
  }
  /// Continuous index; voxel (i, j, k) covers i +- 1/2 and so on. The inverse is used, not the
  /// transpose, so that a direction matrix that is orthonormal only to its printed digits is exact.
  Eigen::Vector3d ToIndex(const Eigen::Vector3d& point) const
  {
    return (this->Direction.inverse() * (point - this->Origin)).cwiseQuotient(this->Spacing);
  }
  /// How far a ball reaches along each index axis, in voxels: its box in index space. Where axes
  /// are not at right angles, that is further than the radius divided by the spacing.
  Eigen::Vector3d IndexReach(double radius) const
  {
    return (radius * this->Direction.inverse().rowwise().norm()).cwiseQuotient(this->Spacing);
  }
  /// In cubic millimeters.
  double VoxelVolume() const
  {
    return std::abs(this->Spacing.prod() * this->Direction.determinant());
  }
  /// The volume of this many voxels.
  double Milliliters(std::size_t voxels) const
  {
    return static_cast<double>(voxels) * this->VoxelVolume() / 1000;
  }
  std::size_t NumberOfVoxels() const
  {
    return static_cast<std::size_t>(this->Dimensions[0]) * this->Dimensions[1] *
      this->Dimensions[2];
  }
  std::size_t Offset(int i, int j, int k) const
  {
    return i +
      static_cast<std::size_t>(this->Dimensions[0]) *
      (j + static_cast<std::size_t>(this->Dimensions[1]) * k);
  }
  bool Contains(int i, int j, int k) const
  {
    return i >= 0 && j >= 0 && k >= 0 && i < this->Dimensions[0] && j < this->Dimensions[1] &&
      k < this->Dimensions[2];
  }
};

/// Voxels that somebody else owns, x fastest.
template <typename T>
struct ImageView
{
  const T* Data = nullptr;
  ImageGeometry Geometry;

  const T& operator()(int i, int j, int k) const
  {
    return this->Data[this->Geometry.Offset(i, j, k)];
  }
};

/// Runs body(first, last) over disjoint parts of [begin, end), perhaps in several threads. A kernel
/// must give the same bits however the range is cut.
using RangeBody = std::function<void(std::ptrdiff_t first, std::ptrdiff_t last)>;
using ParallelFor =
  std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)>;

/// The single-threaded ParallelFor.
inline void SerialFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  if (begin < end)
  {
    body(begin, end);
  }
}

/// Asked now and then by long kernels with the fraction done, 0 to 1; false means stop at once.
using Monitor = std::function<bool(double fraction)>;

inline bool NeverStop(double)
{
  return true;
}

/// Forwards to a monitor until it asks to stop; from then on returns false without asking again. So
/// a stop in one part of the work stops the rest, and can be told later where what a part returns
/// does not tell it.
class RememberingMonitor
{
public:
  /// Refers to `monitor`.
  explicit RememberingMonitor(const Monitor& monitor)
    : Remembering(
        [this, &monitor](double fraction)
        {
          this->Stopped = this->Stopped || !monitor(fraction);
          return !this->Stopped;
        })
  {
  }
  explicit RememberingMonitor(Monitor&&) = delete;
  // Neither copied nor moved: Get() refers to this object.
  RememberingMonitor(const RememberingMonitor&) = delete;
  RememberingMonitor& operator=(const RememberingMonitor&) = delete;

  const Monitor& Get() const { return this->Remembering; }
  bool HasStopped() const { return this->Stopped; }

private:
  mutable bool Stopped = false; // asking changes it, also where the object is const
  const Monitor Remembering;
};

/// The monitor of a part of the work, from the fraction `first` to `last` of the whole. Refers to
/// the whole's monitor.
inline Monitor PartOf(const Monitor& monitor, double first, double last)
{
  return [&monitor, first, last](double fraction)
  { return monitor(first + fraction * (last - first)); };
}

} // namespace FlipFree

#endif
