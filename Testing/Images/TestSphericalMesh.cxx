// Fig. 1b of the paper, with equiangular spacing: a sphere whose fields are all of about the same
// size, near the cube's corners too.
#include "CheckerboardView.h"

#include "vtkQuadSphereSource.h"

int TestSphericalMesh(int argc, char* argv[])
{
  vtkNew<vtkQuadSphereSource> source;
  source->SetResolution(16);
  source->SetSpacingToEquiangular();
  source->Update();

  const auto window = ImageTest::MakeWindow();
  const auto view = ImageTest::AddView(window, { { -2, 3, -2 } });
  ImageTest::AddCheckerboard(view, source->GetOutput());
  ImageTest::Fit(view, source->GetOutput());
  return ImageTest::Compare(window, argc, argv);
}
