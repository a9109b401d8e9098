// Fig. 1f of the paper: a sphere outside the U-shaped tube has become the tube.
#include "CheckerboardView.h"
#include "PhantomCases.h"
#include "SphereCheckerboard.h"

int TestUTubeSurface(int argc, char* argv[])
{
  vtkNew<vtkPhantomSource> phantom;
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  FlipFree::SegmentUTube(segmentation, phantom);
  segmentation->Update();

  const auto window = ImageTest::MakeWindow(400, 400);
  const auto view = ImageTest::AddView(window, { { -1, 3, -1 } });
  ImageTest::AddCheckerboard(view, ImageTest::WithCheckerboard(segmentation));
  ImageTest::Fit(view, segmentation->GetSurface());
  return ImageTest::Compare(window, argc, argv);
}
