/**
 * Good input for the stages of a segmentation, and ways to spoil it.
 */
#ifndef FlipFreeBadInput_h
#define FlipFreeBadInput_h

#include "ExamplePolyData.h"

#include "vtkCellArray.h"
#include "vtkPhantomSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>

namespace FlipFree
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinite = std::numeric_limits<double>::infinity();

/// Of the sphere in SphereImage, and of a seed in it.
const Eigen::Vector3d ExampleCenter(46.5, 46.5, 46.5);
constexpr double ExampleRadius = 18;

/// A bright sphere of radius 30 mm in 32 x 32 x 32 voxels of 3 mm.
inline vtkSmartPointer<vtkImageData> SphereImage()
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetDimensions(32, 32, 32);
  phantom->SetSpacing(3, 3, 3);
  phantom->Update();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->DeepCopy(phantom->GetOutput());
  return image;
}

inline vtkSmartPointer<vtkImageData> ImageOfType(int type, int components = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(32, 32, 32);
  image->SetSpacing(3, 3, 3);
  image->AllocateScalars(type, components);
  image->GetPointData()->GetScalars()->Fill(1);
  return image;
}

/// A voxel of the seed gets a value that only floating point numbers have.
inline vtkSmartPointer<vtkImageData> ImageWith(double value)
{
  const auto sphere = SphereImage();
  auto image = ImageOfType(VTK_DOUBLE);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    image->GetPointData()->GetScalars()->SetTuple1(voxel,
      sphere->GetPointData()->GetScalars()->GetTuple1(voxel));
  }
  image->SetScalarComponentFromDouble(15, 16, 17, 0, value);
  return image;
}

inline vtkSmartPointer<vtkPolyData> StartSphere(double radius = ExampleRadius)
{
  const QuadSphere sphere =
    MakeQuadSphere(4, ExampleCenter, radius, QuadSphereSpacing::Equiangular);
  return PolyDataOf(sphere.Points, sphere.Faces);
}

/// Without its last face.
inline vtkSmartPointer<vtkPolyData> OpenSphere()
{
  auto sphere = StartSphere();
  vtkNew<vtkCellArray> faces;
  for (vtkIdType face = 0; face + 1 < sphere->GetNumberOfPolys(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    sphere->GetPolys()->GetCellAtId(face, size, points);
    faces->InsertNextCell(size, points);
  }
  sphere->SetPolys(faces);
  return sphere;
}

/// Its faces turned inward.
inline vtkSmartPointer<vtkPolyData> SphereInsideOut()
{
  auto sphere = StartSphere();
  sphere->GetPolys()->Modified();
  for (vtkIdType face = 0; face < sphere->GetNumberOfPolys(); ++face)
  {
    sphere->GetPolys()->ReverseCellAtId(face);
  }
  return sphere;
}

/// One vertex on the other side.
inline vtkSmartPointer<vtkPolyData> SelfIntersectingSphere()
{
  auto sphere = StartSphere();
  const Eigen::Vector3d opposite = 2 * ExampleCenter -
    1.5 * (Eigen::Map<const Eigen::Vector3d>(sphere->GetPoint(5)) - ExampleCenter) - ExampleCenter;
  sphere->GetPoints()->SetPoint(5, opposite.data());
  return sphere;
}

inline vtkSmartPointer<vtkPolyData> SphereWithPointAt(double x)
{
  auto sphere = StartSphere();
  sphere->GetPoints()->SetPoint(7, x, 0, 0);
  return sphere;
}

/// Closed, but three or six triangles meet at its vertices.
inline vtkSmartPointer<vtkPolyData> TriangulatedBox()
{
  return PolyDataOf(Box({ 36, 36, 36 }, { 56, 56, 56 }));
}

} // namespace FlipFree

#endif
