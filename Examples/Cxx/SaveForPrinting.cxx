/**
 * Saves an organ for a 3D printer (organ.stl) and for volume meshing (organ.off), in the folder
 * where it is run.
 *
 *   SaveForPrinting
 *   SaveForPrinting ct.nii.gz --seed 83 -154 321 --radius 26
 *   tetgen -pqY organ.off
 *
 * The surface needs no repair. What is left to see to is the file format: STL keeps single
 * precision only, and no neighborhoods, so the file is read back and checked as a printer's
 * program will see it.
 */
#include "Inputs.h"
#include "Scene.h"

#include <vtkFlipFreeSegmentation.h>
#include <vtkIdList.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkSurfaceValidity.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>

namespace
{

/// Each face cut from its first vertex: the triangulation whose embedding is certified.
vtkSmartPointer<vtkPolyData> TrianglesOf(vtkPolyData* surface)
{
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> face;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, face);
    for (vtkIdType i = 1; i + 1 < face->GetNumberOfIds(); ++i)
    {
      triangles->InsertNextCell({ face->GetId(0), face->GetId(i), face->GetId(i + 1) });
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(surface->GetPoints());
  mesh->SetPolys(triangles);
  return mesh;
}

/// Binary STL, in millimeters, which is what printing programs take the numbers for.
void WriteSTL(vtkPolyData* triangles, const char* name)
{
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(triangles);
  writer->SetFileName(name);
  writer->SetFileTypeToBinary();
  writer->Write();
}

/// What a printer's program would have to repair.
int DefectsOf(const char* stl)
{
  vtkNew<vtkSTLReader> reader; // joins the vertices again
  reader->SetFileName(stl);
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputConnection(reader->GetOutputPort());
  validity->Update();
  int defects = 0;
  for (const char* kind : { "SelfIntersections", "BoundaryEdges", "NonManifoldEdges" })
  {
    const int count = validity->GetMeasures()->GetValueByName(0, kind).ToInt();
    std::cout << kind << " " << count << "\n";
    defects += count;
  }
  return defects;
}

/// All digits of the vertices, and the very triangles that are certified.
void WriteOFF(vtkPolyData* triangles, const char* name)
{
  std::ofstream file(name);
  file.precision(std::numeric_limits<double>::max_digits10);
  file << "OFF\n"
       << triangles->GetNumberOfPoints() << " " << triangles->GetNumberOfCells() << " 0\n";
  for (vtkIdType vertex = 0; vertex < triangles->GetNumberOfPoints(); ++vertex)
  {
    double point[3];
    triangles->GetPoint(vertex, point);
    file << point[0] << " " << point[1] << " " << point[2] << "\n";
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < triangles->GetNumberOfCells(); ++cell)
  {
    triangles->GetCellPoints(cell, corners);
    file << "3 " << corners->GetId(0) << " " << corners->GetId(1) << " " << corners->GetId(2)
         << "\n";
  }
}

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  segmentation->SetInputData(inputs.Image);
  segmentation->SetSeedCenter(inputs.Seed.data());
  segmentation->SetSeedRadius(inputs.Radius);
  segmentation->Update();
  if (segmentation->GetSurface()->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }

  const auto triangles = TrianglesOf(segmentation->GetSurface());
  WriteSTL(triangles, "organ.stl");
  WriteOFF(triangles, "organ.off");
  vtkNew<vtkMassProperties> properties;
  properties->SetInputData(triangles);
  std::cout << triangles->GetNumberOfCells() << " triangles, "
            << std::lround(properties->GetVolume() / 1000)
            << " ml of material if it is printed solid\n";
  const int defects = DefectsOf("organ.stl");

  if (!inputs.Picture.empty())
  {
    Scene::WritePicture(inputs.Picture,
      { { Scene::SpaceView({ Scene::SurfaceActor(triangles) }, triangles->GetBounds()) } }, 600);
  }
  return defects == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
