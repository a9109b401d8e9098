/**
 * Segments a vessel between points, and corrects it by another point.
 *
 *   TraceVessel                                       the vessel of the built-in phantom
 *   TraceVessel ct.nii.gz 212 -143 480 171 -168 228   a point at either end, LPS millimeters
 */
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
#include <iterator>
#include <vector>

namespace
{

vtkSmartPointer<vtkImageData> ReadOrMake(const char* file)
{
  if (file)
  {
    vtkNew<vtkMedicalImageReader> reader;
    reader->SetFileName(file);
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

} // namespace

int main(int argc, char* argv[])
{
  std::vector<double> coordinates = { 13.3, 44.6, 44.5, 82, 50.4, 37.6 };
  if (argc > 1)
  {
    coordinates.clear();
    std::transform(argv + 2, argv + argc, std::back_inserter(coordinates), std::atof);
    if (coordinates.size() < 6 || coordinates.size() % 3 != 0)
    {
      std::cerr << "Usage: TraceVessel [FILE X Y Z X Y Z ...]\n";
      return EXIT_FAILURE;
    }
  }

  vtkNew<vtkFlipFreeVesselSegmentation> vessel;
  vessel->SetInputData(ReadOrMake(argc > 1 ? argv[1] : nullptr));
  for (std::size_t first = 0; first < coordinates.size(); first += 3)
  {
    vessel->AddPoint(coordinates[first], coordinates[first + 1], coordinates[first + 2]);
  }
  vessel->Update();
  if (vessel->GetSurface()->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }
  Describe(vessel);

  // Halfway, 2 mm from the center, nothing is said to be vessel.
  vtkPolyData* centerline = vessel->GetCenterline();
  double outside[3];
  centerline->GetPoint(centerline->GetNumberOfPoints() / 2, outside);
  vessel->AddOutsidePoint(outside[0], outside[1] + 2, outside[2]);
  vessel->Update();
  if (vessel->GetSurface()->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE;
  }
  std::cout << "corrected: ";
  Describe(vessel);
  return EXIT_SUCCESS;
}
