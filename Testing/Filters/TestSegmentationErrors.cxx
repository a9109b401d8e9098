// Whatever is wrong with the input of a segmentation: one error that says what, where, and what to
// do, and empty outputs.
#include "vtkFlipFreeSegmentation.h"

#include "BadInput.h"
#include "FilterErrors.h"

#include "vtkBitArray.h"
#include "vtkTable.h"

using namespace FlipFree;

namespace
{

class SegmentationRefuses : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Filter->SetInputDataObject(SphereImage());
    this->Filter->SetSeedCenter(ExampleCenter.data());
    this->Filter->SetSeedRadius(ExampleRadius);
    this->Filter->SetResolution(8);
    this->Filter->SetLevels(2);
  }
  void ExpectImageRefused(vtkImageData* image, const std::vector<std::string>& parts)
  {
    this->Filter->SetInputDataObject(image);
    ExpectRefusal(this->Filter, parts);
  }
  void ExpectStartRefused(vtkPolyData* start, const std::vector<std::string>& parts)
  {
    this->Filter->SetStartData(start);
    ExpectRefusal(this->Filter, parts);
  }
  void ExpectSegmentation()
  {
    EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 6 * 8 * 8);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 32 * 32 * 32);
    EXPECT_GT(this->Filter->GetConvergence()->GetNumberOfRows(), 0);
    EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), 0);
    EXPECT_NE(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND);
  }

  vtkNew<vtkFlipFreeSegmentation> Filter;
};

} // namespace

TEST_F(SegmentationRefuses, NothingThatIsGood)
{
  this->ExpectSegmentation();
}

TEST_F(SegmentationRefuses, NoImage)
{
  this->Filter->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
}

TEST_F(SegmentationRefuses, ASurfaceForAnImage)
{
  this->Filter->SetInputDataObject(StartSphere());
  ExpectPipelineRefusal(this->Filter, "port");
}

TEST_F(SegmentationRefuses, AnImageForAStart)
{
  this->Filter->SetInputDataObject(1, SphereImage());
  ExpectPipelineRefusal(this->Filter, "port");
}

TEST_F(SegmentationRefuses, AnImageWithoutVoxels)
{
  vtkNew<vtkImageData> empty;
  this->ExpectImageRefused(empty, { "the image on port 0", "no voxels", "connect" });
}

TEST_F(SegmentationRefuses, AnImageWithoutScalars)
{
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(32, 32, 32);
  this->ExpectImageRefused(bare, { "the image on port 0", "no point scalars", "active" });
}

TEST_F(SegmentationRefuses, TooFewScalars)
{
  const auto image = SphereImage();
  vtkNew<vtkDoubleArray> few;
  few->SetNumberOfValues(100);
  image->GetPointData()->SetScalars(few);
  this->ExpectImageRefused(image, { "the image on port 0", "100 scalars for 32768 voxels" });
}

TEST_F(SegmentationRefuses, SeveralComponents)
{
  this->ExpectImageRefused(ImageOfType(VTK_SHORT, 3),
    { "the image on port 0", "3 components", "vtkImageExtractComponents" });
}

TEST_F(SegmentationRefuses, Bits)
{
  vtkNew<vtkBitArray> bits;
  bits->SetNumberOfValues(32 * 32 * 32);
  bits->Fill(1);
  const auto image = SphereImage();
  image->GetPointData()->SetScalars(bits);
  this->ExpectImageRefused(image, { "the image on port 0", "bit", "unsigned char" });
}

TEST_F(SegmentationRefuses, VoxelsThatAreNotFinite)
{
  for (const double value : { NotANumber, Infinite, -Infinite })
  {
    this->ExpectImageRefused(ImageWith(value),
      { "the image on port 0", "(45, 48, 51) mm", "not a finite number", "replace" });
  }
}

TEST_F(SegmentationRefuses, ButNotVoxelsFarFromTheSeed)
{
  const auto image = ImageWith(0);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, NotANumber);
  this->Filter->SetInputDataObject(image);
  this->Filter->SetReach(40);
  this->ExpectSegmentation();
}

TEST_F(SegmentationRefuses, SpacingThatIsNotPositive)
{
  for (const double spacing : { 0.0, -3.0, NotANumber })
  {
    const auto image = SphereImage();
    image->SetSpacing(3, spacing, 3);
    this->ExpectImageRefused(image, { "the image on port 0", "spacing", "direction matrix" });
  }
}

TEST_F(SegmentationRefuses, AxesThatLieInAPlane)
{
  const auto image = SphereImage();
  image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 0);
  this->ExpectImageRefused(image, { "the image on port 0", "direction matrix", "inverted" });
}

TEST_F(SegmentationRefuses, ASeedOutsideTheImage)
{
  this->Filter->SetSeedCenter(46, 46, 94.6);
  ExpectRefusal(this->Filter,
    { "(46, 46, 94.6) mm", "outside the image on port 0", "to (93, 93, 93) mm",
      "physical coordinates" });
  this->Filter->SetSeedCenter(NotANumber, 46, 46);
  ExpectRefusal(this->Filter, { "nan", "outside the image on port 0" });
}

