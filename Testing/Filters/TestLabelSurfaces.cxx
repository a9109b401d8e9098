#include "vtkFlipFreeLabelSurfaces.h"

#include "BadInput.h"
#include "ExamplePolyData.h"
#include "FieldData.h"
#include "FilterErrors.h"
#include "ImageAdapter.h"
#include "LabelSurface/LabelSurfaces.h"
#include "ProgressWatch.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"
#include "vtkSurfaceToLabelMap.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

constexpr int Large = 70000;

// Two boxes side by side, and a ball that is cut off by the border of the image.
vtkSmartPointer<vtkImageData> ThreeLabels(int type = VTK_INT)
{
  const auto image =
    ImageAround({ 5, -40, 900 }, { 24, 22, 20 }, { 0.8, 0.8, 2 }, ObliqueRotation());
  image->AllocateScalars(type, 1);
  image->GetPointData()->GetScalars()->Fill(0);
  int extent[6];
  image->GetExtent(extent);
  for (int k = 0; k < 20; ++k)
  {
    for (int j = 0; j < 22; ++j)
    {
      for (int i = 0; i < 24; ++i)
      {
        const bool isInBoxes = i > 3 && i < 20 && j > 2 && j < 12 && k > 3 && k < 12;
        const bool isInBall = (Eigen::Vector3d(i, j, k) - Eigen::Vector3d(12, 20, 15)).norm() < 8;
        image->SetScalarComponentFromDouble(extent[0] + i, extent[2] + j, extent[4] + k, 0,
          isInBoxes    ? (i < 12 ? 1 : 2)
            : isInBall ? Large
                       : 0);
      }
    }
  }
  return image;
}

vtkPolyData* SurfaceAt(vtkFlipFreeLabelSurfaces* filter, unsigned int block)
{
  return vtkPolyData::SafeDownCast(filter->GetSurfaces()->GetBlock(block));
}

std::string NameAt(vtkFlipFreeLabelSurfaces* filter, unsigned int block)
{
  return filter->GetSurfaces()->GetMetaData(block)->Get(vtkCompositeDataSet::NAME());
}

} // namespace

TEST(LabelSurfacesFilter, GivesTheVoxelsBackWhereItIsExact)
{
  const auto image = ThreeLabels();
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(image);
  filter->ExactOn();
  filter->Update();
  ASSERT_EQ(filter->GetSurfaces()->GetNumberOfBlocks(), 3U);
  EXPECT_EQ(filter->GetNumberOfWrongVoxels(), 0);
  const int labels[3] = { 1, 2, Large };
  for (unsigned int block = 0; block < 3; ++block)
  {
    vtkNew<vtkSurfaceToLabelMap> voxels;
    voxels->SetInputData(SurfaceAt(filter, block));
    voxels->SetReferenceImageData(image);
    voxels->Update();
    vtkDataArray* const inside = voxels->GetOutput()->GetPointData()->GetScalars();
    vtkDataArray* const wanted = image->GetPointData()->GetScalars();
    vtkIdType different = 0;
    for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
    {
      different += (inside->GetTuple1(voxel) != 0) != (wanted->GetTuple1(voxel) == labels[block]);
    }
    EXPECT_EQ(different, 0) << labels[block];
  }
}

