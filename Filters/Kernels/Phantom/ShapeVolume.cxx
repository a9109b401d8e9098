#include "Phantom/ShapeVolume.h"

#include "Error.h"
#include "Phantom/VoxelNoise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;
using Index = std::array<int, 3>;

// A block of voxels that one thread paints on its own.
constexpr Index BrickSize = { { 32, 32, 8 } };
constexpr int MaximumSamples = 4;

struct VoxelBox
{
  Index First;
  Index Size;
};

// Cuts a box across its longest edge that is not a single voxel.
std::pair<VoxelBox, VoxelBox> Halve(const VoxelBox& box, const Vector3d& spacing)
{
  int axis = 0;
  double longest = 0;
  for (int candidate = 0; candidate < 3; ++candidate)
  {
    const double edge = box.Size[candidate] * spacing[candidate];
    if (box.Size[candidate] > 1 && edge > longest)
    {
      axis = candidate;
      longest = edge;
    }
  }
  VoxelBox lower = box;
  VoxelBox upper = box;
  lower.Size[axis] = box.Size[axis] / 2;
  upper.Size[axis] = box.Size[axis] - lower.Size[axis];
  upper.First[axis] += lower.Size[axis];
  return { lower, upper };
}

// Paints one brick. A box of voxels keeps only those layers whose surface may cross it, since a
// shape's value bounds the distance to its surface; boxes are halved until nothing is in doubt or
// one voxel is left, and voxels likewise down to their samples. So the cost goes with the surfaces,
// not with the volume times the number of shapes.
class BrickPainter
{
public:
  BrickPainter(const TissueStack& stack, const ImageGeometry& geometry,
    const SamplingOptions& options, const SmoothField& field, const VoxelBox& brick)
    : Stack(stack)
    , Spacing(geometry.Spacing)
    , Field(field)
    , Brick(brick)
    , Intensities(static_cast<std::size_t>(brick.Size[0]) * brick.Size[1] * brick.Size[2])
    , Labels(this->Intensities.size())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Middle[axis] = 0.5 * (geometry.Dimensions[axis] - 1);
      // As many along the longest edge as anywhere, so that sub-voxels come out about cubic.
      const double edge = this->Spacing[axis] / this->Spacing.maxCoeff();
      this->Samples[axis] = options.PartialVolume
        ? std::max(2, static_cast<int>(std::lround(MaximumSamples * edge)))
        : 1;
    }
  }

  void Paint()
  {
    for (auto layer = this->Stack.Layers.rbegin(); layer != this->Stack.Layers.rend(); ++layer)
    {
      this->InDoubt.push_back(&*layer);
    }
    this->Paint(this->Brick, { 0, this->InDoubt.size(), &this->Stack.Background });
  }

  std::vector<float>& GetIntensities() { return this->Intensities; }
  const std::vector<std::uint8_t>& GetLabels() const { return this->Labels; }