TEST_F(SegmentationRefuses, ASeedSmallerThanAVoxel)
{
  for (const double radius : { 2.9, 0.0, -10.0, NotANumber })
  {
    this->Filter->SetSeedRadius(radius);
    this->Filter->Modified(); // the least radius may be set already
    ExpectRefusal(this->Filter,
      { "seed's radius", "below a voxel of the image on port 0 (3 mm)", "enlarge" });
  }
}

TEST_F(SegmentationRefuses, ASeedBetweenTheVoxels)
{
  const auto image = SphereImage();
  image->SetSpacing(3, 3, 9); // so that a sphere fits between slices
  this->Filter->SetInputDataObject(image);
  this->Filter->SetSeedCenter(45, 45, 139.5);
  this->Filter->SetSeedRadius(3.5);
  ExpectRefusal(this->Filter, { "no voxel center", "seed sphere", "enlarge" });
}

TEST_F(SegmentationRefuses, NoContrast)
{
  this->ExpectImageRefused(ImageOfType(VTK_FLOAT), { "no contrast", "32768 voxels", "check" });
}

TEST_F(SegmentationRefuses, ButNotASeedOfOneValueWithContrast)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetDimensions(32, 32, 32);
  phantom->SetSpacing(3, 3, 3);
  phantom->SetNoiseStandardDeviation(0);
  this->Filter->SetInputConnection(phantom->GetOutputPort());
  this->ExpectSegmentation();
}

TEST_F(SegmentationRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetPositionWeight(NotANumber);
  ExpectRefusal(this->Filter, { "the property PositionWeight", "NaN", "set it" });
  this->Filter->SetPositionWeight(0.3);
  this->Filter->SetStartCenterOffset(0, NotANumber, 0);
  ExpectRefusal(this->Filter, { "the property StartCenterOffset", "NaN", "set it" });
}

TEST_F(SegmentationRefuses, AStartWithoutPoints)
{
  vtkNew<vtkPolyData> empty;
  this->ExpectStartRefused(empty, { "the start surface on port 1", "no points" });
}

TEST_F(SegmentationRefuses, AStartOfPointsAlone)
{
  const auto points = StartSphere();
  points->SetPolys(nullptr);
  this->ExpectStartRefused(points, { "the start surface on port 1", "no polygons" });
}

TEST_F(SegmentationRefuses, AnOpenStart)
{
  this->ExpectStartRefused(OpenSphere(), { "the start surface on port 1", "vertex", "closed" });
}

TEST_F(SegmentationRefuses, AStartThatIsNotFourValent)
{
  this->ExpectStartRefused(TriangulatedBox(),
    { "the start surface on port 1", "vertex 0", "four neighbors" });
}

TEST_F(SegmentationRefuses, ASelfIntersectingStart)
{
  this->ExpectStartRefused(SelfIntersectingSphere(),
    { "the start surface on port 1", "intersects itself", "near (", "embedded" });
}

TEST_F(SegmentationRefuses, AStartInsideOut)
{
  this->ExpectStartRefused(SphereInsideOut(),
    { "the start surface on port 1", "inside out", "vtkReverseSense" });
}

TEST_F(SegmentationRefuses, AStartThatIsNotFinite)
{
  this->ExpectStartRefused(SphereWithPointAt(NotANumber),
    { "point 7 of the start surface on port 1", "finite" });
}

TEST_F(SegmentationRefuses, AStartThatNamesAMissingPoint)
{
  const auto start = StartSphere();
  start->GetPolys()->InsertNextCell({ 0, 1, 9999 });
  this->ExpectStartRefused(start, { "the start surface on port 1", "point 9999", "repair" });
}

TEST_F(SegmentationRefuses, AndForgetsTheFormerResult)
{
  for (const bool history : { false, true })
  {
    this->Filter->SetKeepHistory(history);
    this->Filter->SetSeedCenter(ExampleCenter.data());
    this->ExpectSegmentation();
    this->Filter->SetSeedCenter(-1000, 0, 0);
    ExpectRefusal(this->Filter, { "outside the image" });
    EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), -1);
    EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::NOT_RUN);
  }
}

TEST_F(SegmentationRefuses, ButRecovers)
{
  this->ExpectStartRefused(OpenSphere(), { "port 1" });
  this->Filter->SetStartData(nullptr);
  this->ExpectImageRefused(ImageWith(NotANumber), { "port 0" });
  this->Filter->SetInputDataObject(SphereImage());
  this->ExpectSegmentation();
}

// Nothing is wrong with these, but nothing is found either: the reason says so.
TEST_F(SegmentationRefuses, ButNotAStartThatSeesNoBoundary)
{
  const auto start = StartSphere(2);
  this->Filter->SetStartData(start);
  this->Filter->SetSearchDistance(3);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND);
}
