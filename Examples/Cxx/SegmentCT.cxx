/**
 * Segments one organ of a CT from one seed.
 *
 *   SegmentCT                                       the liver of the built-in phantom
 *   SegmentCT ct.nii.gz --seed 83 -154 321 --radius 26 --picture liver.png
 */
#include "Inputs.h"
#include "Scene.h"

#include <vtkCallbackCommand.h>
#include <vtkFlipFreeSegmentation.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <cstdlib>
#include <iostream>

namespace
{

/// A dot for every tenth of the way.
void ShowProgress(vtkObject* caller, unsigned long, void* dots, void*)
{
  const int tenths = static_cast<int>(10 * static_cast<vtkAlgorithm*>(caller)->GetProgress());
  int& shown = *static_cast<int*>(dots);
  for (; shown < tenths; ++shown)
  {
    std::cout << "." << std::flush;
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

  int dots = 0;
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(ShowProgress);
  progress->SetClientData(&dots);
  segmentation->AddObserver(vtkCommand::ProgressEvent, progress);
  segmentation->Update();

  vtkPolyData* surface = segmentation->GetSurface();
  if (surface->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }
  std::cout << "\n"
            << surface->GetNumberOfPoints() << " vertices, "
            << segmentation->GetNumberOfSelfIntersections() << " self-intersections, "
            << segmentation->GetStopReasonAsString() << " after "
            << segmentation->GetConvergence()->GetNumberOfRows() << " iterations\n";

  if (!inputs.Picture.empty())
  {
    std::vector<vtkSmartPointer<vtkRenderer>> views;
    for (const Scene::Plane& plane : { Scene::Axial, Scene::Coronal })
    {
      views.push_back(Scene::SliceView({ Scene::SliceActor(inputs.Image, inputs.Seed, plane),
                                         Scene::ContourActor(surface, inputs.Seed, plane) },
        surface->GetBounds(), plane));
    }
    views.push_back(Scene::SpaceView({ Scene::SurfaceActor(surface) }, surface->GetBounds()));
    Scene::WritePicture(inputs.Picture, { views });
  }
  return EXIT_SUCCESS;
}
