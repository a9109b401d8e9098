/**
 * Private to the modules, never installed: a vtkPolyData as the four-valent mesh that kernels
 * deform, and the arrays by which the stages talk to each other.
 */
#ifndef FlipFreeContourMeshAdapter_h
#define FlipFreeContourMeshAdapter_h

#include "Deformation/Correspondence.h"
#include "Deformation/StartSurface.h"
#include "Error.h"
#include "Evidence/SurfaceConfidence.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "FilterAdvice.h"
#include "Mesh/ContourMesh.h"
#include "MeshAdapter.h"
#include "SurfaceAdapter.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <memory>
#include <string>

namespace FlipFree
{

/// The analysis of a surface's connectivity, kept from update to update while the polygons stay the
/// same.
class ContourMeshCache
{
public:
  using Mesh = std::shared_ptr<const ContourMesh>;

  /// The same pointer as before for the same connectivity. Throws Error, naming the surface by
  /// `name`, when it is not a closed mesh with four neighbors at every vertex. `points` are those
  /// of the surface.
  Mesh MeshOf(vtkPolyData* data, const Eigen::Ref<const PointList>& points, const std::string& name)
  {
    RequirePolygons(data, name);
    const FaceList faces = CopyPolys(data, name);
    RequireValidFaces(points, faces, name);
    const int size = static_cast<int>(points.rows());
    if (this->Last && this->Last->NumberOfPoints() == size &&
      this->Last->Faces.Offsets == faces.Offsets &&
      this->Last->Faces.Connectivity == faces.Connectivity)
    {
      return this->Last;
    }
    this->Last = NamingSurface(name,
      [&] { return std::make_shared<const ContourMesh>(BuildContourMesh(size, faces)); });
    return this->Last;
  }

private:
  Mesh Last;
};

/// RequireEmbedded() by VTK's threads.
inline void RequireEmbedded(const ContourMesh& mesh, const FaceHulls& hulls,
  const PointList& points, const std::string& name)
{
  WithAdvice([&] { RequireEmbedded(mesh, hulls, points, name, SMPFor); });
}

/// Copies a surface, named by `name`. Throws Error as RequirePolygons().
inline GivenSurface GivenSurfaceOf(vtkPolyData* data, const std::string& name)
{
  RequirePolygons(data, name);
  return { name, CopyPoints(data), CopyPolys(data, name) };
}

/// Copies a surface. Throws Error, naming it by `name`, when it is not a closed mesh with four
/// neighbors at every vertex, or, if asked, is not embedded.
inline DeformableSurface DeformableSurfaceOf(vtkPolyData* data, const std::string& name,
  bool requireEmbedded)
{
  return WithAdvice(
    [&] { return MakeStartSurface(GivenSurfaceOf(data, name), requireEmbedded, SMPFor); });
}

/// Where the field is of another size, no iteration has been made of this mesh: nothing is wanted.
inline void AttachField(const CorrespondenceField& field, vtkPolyData* surface)
{
  const vtkIdType size = surface->GetNumberOfPoints();
  const bool isMade = static_cast<vtkIdType>(field.States.size()) == size;
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(size);
  Eigen::Map<PointList>(displacement->GetPointer(0), size, 3) =
    isMade ? field.Displacements : PointList::Zero(size, 3);
  vtkNew<vtkUnsignedCharArray> state;
  state->SetName("Correspondence");
  state->SetNumberOfValues(size);
  for (vtkIdType vertex = 0; vertex < size; ++vertex)
  {
    state->SetValue(vertex,
      static_cast<unsigned char>(isMade ? field.States[vertex] : VertexState::Solitary));
  }
  surface->GetPointData()->AddArray(displacement);
  surface->GetPointData()->AddArray(state);
}

/// What an array is where it is not what it should be.
inline std::string DescribeArray(vtkAbstractArray* array)
{
  return array ? " (it has " + std::to_string(array->GetNumberOfTuples()) + " tuples of " +
      std::to_string(array->GetNumberOfComponents()) + " x " + array->GetDataTypeAsString() + ")"
               : "";
}

/// Throws Error unless the surface carries both arrays as the search makes them.
inline CorrespondenceField FieldOf(vtkPolyData* surface, const std::string& name)
{
  const vtkIdType size = surface->GetNumberOfPoints();
  vtkPointData* data = surface->GetPointData();
  auto* displacement = vtkDoubleArray::SafeDownCast(data->GetArray("Displacement"));
  auto* state = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Correspondence"));
  if (!displacement || displacement->GetNumberOfComponents() != 3 ||
    displacement->GetNumberOfTuples() != size)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " lacks the point array Displacement of 3 doubles per point" +
        DescribeArray(data->GetAbstractArray("Displacement")) +
        "; connect vtkCorrespondenceSearch");
  }
  if (!state || state->GetNumberOfComponents() != 1 || state->GetNumberOfTuples() != size)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " lacks the point array Correspondence of 1 unsigned char per point" +
        DescribeArray(data->GetAbstractArray("Correspondence")) +
        "; connect vtkCorrespondenceSearch");
  }
  CorrespondenceField field;
  field.Displacements = Eigen::Map<const PointList>(displacement->GetPointer(0), size, 3);
  if (!field.Displacements.allFinite())
  {
    vtkIdType vertex = 0;
    while (field.Displacements.row(vertex).allFinite())
    {
      ++vertex;
    }
    throw Error(ErrorCode::NonFiniteValue,
      "the array Displacement of " + name + " is not finite at point " + std::to_string(vertex) +
        "; set it to zero there, and Correspondence to 0");
  }
  field.States.resize(size);
  for (vtkIdType vertex = 0; vertex < size; ++vertex)
  {
    const unsigned char value = state->GetValue(vertex);
    if (value > static_cast<unsigned char>(VertexState::Flipping))
    {
      throw Error(ErrorCode::InvalidInput,
        "the array Correspondence of " + name + " has the value " + std::to_string(value) +
          " at point " + std::to_string(vertex) +
          "; use 0 for solitary, 1 for matched, 2 for flipping");
    }
    field.States[vertex] = value == 0 ? VertexState::Solitary : VertexState::Matched;
    if (value == 0)
    {
      field.Displacements.row(vertex).setZero(); // of an earlier propagation
    }
  }
  return field;
}

inline void AttachMesh(const ContourMesh& mesh, const PointList& points, vtkPolyData* surface)
{
  surface->SetPoints(MakePoints(points));
  surface->SetPolys(MakePolys(mesh.Faces));
}

/// Point array and field data `Confidence`.
inline void AttachConfidence(const SurfaceConfidence& confidence, vtkPolyData* surface)
{
  vtkNew<vtkFloatArray> ofVertices;
  ofVertices->SetName("Confidence");
  ofVertices->SetNumberOfValues(static_cast<vtkIdType>(confidence.OfVertices.size()));
  std::copy(confidence.OfVertices.begin(), confidence.OfVertices.end(), ofVertices->GetPointer(0));
  surface->GetPointData()->AddArray(ofVertices);
  AddFieldValues("Confidence", { confidence.OfSurface }, surface);
}

/// Field data `Certified`: 1 if the surface is proven to be embedded, however its faces are cut.
inline void AttachCertificate(bool certified, vtkPolyData* surface)
{
  AddFieldValues("Certified", { certified ? 1.0 : 0.0 }, surface);
}

/// Field data `Provenance`: a text (Deformation/Provenance.h).
inline void AttachProvenance(const std::string& provenance, vtkPolyData* surface)
{
  AddFieldText("Provenance", { provenance }, surface);
}

} // namespace FlipFree

#endif
