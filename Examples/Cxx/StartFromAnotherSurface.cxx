/**
 * Starts from another surface than a sphere: from any closed mesh of triangles or polygons.
 *
 *   StartFromAnotherSurface --start atlas.stl ct.nii.gz --seed 83 -154 321 --radius 26
 *
 * The method needs four neighbors at every vertex. Where a mesh has others, it takes the mesh of
 * the midpoints of its edges, which has them everywhere: each edge lies on two faces, and in each
 * of them it has a neighbor on either side. Without --start, an ellipsoid serves as the other mesh.
 */
#include "Inputs.h"
#include "Scene.h"

#include <vtkCleanPolyData.h>
#include <vtkFlipFreeSegmentation.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPlatonicSolidSource.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>

#include <cstdlib>
#include <iostream>

namespace
{

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
  const auto start = inputs.Start.empty() ? Ellipsoid(inputs) : ReadSTL(inputs.Start);

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
  std::cout << "start from " << start->GetNumberOfCells() << " faces\n"
            << organ->GetNumberOfPoints() << " vertices, "
            << segmentation->GetNumberOfSelfIntersections() << " self-intersections, "
            << segmentation->GetStopReasonAsString() << "\n";

  if (!inputs.Picture.empty())
  {
    const double* bounds = organ->GetBounds();
    const Scene::Plane& plane = Scene::Coronal;
    Scene::WritePicture(inputs.Picture,
      { { Scene::SpaceView({ Scene::SurfaceActor(start) }, bounds, "the start"),
        Scene::SpaceView({ Scene::SurfaceActor(organ) }, bounds, "the organ"),
        Scene::SliceView({ Scene::SliceActor(inputs.Image, inputs.Seed, plane),
                           Scene::ContourActor(start, inputs.Seed, plane, Scene::Blue),
                           Scene::ContourActor(organ, inputs.Seed, plane) },
          bounds, plane, "start and organ") } },
      420);
  }
  return EXIT_SUCCESS;
}
