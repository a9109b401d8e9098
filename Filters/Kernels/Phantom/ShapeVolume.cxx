#include "Phantom/ShapeVolume.h"

#include "Error.h"
#include "MessageText.h"
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

using Eigen::Array3i;
using Eigen::Vector3d;

// Each brick of voxels is painted by one thread.
const Array3i BrickSize(32, 32, 8);
constexpr int MaximumSamples = 4; // along an axis of a voxel

struct Block
{
  Array3i First;
  Array3i Size;
};

// Cuts a box across its longest edge that is not a single voxel.
std::pair<Block, Block> Halve(const Block& box, const Vector3d& spacing)
{
  Eigen::Index axis = 0;
  (box.Size > 1).select(box.Size.cast<double>() * spacing.array(), 0.0).maxCoeff(&axis);
  Block lower = box;
  Block upper = box;
  lower.Size[axis] = box.Size[axis] / 2;
  upper.Size[axis] = box.Size[axis] - lower.Size[axis];
  upper.First[axis] += lower.Size[axis];
  return { lower, upper };
}

// Paints one brick. Since a shape's value bounds the distance to its surface, only some layers may
// cross a given box of voxels. Boxes are halved until no layer crosses them or a single voxel is
// left. So the cost is proportional to the surfaces, not to the volume times the number of shapes.
class BrickPainter
{
public:
  BrickPainter(const TissueStack& stack, const ImageGeometry& geometry,
    const SamplingOptions& options, const SmoothField& field, const Block& brick)
    : Stack(stack)
    , Spacing(geometry.Spacing)
    , Field(field)
    , Brick(brick)
    , Middle(0.5 * (Eigen::Map<const Array3i>(geometry.Dimensions.data()).cast<double>() - 1))
    , Samples(Array3i::Ones())
    , Intensities(brick.Size.prod())
    , Labels(brick.Size.prod())
  {
    if (options.PartialVolume)
    {
      // As many along the longest edge as anywhere, so that sub-voxels are roughly cubic.
      const Eigen::Array3d edges = this->Spacing / this->Spacing.maxCoeff();
      this->Samples = (MaximumSamples * edges).round().cast<int>().max(2);
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
  // What may be visible in a box: the layers that cross it (a range of InDoubt, topmost first), and
  // the tissue below them.
  struct View
  {
    std::size_t First;
    std::size_t Last;
    const Tissue* Below;
  };

  // Appends to InDoubt those layers of the view whose surface may be within `reach` of a point. The
  // caller must restore its size. `atPoint` is the tissue at the point itself.
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

  void Paint(const Block& box, const View& view)
  {
    const Vector3d drawn = this->Draw(this->CenterOf(box));
    const Tissue* atCenter = nullptr;
    const std::size_t end = this->InDoubt.size();
    const View narrowed = this->Narrow(view, drawn, this->ReachOf(box), atCenter);
    if (narrowed.First == narrowed.Last)
    {
      this->Fill(box, *narrowed.Below);
    }
    else if ((box.Size == 1).all())
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

  void Fill(const Block& box, const Tissue& tissue)
  {
    for (int k = box.First[2]; k < box.First[2] + box.Size[2]; ++k)
    {
      for (int j = box.First[1]; j < box.First[1] + box.Size[1]; ++j)
      {
        for (int i = box.First[0]; i < box.First[0] + box.Size[0]; ++i)
        {
          this->Set({ i, j, k }, tissue.Intensity, tissue.Unevenness, tissue.Label);
        }
      }
    }
  }

  void FillVoxel(const Array3i& voxel, const Vector3d& drawn, const View& view,
    const Tissue& atCenter)
  {
    // Within a voxel the map to the drawing is nearly affine.
    const Vector3d center = this->CenterOf({ voxel, Array3i::Ones() });
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
    const double share = 1.0 / this->Samples.prod();
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

  void Set(const Array3i& voxel, double intensity, double unevenness, std::uint8_t label)
  {
    const Array3i in = voxel - this->Brick.First;
    const int offset = in[0] + this->Brick.Size[0] * (in[1] + this->Brick.Size[1] * in[2]);
    if (unevenness != 0)
    {
      intensity += unevenness * this->Field(this->CenterOf({ voxel, Array3i::Ones() }));
    }
    this->Intensities[offset] = static_cast<float>(intensity);
    this->Labels[offset] = label;
  }

  Vector3d Draw(const Vector3d& point) const
  {
    return this->Stack.ToDrawing ? this->Stack.ToDrawing(point) : point;
  }

  // The distance, in the drawing, of a box's outermost samples from its center.
  double ReachOf(const Block& box) const
  {
    const Eigen::Array3d span =
      (box.Size.cast<double>() - 1.0 / this->Samples.cast<double>()) * this->Spacing;
    return 0.5 * this->Stack.Stretch * span.matrix().norm();
  }

  Vector3d CenterOf(const Block& box) const
  {
    return (box.First.cast<double>() + 0.5 * (box.Size - 1).cast<double>() - this->Middle) *
      this->Spacing;
  }

  const TissueStack& Stack;
  const Eigen::Array3d Spacing;
  const SmoothField& Field;
  const Block Brick;
  const Eigen::Array3d Middle;
  Array3i Samples;
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
        "the spacing" + which + " must be positive, not " + TextOf(geometry.Spacing[axis]));
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
      "the volume would have more than 2^31 - 1 voxels; choose smaller "
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
  const Array3i dimensions(geometry.Dimensions.data());
  const Array3i bricks = (dimensions + BrickSize - 1) / BrickSize;

  const auto paintBrick = [&](const Array3i& brick)
  {
    const Array3i begin = brick * BrickSize;
    const Block box{ begin, BrickSize.min(dimensions - begin) };
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

  // Slab by slab, so that the monitor is called often, and from this thread.
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
          paintBrick(
            { static_cast<int>(brick % bricks[0]), static_cast<int>(brick / bricks[0]), z });
        }
      });
  }
  return monitor(1);
}

} // namespace FlipFree
