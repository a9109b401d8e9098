/**
 * Segments a vessel between points, and corrects it by another point.
 *
 *   TraceVessel                                       the vessel of the built-in phantom
 *   TraceVessel ct.nii.gz 212 -143 480 171 -168 228   a point at each end, LPS millimeters
 *
 * With --picture PNG, it draws what came out.
 */
#include "Display.h"
#include "Scene.h"

#include <vtkDataArray.h>
#include <vtkFlipFreeVesselSegmentation.h>
#include <vtkImageData.h>
#include <vtkMedicalImageReader.h>
#include <vtkNew.h>
#include <vtkPhantomSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

struct Options
{
  std::string File; // none: the phantom
  std::vector<double> Coordinates;
  std::string Picture;
};

[[noreturn]] void ShowUsage(const char* program, bool asked)
{
  (asked ? std::cout : std::cerr)
    << "Usage: " << program << " [FILE X Y Z X Y Z ...] [--picture PNG]\n"
    << "The points lie in the vessel, one at each end; LPS millimeters.\n";
  std::exit(asked ? 0 : 2);
}

Options ReadOptions(int argc, char* argv[])
{
  Options options;
  const std::vector<std::string> words(argv + 1, argv + argc);
  try
  {
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      if (words[i] == "--help" || words[i] == "-h")
      {
        ShowUsage(argv[0], true);
      }
      if (words[i] == "--picture")
      {
        options.Picture = words.at(++i);
      }
      else if (options.File.empty())
      {
        options.File = words[i];
      }
      else
      {
        options.Coordinates.push_back(std::stod(words[i]));
      }
    }
  }
  catch (const std::logic_error&) // of std::stod and at
  {
    ShowUsage(argv[0], false);
  }
  if (options.File.empty())
  {
    options.Coordinates = { 13.3, 44.6, 44.5, 82, 50.4, 37.6 };
  }
  if (options.Coordinates.size() < 6 || options.Coordinates.size() % 3 != 0)
  {
    ShowUsage(argv[0], false);
  }
  return options;
}

vtkSmartPointer<vtkImageData> ReadOrMake(const std::string& file)
{
  if (!file.empty())
  {
    vtkNew<vtkMedicalImageReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShape(vtkPhantomSource::VESSEL);
  phantom->Update();
  return phantom->GetOutput();
}

/// A line of text: how long and how wide it is.
void Describe(vtkFlipFreeVesselSegmentation* vessel)
{
  vtkPolyData* centerline = vessel->GetCenterline();
  vtkDataArray* radii = centerline->GetPointData()->GetArray("Radius");
  vtkDataArray* lengths = centerline->GetPointData()->GetArray("ArcLength");
  double radius = 0;
  double length = 0;
  for (vtkIdType point = 0; point < centerline->GetNumberOfPoints(); ++point)
  {
    radius += radii->GetTuple1(point) / static_cast<double>(centerline->GetNumberOfPoints());
    length = std::max(length, lengths->GetTuple1(point));
  }
  std::cout << "length " << length << " mm, mean radius " << radius << " mm, "
            << vessel->GetSurface()->GetNumberOfPoints() << " vertices, "
            << vessel->GetNumberOfSelfIntersections() << " self-intersections, "
            << static_cast<int>(100 * vessel->GetSupport()) << " % of the boundary seen\n";
}

/// A slice through a point of the vessel, and the vessel in space.
void Draw(const std::string& name, vtkImageData* image, vtkPolyData* surface,
  const Scene::Vector& center)
{
  const double* bounds = surface->GetBounds();
  Scene::WritePicture(name,
    { { Scene::SliceView({ Scene::SliceActor(image, center, Scene::Axial),
                           Scene::ContourActor(surface, center, Scene::Axial) },
          bounds, Scene::Axial),
      Scene::SpaceView({ Scene::SurfaceActor(surface) }, bounds, "", 0.95) } });
}

} // namespace

int main(int argc, char* argv[])
{
  const Options options = ReadOptions(argc, argv);
  if (!options.Picture.empty())
  {
    RequireDisplay();
  }
  const vtkSmartPointer<vtkImageData> image = ReadOrMake(options.File);
  vtkNew<vtkFlipFreeVesselSegmentation> vessel;
  vessel->SetInputData(image);
  for (std::size_t first = 0; first < options.Coordinates.size(); first += 3)
  {
    vessel->AddPoint(options.Coordinates[first], options.Coordinates[first + 1],
      options.Coordinates[first + 2]);
  }
  vessel->Update();
  if (vessel->GetSurface()->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }
  Describe(vessel);

  // Halfway, 2 mm above the center, nothing is said to be vessel.
  vtkPolyData* centerline = vessel->GetCenterline();
  Scene::Vector center;
  centerline->GetPoint(centerline->GetNumberOfPoints() / 2, center.data());
  vessel->AddOutsidePoint(center[0], center[1], center[2] + 2);
  vessel->Update();
  if (vessel->GetSurface()->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE;
  }
  std::cout << "corrected: ";
  Describe(vessel);
  if (!options.Picture.empty())
  {
    Draw(options.Picture, image, vessel->GetSurface(), center);
  }
  return EXIT_SUCCESS;
}