private:
  // What may show in a box: layers in doubt, a range of InDoubt with the topmost first, and what is
  // seen where all of them are absent.
  struct View
  {
    std::size_t First;
    std::size_t Last;
    const Tissue* Below;
  };

  // Appends to InDoubt the layers of the view that remain so within `reach` of a point. Its end
  // must be cut back to the former by the caller. `atPoint` is what shows at the point itself.
  View Narrow(const View& view, const Vector3d& drawn, double reach, const Tissue*& atPoint)
  {
    View narrowed{ this->InDoubt.size(), 0, view.Below };
    atPoint = nullptr;
    for (std::size_t i = view.First; i < view.Last; ++i)
    {
      const TissueLayer* layer = this->InDoubt[i];
      const double value = layer->Shape(drawn);
      if (!atPoint && value < 0)
      {
        atPoint = &layer->Tissue;
      }
      if (value < -reach)
      {
        narrowed.Below = &layer->Tissue;
        break;
      }
      if (value < reach)
      {
        this->InDoubt.push_back(layer);
      }
    }
    if (!atPoint)
    {
      atPoint = view.Below;
    }
    narrowed.Last = this->InDoubt.size();
    return narrowed;
  }

  void Paint(const VoxelBox& box, const View& view)
  {
    const Vector3d drawn = this->Draw(this->CenterOf(box));
    const Tissue* atCenter = nullptr;
    const std::size_t end = this->InDoubt.size();
    const View narrowed = this->Narrow(view, drawn, this->ReachOf(box), atCenter);
    if (narrowed.First == narrowed.Last)
    {
      this->Fill(box, *narrowed.Below);
    }
    else if (box.Size == Index{ { 1, 1, 1 } })
    {
      this->FillVoxel(box.First, drawn, narrowed, *atCenter);
    }
    else
    {
      const auto [lower, upper] = Halve(box, this->Spacing);
      this->Paint(lower, narrowed);
      this->Paint(upper, narrowed);
    }
    this->InDoubt.resize(end);
  }

  void Fill(const VoxelBox& box, const Tissue& tissue)
  {
    for (int k = box.First[2]; k < box.First[2] + box.Size[2]; ++k)
    {
      for (int j = box.First[1]; j < box.First[1] + box.Size[1]; ++j)
      {
        for (int i = box.First[0]; i < box.First[0] + box.Size[0]; ++i)
        {
          this->Set({ { i, j, k } }, tissue.Intensity, tissue.Unevenness, tissue.Label);
        }
      }
    }
  }

  void FillVoxel(const Index& voxel, const Vector3d& drawn, const View& view,
    const Tissue& atCenter)
  {
    // Within a voxel the drawing's frame is as good as affine.
    const Vector3d center = this->CenterOf({ voxel, { { 1, 1, 1 } } });
    Eigen::Matrix3d edges;
    for (int axis = 0; axis < 3; ++axis)
    {
      edges.col(axis) = this->Draw(center + this->Spacing[axis] * Vector3d::Unit(axis)) - drawn;
    }
    double intensity = 0;
    double unevenness = 0;
    for (int w = 0; w < this->Samples[2]; ++w)
    {
      for (int v = 0; v < this->Samples[1]; ++v)
      {
        for (int u = 0; u < this->Samples[0]; ++u)
        {
          const Vector3d within((u + 0.5) / this->Samples[0] - 0.5,
            (v + 0.5) / this->Samples[1] - 0.5, (w + 0.5) / this->Samples[2] - 0.5);
          const Tissue& tissue = this->TopmostAt(drawn + edges * within, view);
          intensity += tissue.Intensity;
          unevenness += tissue.Unevenness;
        }
      }
    }
    const double share = 1.0 / (this->Samples[0] * this->Samples[1] * this->Samples[2]);
    this->Set(voxel, share * intensity, share * unevenness, atCenter.Label);
  }

  const Tissue& TopmostAt(const Vector3d& drawn, const View& view) const
  {
    for (std::size_t i = view.First; i < view.Last; ++i)
    {
      if (this->InDoubt[i]->Shape(drawn) < 0)
      {
        return this->InDoubt[i]->Tissue;
      }
    }
    return *view.Below;
  }

  void Set(const Index& voxel, double intensity, double unevenness, std::uint8_t label)
  {
    const std::size_t offset = voxel[0] - this->Brick.First[0] +
      static_cast<std::size_t>(this->Brick.Size[0]) *
        (voxel[1] - this->Brick.First[1] +
          static_cast<std::size_t>(this->Brick.Size[1]) * (voxel[2] - this->Brick.First[2]));
    if (unevenness != 0)
    {
      intensity += unevenness * this->Field(this->CenterOf({ voxel, { { 1, 1, 1 } } }));
    }
    this->Intensities[offset] = static_cast<float>(intensity);
    this->Labels[offset] = label;
  }

  Vector3d Draw(const Vector3d& point) const
  {
    return this->Stack.ToDrawing ? this->Stack.ToDrawing(point) : point;
  }

  // How far, in the drawing, the outermost samples of a box lie from its center.
  double ReachOf(const VoxelBox& box) const
  {
    Vector3d span;
    for (int axis = 0; axis < 3; ++axis)
    {
      span[axis] = (box.Size[axis] - 1.0 / this->Samples[axis]) * this->Spacing[axis];
    }
    return 0.5 * this->Stack.Stretch * span.norm();
  }

  Vector3d CenterOf(const VoxelBox& box) const
  {
    Vector3d center;
    for (int axis = 0; axis < 3; ++axis)
    {
      center[axis] =
        (box.First[axis] + 0.5 * (box.Size[axis] - 1) - this->Middle[axis]) * this->Spacing[axis];
    }
    return center;
  }

  const TissueStack& Stack;
  const Vector3d Spacing;
  const SmoothField& Field;
  const VoxelBox Brick;
  Vector3d Middle;
  Index Samples;
  std::vector<const TissueLayer*> InDoubt;
  std::vector<float> Intensities;
  std::vector<std::uint8_t> Labels;
};

