/**
 * Private to the modules, never installed: between the points and polygons of VTK and those of the
 * kernels. Both ways copy: VTK's points may be of either precision and its faces lie in another
 * layout, and a mesh is small beside an image.
 */
#ifndef FlipFreeMeshAdapter_h
#define FlipFreeMeshAdapter_h

#include "Mesh/ContourMesh.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace FlipFree
{

inline vtkSmartPointer<vtkPoints> MakePoints(const PointList& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(points.rows());
  auto* values = vtkDoubleArray::SafeDownCast(result->GetData());
  std::copy(points.data(), points.data() + points.size(), values->GetPointer(0));
  return result;
}

inline vtkSmartPointer<vtkCellArray> MakePolys(const FaceList& faces)
{
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->AllocateExact(faces.NumberOfFaces(), static_cast<vtkIdType>(faces.Connectivity.size()));
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    result->InsertNextCell(faces.FaceSize(face));
    for (int corner = 0; corner < faces.FaceSize(face); ++corner)
    {
      result->InsertCellPoint(faces.Face(face)[corner]);
    }
  }
  return result;
}

/// The points of a surface, as doubles whatever their type.
inline PointList CopyPoints(vtkPolyData* surface)
{
  PointList points(surface->GetNumberOfPoints(), 3);
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    surface->GetPoint(vertex, points.row(vertex).data());
  }
  return points;
}

inline FaceList CopyPolys(vtkPolyData* surface)
{
  FaceList faces;
  vtkCellArray* polys = surface->GetPolys();
  for (vtkIdType face = 0; face < polys->GetNumberOfCells(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* vertices = nullptr;
    polys->GetCellAtId(face, size, vertices);
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      faces.Connectivity.push_back(static_cast<int>(vertices[corner]));
    }
    faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
  }
  return faces;
}

} // namespace FlipFree

#endif
