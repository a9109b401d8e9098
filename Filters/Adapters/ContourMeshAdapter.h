/**
 * Private to the modules, never installed: a vtkPolyData as the four-valent mesh that kernels
 * deform, and the arrays by which the stages talk to each other.
 */
#ifndef FlipFreeContourMeshAdapter_h
#define FlipFreeContourMeshAdapter_h

#include "ContourMesh.h"
#include "Correspondence.h"
#include "MeshAdapter.h"
#include "SelfIntersection.h"
#include "SurfaceAdapter.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace FlipFree
{

struct DeformableSurface
{
  ContourMesh Mesh;
  PointList Points;
};

/// Throws std::invalid_argument, naming the surface by `name`, when it is not a closed mesh with
/// four neighbours at every vertex, or, if asked, intersects itself.
inline DeformableSurface DeformableSurfaceOf(vtkPolyData* data, const std::string& name,
  bool requireEmbedded)
{
  PolygonalSurface surface = SurfaceOf(data, name);
  DeformableSurface result;
  try
  {
    result.Mesh = BuildContourMesh(static_cast<int>(surface.Points.rows()), surface.Faces);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(name + ": " + error.what());
  }
  result.Points = std::move(surface.Points);
  if (requireEmbedded)
  {
    const auto pairs = CountSelfIntersections(result.Points, result.Mesh.Triangles);
    if (pairs > 0)
    {
      throw std::invalid_argument(name + " intersects itself in " + std::to_string(pairs) +
        " pairs of triangles; start from an embedded surface, or switch the guard off");
    }
  }
  return result;
}

inline void AttachField(const CorrespondenceField& field, vtkPolyData* surface)
{
  const vtkIdType size = surface->GetNumberOfPoints();
  if (static_cast<vtkIdType>(field.States.size()) != size)
  {
    return; // no iteration has been made
  }
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(size);
  std::copy(field.Displacements.data(), field.Displacements.data() + field.Displacements.size(),
    displacement->GetPointer(0));
  vtkNew<vtkUnsignedCharArray> state;
  state->SetName("Correspondence");
  state->SetNumberOfValues(size);
  for (vtkIdType vertex = 0; vertex < size; ++vertex)
  {
    state->SetValue(vertex, static_cast<unsigned char>(field.States[vertex]));
  }
  surface->GetPointData()->AddArray(displacement);
  surface->GetPointData()->AddArray(state);
}

/// Throws std::invalid_argument unless the surface carries both arrays as the search makes them.
inline CorrespondenceField FieldOf(vtkPolyData* surface, const std::string& name)
{
  const vtkIdType size = surface->GetNumberOfPoints();
  vtkPointData* data = surface->GetPointData();
  auto* displacement = vtkDoubleArray::SafeDownCast(data->GetArray("Displacement"));
  auto* state = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Correspondence"));
  if (!displacement || displacement->GetNumberOfComponents() != 3 ||
    displacement->GetNumberOfTuples() != size)
  {
    throw std::invalid_argument(name +
      " lacks the point array Displacement (3 doubles per point); connect vtkCorrespondenceSearch");
  }
  if (!state || state->GetNumberOfValues() != size)
  {
    throw std::invalid_argument(name +
      " lacks the point array Correspondence (unsigned char); connect vtkCorrespondenceSearch");
  }
  CorrespondenceField field;
  field.Displacements = Eigen::Map<const PointList>(displacement->GetPointer(0), size, 3);
  if (!field.Displacements.allFinite())
  {
    throw std::invalid_argument(
      "the array Displacement of " + name + " holds values that are not finite numbers");
  }
  field.States.resize(size);
  for (vtkIdType vertex = 0; vertex < size; ++vertex)
  {
    field.States[vertex] =
      state->GetValue(vertex) == 0 ? VertexState::Solitary : VertexState::Matched;
  }
  return field;
}

inline void AttachMesh(const ContourMesh& mesh, const PointList& points, vtkPolyData* surface)
{
  surface->SetPoints(MakePoints(points));
  surface->SetPolys(MakePolys(mesh.Faces));
}

} // namespace FlipFree

#endif
