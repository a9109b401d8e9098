/**
 * Compares two settings on one organ: the defaults with half as many vertices along each side.
 *
 *   CompareSettings
 *   CompareSettings ct.nii.gz --seed 83 -154 321 --radius 26 --picture compared.png
 *
 * Without a truth to compare with, the two are compared with each other: where do they agree, and
 * to within which distance? Change `Settings` to compare others.
 */
#include "Inputs.h"
#include "Scene.h"

#include <vtkFlipFreeSegmentation.h>
#include <vtkNew.h>
#include <vtkSegmentationMetrics.h>
#include <vtkTable.h>

#include <cstdlib>
#include <functional>
#include <iomanip>
#include <iostream>
#include <numeric>

namespace
{

struct Setting
{
  std::string Name;
  std::function<void(vtkFlipFreeSegmentation*)> Apply;
};

const Setting Settings[2] = {
  { "default", [](vtkFlipFreeSegmentation*) {} },
  { "coarse", [](vtkFlipFreeSegmentation* segmentation) { segmentation->SetResolution(16); } },
};

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  vtkNew<vtkFlipFreeSegmentation> organs[2];
  std::cout << "          vertices  iterations  self-intersections  seconds\n"
            << std::fixed << std::setprecision(2);
  for (int i = 0; i < 2; ++i)
  {
    vtkFlipFreeSegmentation* organ = organs[i];
    organ->SetInputData(inputs.Image);
    organ->SetSeedCenter(inputs.Seed.data());
    organ->SetSeedRadius(inputs.Radius);
    Settings[i].Apply(organ);
    organ->Update();
    if (organ->GetSurface()->GetNumberOfPoints() == 0)
    {
      return EXIT_FAILURE; // the filter has told why
    }
    const double* stages = organ->GetStageSeconds();
    std::cout << std::left << std::setw(8) << Settings[i].Name << std::right << std::setw(10)
              << organ->GetSurface()->GetNumberOfPoints() << std::setw(12)
              << organ->GetConvergence()->GetNumberOfRows() << std::setw(20)
              << organ->GetNumberOfSelfIntersections() << std::setw(9)
              << std::accumulate(stages, stages + 4, 0.0) << "\n";
  }

  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputDataObject(organs[1]->GetSurface());
  metrics->SetReferenceData(organs[0]->GetLabelMap());
  metrics->Update();
  std::cout << "between them: Dice " << metrics->GetDice() << ", mean distance "
            << metrics->GetASD() << " mm, greatest " << metrics->GetHD() << " mm\n";

  if (!inputs.Picture.empty())
  {
    std::vector<vtkSmartPointer<vtkRenderer>> slices;
    const double* bounds = organs[0]->GetSurface()->GetBounds();
    for (const Scene::Plane& plane : { Scene::Axial, Scene::Coronal })
    {
      // The first one is the wider, so that it is to be seen where they agree.
      slices.push_back(Scene::SliceView(
        { Scene::SliceActor(inputs.Image, inputs.Seed, plane),
          Scene::ContourActor(organs[0]->GetSurface(), inputs.Seed, plane, Scene::Yellow, 8),
          Scene::ContourActor(organs[1]->GetSurface(), inputs.Seed, plane, Scene::Blue, 3) },
        bounds, plane, Settings[0].Name + " (yellow), " + Settings[1].Name + " (blue)"));
    }
    std::vector<vtkSmartPointer<vtkRenderer>> surfaces;
    surfaces.reserve(2);
    for (int i = 0; i < 2; ++i)
    {
      surfaces.push_back(Scene::SpaceView({ Scene::SurfaceActor(organs[i]->GetSurface()) }, bounds,
        Settings[i].Name));
    }
    Scene::WritePicture(inputs.Picture, { slices, surfaces }, 520);
  }
  return EXIT_SUCCESS;
}
