// Fig. 1d of the paper: a sphere outside the cup has become the cup, cavity and all, and its fields
// are still in order.
#include "CheckerboardView.h"
#include "PhantomCases.h"
#include "SphereCheckerboard.h"

int TestCupSurface(int argc, char* argv[])
{
  vtkNew<vtkPhantomSource> phantom;
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  FlipFree::SegmentCup(segmentation, phantom);
  segmentation->Update();

  const auto window = ImageTest::MakeWindow(400, 400);
  const auto view = ImageTest::AddView(window, { { -2, 3, -3.5 } });
  ImageTest::AddCheckerboard(view, ImageTest::WithCheckerboard(segmentation));
  ImageTest::Fit(view, segmentation->GetSurface());
  return ImageTest::Compare(window, argc, argv);
}
