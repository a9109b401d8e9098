/**
 * Segments several organs of the built-in phantom together, so that they never meet, into one scene
 * and one label map.
 *
 *   SeveralOrgans
 *   SeveralOrgans --picture organs.png --labels organs.nii.gz
 */
#include "Display.h"
#include "Scene.h"

#include <vtkBoundingBox.h>
#include <vtkFlipFreeOrganGroup.h>
#include <vtkImageData.h>
#include <vtkMedicalImageWriter.h>
#include <vtkNew.h>
#include <vtkPhantomSource.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{

struct Organ
{
  const char* Name;
  int Label; // in the phantom's truth
  double Color[3];
  vtkSmartPointer<vtkPolyData> Surface;
};

struct Files
{
  std::string Picture;
  std::string Labels;
};

Files ReadFiles(int argc, char* argv[])
{
  Files files;
  for (int i = 1; i < argc; i += 2)
  {
    const std::string option = argv[i];
    const std::string usage =
      std::string("Usage: ") + argv[0] + " [--picture PNG] [--labels FILE]\n";
    if (option == "--help" || option == "-h")
    {
      std::cout << usage;
      std::exit(0);
    }
    if ((option != "--picture" && option != "--labels") || i + 1 == argc)
    {
      std::cerr << usage;
      std::exit(2);
    }
    (option == "--picture" ? files.Picture : files.Labels) = argv[i + 1];
  }
  if (!files.Picture.empty())
  {
    RequireDisplay();
  }
  return files;
}

void Draw(const std::string& file, vtkImageData* image, const std::vector<Organ>& organs)
{
  const Scene::Plane& plane = Scene::Axial;
  Scene::Vector center;
  organs.front().Surface->GetCenter(center.data());
  Scene::Actors slice = { Scene::SliceActor(image, center, plane) };
  Scene::Actors surfaces;
  vtkBoundingBox box;
  for (const Organ& organ : organs)
  {
    slice.push_back(Scene::ContourActor(organ.Surface, center, plane, organ.Color));
    surfaces.push_back(Scene::SurfaceActor(organ.Surface, organ.Color));
    box.AddBounds(organ.Surface->GetBounds());
  }
  double bounds[6];
  box.GetBounds(bounds);
  Scene::WritePicture(file,
    { { Scene::SliceView(slice, image->GetBounds(), plane, "", 1.02),
      Scene::SpaceView(surfaces, bounds, "from the front") } });
}

} // namespace

int main(int argc, char* argv[])
{
  const Files files = ReadFiles(argc, argv);
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShapeToAbdomen();
  phantom->Update();

  std::vector<Organ> organs = {
    { "liver", vtkPhantomSource::LIVER, { 0.86, 0.42, 0.33 }, nullptr },
    { "spleen", vtkPhantomSource::SPLEEN, { 0.72, 0.48, 0.80 }, nullptr },
    { "right kidney", vtkPhantomSource::RIGHT_KIDNEY, { 0.95, 0.72, 0.30 }, nullptr },
    { "left kidney", vtkPhantomSource::LEFT_KIDNEY, { 0.95, 0.90, 0.45 }, nullptr },
  };
  vtkNew<vtkFlipFreeOrganGroup> group;
  group->SetInputConnection(phantom->GetOutputPort());
  for (const Organ& organ : organs)
  {
    double ball[4];
    phantom->GetSeed(organ.Label, ball);
    group->AddOrgan(organ.Name, ball[0], ball[1], ball[2], ball[3]);
  }
  group->Update();
  for (Organ& organ : organs)
  {
    const int index = static_cast<int>(&organ - organs.data());
    organ.Surface = group->GetSurface(index);
    if (!organ.Surface)
    {
      return EXIT_FAILURE; // the filter has told why
    }
    std::cout << organ.Name << ": " << organ.Surface->GetNumberOfPoints() << " vertices, "
              << group->GetNumberOfSelfIntersections(index) << " self-intersections\n";
  }

  if (!files.Labels.empty())
  {
    vtkNew<vtkMedicalImageWriter> writer;
    writer->SetInputData(group->GetLabelMap());
    writer->SetFileName(files.Labels.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0)
    {
      return EXIT_FAILURE;
    }
  }
  if (!files.Picture.empty())
  {
    Draw(files.Picture, phantom->GetOutput(), organs);
  }
  return EXIT_SUCCESS;
}
