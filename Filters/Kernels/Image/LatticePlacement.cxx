#include "Image/LatticePlacement.h"

#include "Error.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// Of the least spacing: where files that round differently may put a voxel.
constexpr double PlacementTolerance = 0.1;

Eigen::Vector3d VectorOf(const std::array<int, 3>& numbers)
{
  return { 1.0 * numbers[0], 1.0 * numbers[1], 1.0 * numbers[2] };
}

// Each axis runs along the one of the lattice that points most alike.
LatticePlacement OrderOn(const ImageGeometry& lattice, const ImageGeometry& part)
{
  const Eigen::Matrix3d cosines = lattice.Direction.transpose() * part.Direction;
  LatticePlacement best;
  std::array<int, 3> axes{ { 0, 1, 2 } };
  double greatest = -1;
  do
  {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      sum += std::abs(cosines(axes[axis], axis));
    }
    if (sum > greatest)
    {
      greatest = sum;
      best.Axes = axes;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  for (int axis = 0; axis < 3; ++axis)
  {
    best.Steps[axis] = cosines(best.Axes[axis], axis) < 0 ? -1 : 1;
  }
  return best;
}

// How a grid lies on the lattice, and how far off. What differs is what moves the farthest of the
// compared voxels most.
class Comparison
{
public:
  Comparison(const ImageGeometry& lattice, const ImageGeometry& part)
    : Lattice(lattice)
    , Part(part)
    , Placement(OrderOn(lattice, part))
  {
    // In the overlap, if there is one: the voxel next to the lattice's middle.
    const Eigen::Vector3d last = VectorOf(part.Dimensions) - Eigen::Vector3d::Ones();
    const Eigen::Vector3d middle =
      lattice.ToPhysical(0.5 * (VectorOf(lattice.Dimensions) - Eigen::Vector3d::Ones()));
    const Eigen::Vector3d voxel =
      part.ToIndex(middle).array().round().max(0.0).min(last.array()).matrix();
    const Eigen::Vector3d place = lattice.ToIndex(part.ToPhysical(voxel)).array().round().matrix();
    for (int axis = 0; axis < 3; ++axis)
    {
      const int along = this->Placement.Axes[axis];
      const double first = place[along] - this->Placement.Steps[axis] * voxel[axis];
      const double end = first + this->Placement.Steps[axis] * last[axis];
      constexpr double limit = std::numeric_limits<int>::max() - 2.0;
      if (!(std::max(std::abs(first), std::abs(end)) < limit))
      {
        this->IsFar = true;
        return;
      }
      this->Placement.First[along] = static_cast<int>(first);
    }
    this->Compared = this->Placement.BoxOf(WholeBox(part)).Cropped(WholeBox(lattice));
    this->Overlap = !this->Compared.IsEmpty();
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!this->Overlap)
      {
        this->Compared.Begin[axis] = static_cast<int>(place[axis]);
      }
      // At least two voxels, which tell the spacing.
      const int second = this->Compared.Begin[axis] + 2;
      this->Compared.End[axis] =
        this->Overlap ? std::max(this->Compared.End[axis], second) : second;
    }
  }

  bool IsOnLattice() const
  {
    return !this->IsFar &&
      this->WorstShift().norm() <= PlacementTolerance * this->Lattice.Spacing.minCoeff();
  }
  bool AreApart() const { return this->IsFar || (this->IsOnLattice() && !this->Overlap); }
  const LatticePlacement& GetPlacement() const { return this->Placement; }

  // As "the spacings of it and of the other differ".
  std::string Difference(const std::string& nameOfLattice, const std::string& nameOfPart) const
  {
    Eigen::Vector3d spacing;
    double ofSpacing = 0;
    double ofDirection = 0;
    double angle = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int along = this->Placement.Axes[axis];
      const double length = this->Compared.Size(along) - 1;
      spacing[along] = this->Part.Spacing[axis];
      ofSpacing =
        std::max(ofSpacing, length * std::abs(spacing[along] - this->Lattice.Spacing[along]));
      const Eigen::Vector3d wanted =
        this->Placement.Steps[axis] * this->Lattice.Direction.col(along);
      const double turn = (this->Part.Direction.col(axis) - wanted).norm();
      ofDirection = std::max(ofDirection, length * turn * this->Lattice.Spacing[along]);
      angle = std::max(angle, 2 * std::asin(std::min(1.0, turn / 2)));
    }
    const std::string both = nameOfPart + " and of " + nameOfLattice;
    const double half = 0.5 * PlacementTolerance * this->Lattice.Spacing.minCoeff();
    if (ofSpacing > std::max(half, ofDirection))
    {
      return "the spacings of " + nameOfPart + " " + TextOf(spacing) + " mm and of " +
        nameOfLattice + " " + TextOf(this->Lattice.Spacing) + " mm differ";
    }
    if (ofDirection > half)
    {
      return "the axes of " + both + " differ by an angle of " +
        TextOf(angle * 180 / std::acos(-1.0)) + " degrees";
    }
    const Eigen::Vector3d voxels = this->Lattice.Direction.inverse() * this->WorstShift();
    const Eigen::Vector3d shift =
      (100 * voxels.cwiseQuotient(this->Lattice.Spacing)).array().round() / 100;
    return "the voxels of " + both + " differ by a shift of " + TextOf(shift) + " voxels";
  }