void CopyRow(const float* from, int size, std::int16_t* to)
{
  using Limits = std::numeric_limits<std::int16_t>;
  for (int i = 0; i < size; ++i)
  {
    const float rounded = std::round(from[i]);
    to[i] = static_cast<std::int16_t>(std::clamp<float>(rounded, Limits::lowest(), Limits::max()));
  }
}

} // namespace

void RequireGrid(const ImageGeometry& geometry)
{
  double voxels = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::string which = " of axis " + std::to_string(axis);
    if (geometry.Dimensions[axis] < 1)
    {
      throw Error(ErrorCode::InvalidGeometry,
        "the dimension" + which + " must be at least 1, not " +
          std::to_string(geometry.Dimensions[axis]));
    }
    if (!(geometry.Spacing[axis] > 0) || !std::isfinite(geometry.Spacing[axis]))
    {
      throw Error(ErrorCode::InvalidGeometry,
        "the spacing" + which + " must be positive, not " + std::to_string(geometry.Spacing[axis]));
    }
    if (!std::isfinite(geometry.Origin[axis]))
    {
      throw Error(ErrorCode::InvalidGeometry, "the origin" + which + " must be finite");
    }
    voxels *= geometry.Dimensions[axis];
  }
  if (voxels > std::numeric_limits<int>::max())
  {
    throw Error(ErrorCode::TooLarge,
      "a volume of more than 2^31 - 1 voxels is not made; choose smaller "
      "dimensions and a larger spacing");
  }
  const double determinant = geometry.Direction.determinant();
  if (!std::isfinite(determinant) || std::abs(determinant) < 1e-6)
  {
    throw Error(ErrorCode::InvalidGeometry,
      "the direction matrix cannot be inverted (determinant " + std::to_string(determinant) +
        "); its columns must be three independent axes");
  }
}

Vector3d GridExtent(const ImageGeometry& geometry)
{
  return Eigen::Map<const Eigen::Vector3i>(geometry.Dimensions.data())
    .cast<double>()
    .cwiseProduct(geometry.Spacing);
}

Vector3d GridToPhysical(const ImageGeometry& geometry, const Vector3d& local)
{
  const Vector3d middle =
    0.5 * (GridExtent(geometry) - geometry.Spacing).cwiseQuotient(geometry.Spacing);
  return geometry.ToPhysical(middle + local.cwiseQuotient(geometry.Spacing));
}

bool SampleTissues(const TissueStack& stack, const ImageGeometry& geometry,
  const SamplingOptions& options, std::int16_t* intensities, std::uint8_t* labels,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  RequireGrid(geometry);
  RequireNoise(options.NoiseStandardDeviation, options.NoiseCorrelation);
  const SmoothField field(~options.Seed, stack.FieldCell, GridExtent(geometry));
  Index bricks;
  for (int axis = 0; axis < 3; ++axis)
  {
    bricks[axis] = (geometry.Dimensions[axis] + BrickSize[axis] - 1) / BrickSize[axis];
  }

  const auto paintBrick = [&](int x, int y, int z)
  {
    VoxelBox box;
    const Index which = { { x, y, z } };
    for (int axis = 0; axis < 3; ++axis)
    {
      box.First[axis] = which[axis] * BrickSize[axis];
      box.Size[axis] = std::min(BrickSize[axis], geometry.Dimensions[axis] - box.First[axis]);
    }
    BrickPainter painter(stack, geometry, options, field, box);
    painter.Paint();
    AddNoise(options.Seed, options.NoiseStandardDeviation, options.NoiseCorrelation, box.First,
      box.Size, painter.GetIntensities().data());
    for (int row = 0; row < box.Size[1] * box.Size[2]; ++row)
    {
      const std::size_t from = static_cast<std::size_t>(row) * box.Size[0];
      const std::size_t to = geometry.Offset(box.First[0], box.First[1] + row % box.Size[1],
        box.First[2] + row / box.Size[1]);
      CopyRow(&painter.GetIntensities()[from], box.Size[0], intensities + to);
      std::copy_n(&painter.GetLabels()[from], box.Size[0], labels + to);
    }
  };

  // Slab after slab, so that the monitor is asked from this thread and soon enough.
  for (int z = 0; z < bricks[2]; ++z)
  {
    if (!monitor(static_cast<double>(z) / bricks[2]))
    {
      return false;
    }
    parallelFor(0, static_cast<std::ptrdiff_t>(bricks[0]) * bricks[1],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t brick = first; brick < last; ++brick)
        {
          paintBrick(static_cast<int>(brick % bricks[0]), static_cast<int>(brick / bricks[0]), z);
        }
      });
  }
  return monitor(1);
}

} // namespace FlipFree
