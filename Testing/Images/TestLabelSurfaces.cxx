// The surfaces of the abdomen phantom's labels, from the front: above, all walls, exact and smooth;
// below, the walls of the liver with its neighbors, before and after relaxation.
#include "ImageTest.h"

#include "vtkCellData.h"
#include "vtkFlipFreeLabelSurfaces.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkPhantomSource.h"

namespace
{

// Each wall in a color of its first label.
void AddWalls(vtkRenderer* view, vtkPolyData* walls)
{
  vtkNew<vtkLookupTable> colors;
  colors->SetNumberOfTableValues(12);
  colors->SetTableRange(0, 11);
  for (int label = 0; label < 12; ++label)
  {
    const double hue = 0.618 * label - static_cast<int>(0.618 * label);
    double color[3];
    vtkMath::HSVToRGB(hue, 0.55, 0.9, color, color + 1, color + 2);
    colors->SetTableValue(label, color[0], color[1], color[2]);
  }
  const auto actor = ImageTest::AddSurface(view, walls, ImageTest::White);
  vtkMapper* const mapper = actor->GetMapper();
  mapper->SetLookupTable(colors);
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("BoundaryLabels");
  mapper->SetArrayComponent(0);
  mapper->SetScalarRange(0, 11);
  mapper->UseLookupTableScalarRangeOn();
  mapper->ScalarVisibilityOn();
}

} // namespace

int TestLabelSurfaces(int argc, char* argv[])
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShape(vtkPhantomSource::ABDOMEN);
  phantom->SetDimensions(80, 60, 40);
  phantom->SetSpacing(4, 4, 5);
  const auto window = ImageTest::MakeWindow(560, 480);
  const std::array<double, 4> parts[4] = { { { 0, 0.502, 0.498, 1 } }, { { 0.502, 0.502, 1, 1 } },
    { { 0, 0, 0.498, 0.498 } }, { { 0.502, 0, 1, 0.498 } } };
  for (int part = 0; part < 4; ++part)
  {
    vtkNew<vtkFlipFreeLabelSurfaces> surfaces;
    surfaces->SetInputConnection(phantom->GetOutputPort(1));
    surfaces->SetExact(part != 1);
    surfaces->SetIterations(part == 2 ? 0 : 50);
    if (part >= 2)
    {
      for (const int label : { vtkPhantomSource::LIVER, vtkPhantomSource::RIGHT_KIDNEY,
             vtkPhantomSource::GALLBLADDER, vtkPhantomSource::VENA_CAVA })
      {
        surfaces->AddLabel(label);
      }
    }
    surfaces->Update();
    const auto view = ImageTest::AddView(window,
      { { part < 2 ? 0.3 : -0.6, part < 2 ? 1.0 : -1.0, -0.35 } }, parts[part]);
    AddWalls(view, surfaces->GetOutput());
    ImageTest::Fit(view, surfaces->GetOutput());
  }
  return ImageTest::Compare(window, argc, argv);
}
