// Fig. 1a of the paper: a cube with straight rows of cells, in fields of 4 x 4 per side. The rows
// stop half a cell before the cube's edges, which are therefore bevelled, with a triangle at each
// corner.
#include "CheckerboardView.h"

#include "vtkQuadSphereSource.h"

int TestCubicalMesh(int argc, char* argv[])
{
  vtkNew<vtkQuadSphereSource> source;
  source->SetResolution(16);
  source->SetSpacingToCube();
  source->Update();

  const auto window = ImageTest::MakeWindow();
  const auto view = ImageTest::AddView(window, { { -2, 3, -2 } });
  ImageTest::AddCheckerboard(view, source->GetOutput());
  ImageTest::Fit(view, source->GetOutput());
  return ImageTest::Compare(window, argc, argv);
}