TEST(LabelSurfacesFilter, GivesWhatTheKernelDoes)
{
  const auto image = ThreeLabels(VTK_UNSIGNED_INT);
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(image);
  filter->SetDistance(0.8);
  filter->SetIterations(20);
  filter->Update();
  LabelSurfaceSettings settings;
  settings.Distance = 0.8;
  settings.Iterations = 20;
  const LabelSurfaces expected = MakeLabelSurfaces(
    MakeLabelGrid(ViewOf<unsigned int>(image), {}, "", SerialFor), GeometryOf(image), settings);

  vtkPolyData* const walls = filter->GetOutput();
  ASSERT_EQ(walls->GetNumberOfPoints(), expected.Walls.Points.rows());
  ASSERT_EQ(walls->GetNumberOfPolys(), expected.Walls.Triangles.rows());
  EXPECT_EQ(walls->GetPoints()->GetDataType(), VTK_FLOAT);
  for (vtkIdType point = 0; point < walls->GetNumberOfPoints(); ++point)
  {
    ASSERT_EQ(Eigen::RowVector3d(walls->GetPoint(point)), expected.Walls.Points.row(point));
  }
  vtkDataArray* const labels = walls->GetCellData()->GetArray("BoundaryLabels");
  ASSERT_NE(labels, nullptr);
  ASSERT_EQ(labels->GetNumberOfComponents(), 2);
  int between = 0;
  for (vtkIdType cell = 0; cell < walls->GetNumberOfPolys(); ++cell)
  {
    const auto& pair = expected.Walls.Labels[cell];
    ASSERT_EQ(labels->GetComponent(cell, 0), expected.Values[pair[0]]);
    ASSERT_EQ(labels->GetComponent(cell, 1), expected.Values[pair[1]]);
    between += expected.Values[pair[0]] == 1 && expected.Values[pair[1]] == 2 ? 1 : 0;
  }
  EXPECT_GT(between, 100);
  EXPECT_EQ(walls->GetFieldData()->GetArray("Certified")->GetTuple1(0), 1);
  EXPECT_EQ(walls->GetFieldData()->GetArray("WrongVoxels")->GetTuple1(0), expected.WrongVoxels);
  EXPECT_EQ(filter->GetGreatestDistance(), expected.GreatestDistance);

  vtkTable* const table = filter->GetTable();
  ASSERT_EQ(table->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    const LabelMeasures& measures = expected.Measures[row];
    EXPECT_EQ(table->GetValueByName(row, "Label").ToInt(), measures.Label);
    EXPECT_EQ(table->GetValueByName(row, "Milliliters").ToDouble(), measures.Volume / 1000);
    EXPECT_EQ(table->GetValueByName(row, "Voxels").ToInt(), measures.Voxels);
    EXPECT_EQ(table->GetValueByName(row, "WrongVoxels").ToInt(), measures.WrongVoxels);
    EXPECT_EQ(table->GetValueByName(row, "Area").ToDouble(), measures.Area);
    EXPECT_EQ(table->GetValueByName(row, "EulerNumber").ToInt(), 2);
    EXPECT_EQ(table->GetValueByName(row, "Triangles").ToInt(),
      SurfaceAt(filter, static_cast<unsigned int>(row))->GetNumberOfPolys());
  }
}

TEST(LabelSurfacesFilter, LeavesPartsOutAndCollapsesEdges)
{
  const auto image = ThreeLabels();
  int extent[6];
  image->GetExtent(extent);
  image->SetScalarComponentFromDouble(extent[0], extent[2], extent[4], 0, 9); // of 1.28 mm3
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(image);
  filter->ExactOn();
  filter->Update();
  const vtkIdType fine = filter->GetOutput()->GetNumberOfPolys();
  EXPECT_EQ(filter->GetCollapseDistance(), 0);
  filter->SetSmallestPart(2);
  filter->FillCavitiesOn();
  filter->SetTriangles(1);
  filter->SetTolerance(0.75);
  filter->Update();
  EXPECT_LT(5 * filter->GetOutput()->GetNumberOfPolys(), fine);
  EXPECT_EQ(filter->GetNumberOfWrongVoxels(), 1);
  EXPECT_GT(filter->GetCollapseDistance(), 0);
  EXPECT_LE(filter->GetCollapseDistance(), 0.75 * 0.8);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("CollapseDistance")->GetTuple1(0),
    filter->GetCollapseDistance());
  ASSERT_EQ(filter->GetSurfaces()->GetNumberOfBlocks(), 4U);
  EXPECT_EQ(NameAt(filter, 2), "9");
  EXPECT_EQ(SurfaceAt(filter, 2)->GetNumberOfPolys(), 0);
  EXPECT_EQ(SurfaceAt(filter, 2)->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetTable()->GetValueByName(2, "Triangles").ToInt(), 0);
}

