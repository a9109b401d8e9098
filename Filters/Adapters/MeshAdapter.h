/**
 * Private to the modules, never installed: conversion between the points and polygons of VTK and
 * those of the kernels. Points in double precision can be viewed in place. Polygons are copied,
 * since their indices are of another type.
 */
#ifndef FlipFreeMeshAdapter_h
#define FlipFreeMeshAdapter_h

#include "Error.h"
#include "Mesh/ContourMesh.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <limits>
#include <string>

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

/// A copy of a surface's points, as doubles whatever their type: for those who move them.
inline PointList CopyPoints(vtkPolyData* surface)
{
  PointList points(surface->GetNumberOfPoints(), 3);
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    surface->GetPoint(vertex, points.row(vertex).data());
  }
  return points;
}

/// The points of a surface: VTK's own if they are doubles, and else those of `copy`, which must
/// outlive the view.
inline Eigen::Map<const PointList> ViewPoints(vtkPolyData* surface, PointList& copy)
{
  const vtkIdType size = surface->GetNumberOfPoints();
  auto* doubles =
    size > 0 ? vtkDoubleArray::SafeDownCast(surface->GetPoints()->GetData()) : nullptr;
  if (!doubles)
  {
    copy = CopyPoints(surface);
  }
  return { doubles ? doubles->GetPointer(0) : copy.data(), size, 3 };
}

/// Throws Error, naming the surface by `name`, where the kernels' indices, which are int, do not
/// suffice.
inline FaceList CopyPolys(vtkPolyData* surface, const std::string& name = "the surface")
{
  constexpr vtkIdType limit = std::numeric_limits<int>::max();
  vtkCellArray* polys = surface->GetPolys();
  if (surface->GetNumberOfPoints() > limit || polys->GetNumberOfConnectivityIds() > limit)
  {
    throw Error(ErrorCode::TooLarge,
      name + " has more than 2^31 - 1 points or corners of polygons; coarsen it");
  }
  FaceList faces;
  for (vtkIdType face = 0; face < polys->GetNumberOfCells(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* vertices = nullptr;
    polys->GetCellAtId(face, size, vertices);
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      if (vertices[corner] > limit || vertices[corner] < -limit)
      {
        throw Error(ErrorCode::InvalidMesh,
          "polygon " + std::to_string(face) + " of " + name + " refers to point " +
            std::to_string(vertices[corner]) + ", but there are " +
            std::to_string(surface->GetNumberOfPoints()) + " points; repair the connectivity");
      }
      faces.Connectivity.push_back(static_cast<int>(vertices[corner]));
    }
    faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
  }
  return faces;
}

} // namespace FlipFree

#endif
