/**
 * Watches each iteration of the method, put together from its stages in Growth.cxx.
 *
 *   StagesByHand --picture iterations.png
 */
#include "Growth.h"
#include "Inputs.h"
#include "Scene.h"

#include <vtkSurfaceValidity.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>

namespace
{

bool IsValid(vtkPolyData* surface)
{
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  validity->Update();
  return validity->GetMeasures()->GetValueByName(0, "Valid").ToInt() == 1;
}

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  Growth growth(inputs.Image, inputs.Seed, inputs.Radius);
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces{ growth.GetSurface() };
  std::cout << "iteration  level  vertices  mean distance, mm  flipping  guarded\n"
            << std::fixed << std::setprecision(2);
  while (!growth.HasConverged())
  {
    if (!growth.Step())
    {
      return EXIT_FAILURE;
    }
    std::cout << std::setw(9) << surfaces.size() << std::setw(7) << growth.GetLevel()
              << std::setw(10) << growth.GetSurface()->GetNumberOfPoints() << std::setw(19)
              << growth.MeanDistance << std::setw(10) << growth.FlippingVertices << std::setw(9)
              << growth.GuardedVertices << "\n";
    surfaces.emplace_back(growth.GetSurface());
  }

  // Every iterate is a valid surface, not the last one alone.
  for (const auto& surface : surfaces)
  {
    if (!IsValid(surface))
    {
      std::cerr << "a surface is not valid\n";
      return EXIT_FAILURE;
    }
  }
  std::cout << "all " << surfaces.size() << " surfaces are closed and without self-intersections\n";

  if (!inputs.Picture.empty())
  {
    const double* bounds = growth.GetSurface()->GetBounds();
    std::vector<vtkSmartPointer<vtkRenderer>> slices;
    std::vector<vtkSmartPointer<vtkRenderer>> bodies;
    for (const std::size_t shown : { std::size_t{ 0 }, std::size_t{ 2 }, std::size_t{ 5 },
           std::size_t{ 20 }, surfaces.size() - 1 })
    {
      if (shown < surfaces.size())
      {
        const Scene::Plane& plane = Scene::Coronal;
        slices.push_back(
          Scene::SliceView({ Scene::SliceActor(inputs.Image, inputs.Seed, plane),
                             Scene::ContourActor(surfaces[shown], inputs.Seed, plane) },
            bounds, plane, shown == 0 ? "the seed" : "after " + std::to_string(shown)));
        bodies.push_back(Scene::SpaceView({ Scene::SurfaceActor(surfaces[shown]) }, bounds));
      }
    }
    Scene::WritePicture(inputs.Picture, { slices, bodies }, 360);
  }
  return EXIT_SUCCESS;
}
