#include "vtkSurfaceToLabelMap.h"

#include "ExamplePolyData.h"
#include "FilterErrors.h"

#include "vtkExtractVOI.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

vtkUnsignedCharArray* Labels(vtkImageData* image)
{
  return vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
}

} // namespace

TEST(SurfaceToLabelMap, LabelsTheVoxelsThatVtkPlacesInsideTheSurface)
{
  const Eigen::Vector3d center(-30, 20, 150);
  const Surface potato = Potato(3, center, 12);
  for (const auto& [name, direction] : ExampleDirections())
  {
    const auto reference = ImageAround(center + Eigen::Vector3d(0.3, 0.2, 0.1), { 21, 24, 12 },
      { 1.3, 1.2, 2.4 }, direction);
    vtkNew<vtkSurfaceToLabelMap> filter;
    filter->SetInputData(PolyDataOf(potato));
    filter->SetReferenceImageData(reference);
    filter->SetLabelValue(7);
    filter->Update();
    vtkImageData* output = filter->GetOutput();
    const ImageGeometry expected = GeometryOf(reference);
    const ImageGeometry geometry = GeometryOf(output);
    EXPECT_EQ(geometry.Dimensions, expected.Dimensions);
    EXPECT_EQ(geometry.Origin, expected.Origin);
    EXPECT_EQ(geometry.Spacing, expected.Spacing);
    EXPECT_EQ(geometry.Direction, expected.Direction);
    EXPECT_EQ(output->GetExtent()[0], -3);
    ASSERT_NE(Labels(output), nullptr);
    EXPECT_STREQ(Labels(output)->GetName(), "Labels");
    int inside = 0;
    for (vtkIdType voxel = 0; voxel < output->GetNumberOfPoints(); ++voxel)
    {
      Eigen::Vector3d point;
      output->GetPoint(voxel, point.data());
      const bool isInside = WindingNumber(potato, point) > 0.5;
      ASSERT_EQ(Labels(output)->GetValue(voxel), isInside ? 7 : 0) << name << " voxel " << voxel;
      inside += isInside;
    }
    EXPECT_GT(inside, 500) << name;
  }
}

TEST(SurfaceToLabelMap, QuadsAndASinglePrecisionSurfaceWillDo)
{
  const QuadSphere sphere =
    MakeQuadSphere(8, Eigen::Vector3d::Zero(), 10, QuadSphereSpacing::Equiangular);
  const auto surface = PolyDataOf(sphere.Points, sphere.Faces);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->DeepCopy(surface->GetPoints());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->DeepCopy(surface->GetPoints()->GetData());
  points->SetData(coordinates);
  surface->SetPoints(points);
  vtkNew<vtkSurfaceToLabelMap> filter;
  filter->SetInputData(surface);
  filter->SetReferenceImageData(
    ImageAround({ 0.1, 0.2, 0.3 }, { 40, 40, 40 }, { 0.6, 0.6, 0.6 }, ObliqueRotation()));
  filter->Update();
  ASSERT_NE(Labels(filter->GetOutput()), nullptr);
  int inside = 0;
  for (vtkIdType voxel = 0; voxel < filter->GetOutput()->GetNumberOfPoints(); ++voxel)
  {
    inside += Labels(filter->GetOutput())->GetValue(voxel) == 1;
  }
  const double volume = inside * 0.6 * 0.6 * 0.6;
  EXPECT_NEAR(volume, EnclosedVolume(Sphere(8, Eigen::Vector3d::Zero(), 10)), 10);
}

TEST(SurfaceToLabelMap, APartAskedForDownstreamIsThatPartOfTheWhole)
{
  const auto reference =
    ImageAround({ 0, 0, 0 }, { 30, 30, 30 }, { 0.8, 0.8, 0.8 }, ObliqueRotation());
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(reference);
  vtkNew<vtkSurfaceToLabelMap> filter;
  filter->SetInputData(PolyDataOf(Sphere(6, { 0, 0, 0 }, 9)));
  filter->SetReferenceImageConnection(producer->GetOutputPort());
  vtkNew<vtkExtractVOI> part;
  part->SetInputConnection(filter->GetOutputPort());
  part->SetVOI(5, 15, 10, 20, 12, 18);
  part->Update();
  filter->Update();
  EXPECT_EQ(part->GetOutput()->GetNumberOfPoints(), 11 * 11 * 7);
  int inside = 0;
  for (int k = 12; k <= 18; ++k)
  {
    for (int j = 10; j <= 20; ++j)
    {
      for (int i = 5; i <= 15; ++i)
      {
        const double label = filter->GetOutput()->GetScalarComponentAsDouble(i, j, k, 0);
        ASSERT_EQ(part->GetOutput()->GetScalarComponentAsDouble(i, j, k, 0), label);
        inside += label > 0;
      }
    }
  }
  EXPECT_GT(inside, 0);
}

TEST(SurfaceToLabelMap, FollowsAMovedSurface)
{
  const auto surface = PolyDataOf(Box({ 0, 0, 0 }, { 4, 4, 4 }));
  vtkNew<vtkImageData> reference;
  reference->SetDimensions(8, 8, 8);
  vtkNew<vtkSurfaceToLabelMap> filter;
  filter->SetInputData(surface);
  filter->SetReferenceImageData(reference);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0), 1);
  surface->SetPoints(MakePoints(Box({ 2, 2, 2 }, { 4, 4, 4 }).Points));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0), 0);
  EXPECT_EQ(filter->GetOutput()->GetScalarComponentAsDouble(2, 2, 2, 0), 1);
}

TEST(SurfaceToLabelMap, MovesOnToImagesOfAnotherSize)
{
  vtkNew<vtkSurfaceToLabelMap> filter;
  filter->SetInputData(PolyDataOf(Box({ 0, 0, 0 }, { 4, 4, 4 })));
  for (const int size : { 5, 9, 3 })
  {
    vtkNew<vtkImageData> reference;
    reference->SetDimensions(size, size, size);
    filter->SetReferenceImageData(reference);
    EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), size * size * size);
  }
}
