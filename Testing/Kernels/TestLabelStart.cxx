// The surface with which a label is filled, whatever its topology, and what points do with it.
#include "Deformation/LabelStart.h"
#include "Deformation/SegmentationRequest.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/SurfaceVoxelization.h"

#include "ExampleVolumes.h"

#include <gtest/gtest.h>

#include <memory>

using namespace FlipFree;

namespace
{

// A ring, a shell with a cavity, and a sheet and a row of voxels, each apart from the others.
bool IsInPieces(const Eigen::Vector3d& point)
{
  const Eigen::Vector3d ring = point - Eigen::Vector3d(22, 22, 20);
  const double fromCircle = std::hypot(std::hypot(ring[0], ring[1]) - 14, ring[2]);
  const double fromShell = (point - Eigen::Vector3d(62, 24, 24)).norm();
  const bool isInSheet = std::abs(point[2] - 52) < 1 && point[0] < 40 && point[1] < 40;
  const bool isInRow = std::abs(point[2] - 52) < 1 && std::abs(point[1] - 60) < 1 && point[0] > 20;
  return fromCircle < 6 || (fromShell < 18 && fromShell > 9) || isInSheet || isInRow;
}

ImageGeometry GridOfPieces()
{
  return Grid({ { 42, 36, 30 } }, { 2, 2, 2 });
}

BitMask MaskOfRuns(const std::vector<VoxelRun>& runs, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  mask.InsertRuns(runs);
  return mask;
}

BitMask VoxelsIn(const DeformableSurface& surface, const ImageGeometry& geometry)
{
  return MaskOfRuns(VoxelizeSurface(surface.Points, surface.Mesh.Triangles, geometry), geometry);
}

// An image of nothing but noise, and a label map of the pieces.
class FilledPieces
{
public:
  FilledPieces()
  {
    std::mt19937 random(3);
    std::normal_distribution<float> normal(50, 5);
    const BitMask mask = MaskOf(this->Geometry, IsInPieces);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        this->Voxels.push_back(normal(random));
        this->Labels.push_back(mask(i, j, k) ? 1.0F : 0.0F);
      });
    this->Session = std::make_unique<OrganSession>(
      GrayVolumeOf(ImageView<float>{ this->Voxels.data(), this->Geometry }), "it", Threading());
    this->Session->FillLabel(
      LabelVolumeOf(ImageView<float>{ this->Labels.data(), this->Geometry }, "the labels", {}), 1);
  }

  VolumeSegmentation Fill(const ConstraintList& constraints)
  {
    OrganRequest request;
    request.Constraints = constraints;
    return this->Session->Segment(request, NeverStop, nullptr).Result;
  }

  const ImageGeometry Geometry = GridOfPieces();
  std::vector<float> Voxels;
  std::vector<float> Labels;
  std::unique_ptr<OrganSession> Session; // of the voxels, once there are any
};

} // namespace

TEST(LabelStart, HasTheVoxelsOfAnyMask)
{
  std::mt19937 random(11);
  const ImageGeometry geometry = Grid({ { 21, 17, 13 } }, { 1, 1.5, 2 });
  for (int trial = 0; trial < 5; ++trial)
  {
    BitMask mask(geometry);
    for (int box = 0; box < 6; ++box)
    {
      const VoxelBox voxels = RandomBox(geometry, random);
      ForEachVoxel(voxels, [&](int i, int j, int k) { mask.SetRun(box % 2 == 0, i, i + 1, j, k); });
    }
    mask.Insert(20, 16, 12); // at the corner of the image
    const DeformableSurface surface = SurfaceOfMask(mask, SerialFor, NeverStop);
    EXPECT_EQ(VoxelsIn(surface, geometry), mask);
    EXPECT_EQ(CountSelfIntersections(surface.Points, surface.Mesh.Faces), 0);
  }
}

TEST(LabelStart, OfNothingIsRefusedAndOfAStopHasNoPoints)
{
  BitMask mask(Grid({ { 5, 5, 5 } }, { 1, 1, 1 }));
  EXPECT_THROW(SurfaceOfMask(mask, SerialFor, NeverStop), Error);
  mask.Insert(2, 2, 2);
  EXPECT_EQ(SurfaceOfMask(mask, SerialFor, [](double) { return false; }).Points.rows(), 0);
}

TEST(LabelStart, FillsPiecesRingsCavitiesAndThinParts)
{
  FilledPieces pieces;
  const VolumeSegmentation result = pieces.Fill({});
  EXPECT_EQ(MaskOfRuns(result.Voxels, pieces.Geometry), MaskOf(pieces.Geometry, IsInPieces));
  EXPECT_EQ(result.Organ.SelfIntersections, 0);
  EXPECT_EQ(result.Organ.Reason, StopReason::DistanceBelowTolerance);
  EXPECT_EQ(result.Organ.Iterations.size(), 1U);
  // A ring, a ball and its cavity, and two sheets.
  EXPECT_EQ(result.Organ.Mesh.EulerNumber(), 0 + 2 + 2 + 2 + 2);
}

TEST(LabelStart, IsCorrectedByPointsAndStaysElsewhere)
{
  FilledPieces pieces;
  const BitMask before = MaskOf(pieces.Geometry, IsInPieces);
  const Eigen::Vector3d inside(62, 24, 48);  // above the shell
  const Eigen::Vector3d outside(36, 22, 20); // in the ring
  const Eigen::Vector3d boundary(62, 4, 24); // beside the shell
  const VolumeSegmentation result = pieces.Fill({ { ConstraintKind::Inside, inside },
    { ConstraintKind::Outside, outside }, { ConstraintKind::Boundary, boundary } });
  EXPECT_EQ(result.Organ.SelfIntersections, 0);
  const BitMask after = MaskOfRuns(result.Voxels, pieces.Geometry);
  EXPECT_TRUE(after(31, 12, 24));
  EXPECT_FALSE(after(18, 11, 10));
  EXPECT_LE((result.Organ.Points.rowwise() - boundary.transpose()).rowwise().norm().minCoeff(), 2);
  ForEachVoxel(pieces.Geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d place = pieces.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      const double near =
        std::min({ (place - inside).norm(), (place - outside).norm(), (place - boundary).norm() });
      if (near > 30)
      {
        EXPECT_EQ(after(i, j, k), before(i, j, k)) << place.transpose();
      }
    });
  // Without points, it is as before.
  EXPECT_EQ(MaskOfRuns(pieces.Fill({}).Voxels, pieces.Geometry), before);
}

TEST(LabelStart, AndAStartSurfaceExcludeEachOther)
{
  FilledPieces pieces;
  const DeformableSurface sphere = MakeStartSphere(4, { 30, 30, 30 }, 5);
  pieces.Session->StartFrom({ "the start surface", sphere.Points, sphere.Mesh.Faces });
  try
  {
    pieces.Fill({});
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.GetCode(), ErrorCode::OutOfRange);
    EXPECT_NE(error.GetText().find("the start surface and the labels cannot both be the start"),
      std::string::npos)
      << error.GetText();
  }
}
