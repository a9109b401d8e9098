// The same voxels in another frame give the same surface: permuted, reversed, or rotated.
#include "PhantomCases.h"
#include "vtkPhantomSource.h"
#include "vtkQuadSphereSource.h"
#include "vtkSeedRegionDiffusion.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

struct Frame
{
  const char* Name;
  int Axes[3];      // the old axis along which a new one runs
  bool Reversed[3]; // from its other end
  double Angle;     // degrees by which all of it is turned about an oblique axis
};

/// The image's voxels stored in another order; where each lies in space remains.
vtkSmartPointer<vtkImageData> Rearranged(vtkImageData* image, const Frame& frame)
{
  int oldSize[3];
  image->GetDimensions(oldSize);
  auto result = vtkSmartPointer<vtkImageData>::New();
  int size[3];
  double spacing[3];
  vtkNew<vtkMatrix3x3> direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int old = frame.Axes[axis];
    size[axis] = oldSize[old];
    spacing[axis] = image->GetSpacing()[old];
    for (int row = 0; row < 3; ++row)
    {
      const double element = image->GetDirectionMatrix()->GetElement(row, old);
      direction->SetElement(row, axis, frame.Reversed[axis] ? -element : element);
    }
  }
  result->SetDimensions(size);
  result->SetSpacing(spacing);
  result->SetDirectionMatrix(direction);
  result->AllocateScalars(VTK_SHORT, 1);
  const auto oldIndex = [&](const int index[3], int old[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      old[frame.Axes[axis]] = frame.Reversed[axis] ? size[axis] - 1 - index[axis] : index[axis];
    }
  };
  int index[3] = { 0, 0, 0 };
  int old[3];
  oldIndex(index, old);
  double origin[3];
  image->TransformIndexToPhysicalPoint(old, origin);
  result->SetOrigin(origin);
  for (index[2] = 0; index[2] < size[2]; ++index[2])
  {
    for (index[1] = 0; index[1] < size[1]; ++index[1])
    {
      for (index[0] = 0; index[0] < size[0]; ++index[0])
      {
        oldIndex(index, old);
        *static_cast<short*>(result->GetScalarPointer(index)) =
          *static_cast<short*>(image->GetScalarPointer(old));
      }
    }
  }
  return result;
}

/// Turns the image in space, voxels and all.
void Move(vtkImageData* image, vtkTransform* motion)
{
  image->SetOrigin(motion->TransformPoint(image->GetOrigin()));
  vtkNew<vtkMatrix3x3> direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    double column[3];
    for (int row = 0; row < 3; ++row)
    {
      column[row] = image->GetDirectionMatrix()->GetElement(row, axis);
    }
    motion->TransformVector(column, column);
    for (int row = 0; row < 3; ++row)
    {
      direction->SetElement(row, axis, column[row]);
    }
  }
  image->SetDirectionMatrix(direction);
}

vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* surface, vtkTransform* motion)
{
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(surface);
  move->SetTransform(motion);
  move->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  move->Update();
  return move->GetOutput();
}

/// The spleen's surface from a given sphere.
vtkSmartPointer<vtkPolyData> Segment(vtkImageData* image, vtkPolyData* sphere,
  const double center[3], double radius)
{
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputDataObject(image);
  filter->SetStartData(sphere);
  filter->SetSeedCenter(center[0], center[1], center[2]);
  filter->SetSeedRadius(radius);
  filter->SetResolution(16);
  filter->SetLevels(2);
  filter->Update();
  return filter->GetSurface();
}

constexpr Frame Frames[] = {
  { "permuted", { 2, 0, 1 }, { false, false, false }, 0 },
  { "swapped", { 1, 0, 2 }, { false, false, false }, 0 },
  { "reversed along x", { 0, 1, 2 }, { true, false, false }, 0 },
  { "reversed along z", { 0, 1, 2 }, { false, false, true }, 0 },
  { "LPS to RAS", { 0, 1, 2 }, { true, true, false }, 0 },
  { "oblique", { 0, 1, 2 }, { false, false, false }, 25 },
  { "oblique and left-handed", { 1, 2, 0 }, { false, true, false }, -70 },
};

} // namespace

TEST(SegmentationFrames, SameSurfaceUpToTheMotion)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShapeToAbdomen();
  phantom->SetDimensions(110, 85, 45);
  phantom->SetSpacing(3, 3, 6);
  phantom->SetOrigin(-150, -120, 40);
  phantom->Update();
  double seed[4];
  ASSERT_TRUE(phantom->GetSeed(vtkPhantomSource::SPLEEN, seed));
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->SetCenter(seed);
  sphere->SetRadius(seed[3]);
  sphere->SetResolution(8);
  sphere->Update();
  const auto expected = Segment(phantom->GetOutput(), sphere->GetOutput(), seed, seed[3]);
  ASSERT_EQ(expected->GetNumberOfPoints(), 6 * 16 * 16);

  for (const Frame& frame : Frames)
  {
    SCOPED_TRACE(frame.Name);
    vtkNew<vtkTransform> motion;
    motion->RotateWXYZ(frame.Angle, 1, -2, 3);
    const auto image = Rearranged(phantom->GetOutput(), frame);
    Move(image, motion);
    const auto start = Moved(sphere->GetOutput(), motion);
    const auto surface = Segment(image, start, motion->TransformPoint(seed), seed[3]);
    ASSERT_EQ(surface->GetNumberOfPoints(), expected->GetNumberOfPoints());
    double farthest = 0;
    for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
    {
      double a[3];
      double b[3];
      surface->GetPoint(vertex, a);
      motion->TransformPoint(expected->GetPoint(vertex), b);
      farthest = std::max(farthest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    // In millimeters. The storage order changes positions by rounding alone, and the equations are
    // solved in single precision; in a rotated frame, to a relative residual of 1e-5 along other
    // axes.
    EXPECT_LE(farthest, frame.Angle == 0 ? 2e-4 : 1e-3);
  }
}

// VTK keeps the very matrix that it is handed, and changes it in place.
TEST(SegmentationFrames, ASmoothedImageTurnsWithoutItsInput)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetDimensions(32, 32, 32);
  phantom->SetSpacing(3, 3, 3);
  vtkNew<vtkSeedRegionDiffusion> smooth;
  smooth->SetInputConnection(phantom->GetOutputPort());
  smooth->SetSeedCenter(46.5, 46.5, 46.5);
  smooth->SetSeedRadius(18);
  smooth->Update();
  smooth->GetOutput()->SetDirectionMatrix(-1, 0, 0, 0, -1, 0, 0, 0, 1);
  EXPECT_EQ(phantom->GetOutput()->GetDirectionMatrix()->GetElement(0, 0), 1);
}