private:
  // From the lattice's voxel to the other grid's, at the corner where it is longest.
  Eigen::Vector3d WorstShift() const
  {
    Eigen::Vector3d worst = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner)
    {
      Eigen::Vector3d index;
      Eigen::Vector3d own;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int along = this->Placement.Axes[axis];
        index[along] =
          ((corner >> axis) & 1) == 0 ? this->Compared.Begin[along] : this->Compared.End[along] - 1;
        own[axis] = this->Placement.Steps[axis] * (index[along] - this->Placement.First[along]);
      }
      const Eigen::Vector3d shift = this->Part.ToPhysical(own) - this->Lattice.ToPhysical(index);
      if (!(shift.norm() <= worst.norm()))
      {
        worst = shift;
      }
    }
    return worst;
  }

  const ImageGeometry& Lattice;
  const ImageGeometry& Part;
  LatticePlacement Placement;
  VoxelBox Compared; // of the lattice
  bool Overlap = false;
  bool IsFar = false;
};

} // namespace

VoxelBox LatticePlacement::BoxOf(const VoxelBox& box) const
{
  const std::array<int, 3> one = this->IndexOf(box.Begin[0], box.Begin[1], box.Begin[2]);
  const std::array<int, 3> other = this->IndexOf(box.End[0] - 1, box.End[1] - 1, box.End[2] - 1);
  VoxelBox placed;
  for (int axis = 0; axis < 3; ++axis)
  {
    placed.Begin[axis] = std::min(one[axis], other[axis]);
    placed.End[axis] = std::max(one[axis], other[axis]) + 1;
  }
  return placed;
}

LatticePlacement PlacementOn(const ImageGeometry& lattice, const ImageGeometry& part,
  const std::string& nameOfLattice, const std::string& nameOfPart)
{
  const Comparison comparison(lattice, part);
  if (comparison.AreApart())
  {
    throw Error(ErrorCode::GeometryMismatch,
      nameOfLattice + " and " + nameOfPart +
        " do not overlap; check that both are in the same physical coordinates");
  }
  if (!comparison.IsOnLattice())
  {
    throw Error(ErrorCode::GeometryMismatch,
      comparison.Difference(nameOfLattice, nameOfPart) +
        "; resample one onto the grid of the other");
  }
  return comparison.GetPlacement();
}

bool HaveSamePlaces(const ImageGeometry& one, const ImageGeometry& other)
{
  const Comparison comparison(one, other);
  return comparison.IsOnLattice() &&
    comparison.GetPlacement().BoxOf(WholeBox(other)) == WholeBox(one);
}

BitMask PlacedIn(const VoxelBox& box, const ImageGeometry& lattice,
  const LatticePlacement& placement, const BitMask& part)
{
  BitMask placed(CropGeometry(lattice, box));
  part.ForEachRun(0, part.GetGeometry().Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const VoxelBox run =
        placement.BoxOf({ { { begin, j, k } }, { { end, j + 1, k + 1 } } }).Cropped(box);
      for (int z = run.Begin[2]; z < run.End[2]; ++z)
      {
        for (int y = run.Begin[1]; y < run.End[1]; ++y)
        {
          placed.InsertRun(run.Begin[0] - box.Begin[0], run.End[0] - box.Begin[0], y - box.Begin[1],
            z - box.Begin[2]);
        }
      }
    });
  return placed;
}

} // namespace FlipFree