TEST(LabelSurfacesFilter, NamesLabelsAsTheImageDoes)
{
  const auto image = ThreeLabels();
  AddFieldValues("SegmentLabels", { Large, 1 }, image);
  AddFieldText("SegmentNames", { "liver", "left kidney" }, image);
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(image);
  filter->Update();
  EXPECT_EQ(NameAt(filter, 0), "left kidney");
  EXPECT_EQ(NameAt(filter, 1), "2");
  EXPECT_EQ(NameAt(filter, 2), "liver");
  EXPECT_EQ(filter->GetTable()->GetValueByName(2, "Name").ToString(), "liver");
  EXPECT_EQ(filter->GetTable()->GetValueByName(1, "Name").ToString(), "");
}

TEST(LabelSurfacesFilter, TakesSomeLabels)
{
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(ThreeLabels(VTK_DOUBLE));
  filter->AddLabel(2);
  filter->Update();
  ASSERT_EQ(filter->GetSurfaces()->GetNumberOfBlocks(), 1U);
  EXPECT_EQ(NameAt(filter, 0), "2");
  filter->AddLabel(5);
  ExpectRefusal(filter, { "no voxel with label 5" });
  EXPECT_EQ(filter->GetNumberOfLabels(), 2);
  EXPECT_EQ(filter->GetLabel(1), 5);
  filter->RemoveAllLabels();
  filter->Update();
  EXPECT_EQ(filter->GetSurfaces()->GetNumberOfBlocks(), 3U);
}

TEST(LabelSurfacesFilter, StopsWhenAborted)
{
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(ThreeLabels());
  filter->SetIterations(500);
  {
    ProgressWatch watch(filter, 0.2);
    filter->Update();
    EXPECT_TRUE(watch.StoppedSoon());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
    EXPECT_EQ(filter->GetTable()->GetNumberOfRows(), 0);
  }
  filter->Modified();
  ProgressWatch watch(filter);
  filter->Update();
  EXPECT_EQ(watch.Last, 1);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0);
}

TEST(LabelSurfacesFilter, RefusesWhatIsNoLabelMap)
{
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  ExpectRefused(BadGrids(), filter, 0, "the label map on port 0");
  const auto bare = vtkSmartPointer<vtkImageData>::New();
  bare->SetDimensions(4, 4, 4);
  for (const auto& image : { bare, ImageWithArray<vtkDoubleArray>(100), ImageOfType(VTK_SHORT, 3) })
  {
    filter->SetInputData(image);
    ExpectRefusal(filter, { "the label map on port 0 has no scalars of one component" });
  }
  filter->SetInputData(ImageWithArray<vtkBitArray>(32 * 32 * 32));
  ExpectRefusal(filter, { "are of type bit" });
  for (const auto& [value, words] : { std::make_pair(NotANumber, "the value nan"),
         std::make_pair(0.5, "the value 0.5"), std::make_pair(-1.0, "the value -1") })
  {
    const auto image = ThreeLabels(VTK_FLOAT);
    image->GetPointData()->GetScalars()->SetTuple1(24 + 3, value);
    filter->SetInputData(image);
    ExpectRefusal(filter, { words, "at voxel (3, 1, 0)", "a label map holds whole numbers" });
  }
  filter->SetInputData(ThreeLabels());
  filter->SetDistance(NotANumber);
  ExpectRefusal(filter, { "Distance is nan", "0.5 to 1" });
  filter->SetDistance(0.9);
  filter->SetDistance(2);
  filter->SetIterations(-1);
  EXPECT_EQ(filter->GetDistance(), 1);
  EXPECT_EQ(filter->GetIterations(), 0);
}
