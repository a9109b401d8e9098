/**
 * Starts from another surface than a sphere: from any closed mesh of triangles or polygons.
 *
 *   StartFromAnotherSurface --start atlas.stl ct.nii.gz --seed 83 -154 321 --radius 26
 *
 * The method needs four neighbors at every vertex. The mesh whose vertices are the midpoints of
 * another one's edges has them everywhere: each edge lies on two faces, and in each of them it has
 * a neighbor on either side. Without --start, an ellipsoid serves as the other mesh.
 */
#include "Inputs.h"
#include "Scene.h"

#include <vtkCleanPolyData.h>
#include <vtkFlipFreeSegmentation.h>
#include <vtkIdList.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPlatonicSolidSource.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <utility>

namespace
{

/// The mesh of the midpoints of edges: a face in each old face and one around each vertex.
class MidpointMesh
{
public:
  vtkSmartPointer<vtkPolyData> Of(vtkPolyData* surface)
  {
    this->Old = surface;
    this->Points->SetDataTypeToDouble();
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
    {
      surface->GetCellPoints(cell, corners);
      this->AddFace(corners);
    }
    for (const auto& ring : this->Following)
    {
      this->AddRing(ring.second);
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points);
    mesh->SetPolys(this->Faces);
    return mesh;
  }

private:
  using Ring = std::map<vtkIdType, vtkIdType>;

  vtkIdType MidpointOf(vtkIdType a, vtkIdType b)
  {
    const auto found = this->Midpoints.find(std::minmax(a, b));
    if (found != this->Midpoints.end())
    {
      return found->second;
    }
    double p[3];
    double q[3];
    this->Old->GetPoint(a, p);
    this->Old->GetPoint(b, q);
    const vtkIdType midpoint =
      this->Points->InsertNextPoint((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    this->Midpoints[std::minmax(a, b)] = midpoint;
    return midpoint;
  }

  void AddFace(vtkIdList* corners)
  {
    const vtkIdType size = corners->GetNumberOfIds();
    this->Faces->InsertNextCell(static_cast<int>(size));
    for (vtkIdType i = 0; i < size; ++i)
    {
      const vtkIdType before = corners->GetId((i + size - 1) % size);
      const vtkIdType corner = corners->GetId(i);
      const vtkIdType after = corners->GetId((i + 1) % size);
      const vtkIdType midpoint = this->MidpointOf(corner, after);
      this->Faces->InsertCellPoint(midpoint);
      this->Following[corner][midpoint] = this->MidpointOf(before, corner);
    }
  }

  /// All the way round a vertex, from the midpoint of one of its edges to that of the next.
  void AddRing(const Ring& ring)
  {
    this->Faces->InsertNextCell(static_cast<int>(ring.size()));
    vtkIdType midpoint = ring.begin()->first;
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      this->Faces->InsertCellPoint(midpoint);
      midpoint = ring.at(midpoint);
    }
  }

  vtkPolyData* Old = nullptr;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Faces;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> Midpoints; // by the ends of the edge
  std::map<vtkIdType, Ring> Following;                            // by vertex
};

/// Faces counter-clockwise seen from outside, whatever the program that made them thought. STL
/// repeats its vertices in every triangle; they are joined.
vtkSmartPointer<vtkPolyData> TidiedUp(vtkAlgorithm* source)
{
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clean->GetOutputPort());
  normals->SplittingOff();
  normals->ConsistencyOn();
  normals->AutoOrientNormalsOn();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> ReadSTL(const std::string& name)
{
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(name.c_str());
  return TidiedUp(reader);
}

/// A mesh like any other, from a refined icosahedron: five or six triangles meet at its vertices.
vtkSmartPointer<vtkPolyData> Ellipsoid(const Inputs& inputs)
{
  vtkNew<vtkPlatonicSolidSource> solid;
  solid->SetSolidTypeToIcosahedron();
  vtkNew<vtkLinearSubdivisionFilter> fine;
  fine->SetInputConnection(solid->GetOutputPort());
  fine->SetNumberOfSubdivisions(2);
  auto surface = TidiedUp(fine);
  const double radii[3] = { 1.6 * inputs.Radius, 1.1 * inputs.Radius, 1.25 * inputs.Radius };
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    double point[3];
    surface->GetPoint(vertex, point);
    vtkMath::Normalize(point);
    surface->GetPoints()->SetPoint(vertex, inputs.Seed[0] + radii[0] * point[0],
      inputs.Seed[1] + radii[1] * point[1], inputs.Seed[2] + radii[2] * point[2]);
  }
  return surface;
}

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  const auto other = inputs.Start.empty() ? Ellipsoid(inputs) : ReadSTL(inputs.Start);
  const auto start = MidpointMesh().Of(other);

  // The seed still tells what the organ looks like. The surface is refined to about 6,144 vertices,
  // as many as one that starts from a sphere has; SetResolution() sets their number.
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  segmentation->SetInputData(inputs.Image);
  segmentation->SetStartData(start);
  segmentation->SetSeedCenter(inputs.Seed.data());
  segmentation->SetSeedRadius(inputs.Radius);
  segmentation->Update();
  vtkPolyData* organ = segmentation->GetSurface();
  if (organ->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }
  std::cout << other->GetNumberOfCells() << " faces given; start from "
            << start->GetNumberOfPoints() << " midpoints\n"
            << organ->GetNumberOfPoints() << " vertices, "
            << segmentation->GetNumberOfSelfIntersections() << " self-intersections, "
            << segmentation->GetStopReasonAsString() << "\n";

  if (!inputs.Picture.empty())
  {
    const double* bounds = organ->GetBounds();
    const Scene::Plane& plane = Scene::Coronal;
    Scene::WritePicture(inputs.Picture,
      { { Scene::SpaceView({ Scene::SurfaceActor(other) }, bounds, "the mesh given"),
        Scene::SpaceView({ Scene::SurfaceActor(start) }, bounds, "its edge midpoints"),
        Scene::SpaceView({ Scene::SurfaceActor(organ) }, bounds, "the organ"),
        Scene::SliceView({ Scene::SliceActor(inputs.Image, inputs.Seed, plane),
                           Scene::ContourActor(start, inputs.Seed, plane, Scene::Blue),
                           Scene::ContourActor(organ, inputs.Seed, plane) },
          bounds, plane, "start and organ") } },
      420);
  }
  return EXIT_SUCCESS;
}
