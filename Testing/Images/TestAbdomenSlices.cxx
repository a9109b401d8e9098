// Fig. 5 and 6 of the paper, on the abdomen phantom: three slices through the seed in the liver,
// with the contours of the segmentation (amber) and of the truth (cyan), and the surface seen from
// the front.
#include "PhantomCases.h"
#include "SliceView.h"

#include "vtkDiscreteFlyingEdges3D.h"

int TestAbdomenSlices(int argc, char* argv[])
{
  vtkNew<vtkPhantomSource> phantom;
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  FlipFree::SegmentLiver(segmentation, phantom);
  segmentation->Update();
  vtkPolyData* surface = segmentation->GetSurface();
  vtkNew<vtkDiscreteFlyingEdges3D> truth;
  truth->SetInputConnection(phantom->GetOutputPort(1));
  truth->SetValue(0, vtkPhantomSource::LIVER);
  truth->Update();

  vtkImageData* image = phantom->GetOutput();
  std::array<int, 3> voxel;
  double inVoxel[3];
  double* seed = segmentation->GetSeedCenter();
  image->ComputeStructuredCoordinates(seed, voxel.data(), inVoxel);

  const auto window = ImageTest::MakeWindow(560, 480);
  const std::array<double, 4> parts[3] = { { { 0.502, 0.502, 1, 1 } }, { { 0, 0, 0.498, 0.498 } },
    { { 0, 0.502, 0.498, 1 } } };
  for (int axis = 0; axis < 3; ++axis)
  {
    ImageTest::SliceView slice(window, parts[axis], axis, voxel);
    slice.Show(image, -150, 250, 280);
    slice.AddContour(truth->GetOutput(), ImageTest::Cyan, 1.5f);
    slice.AddContour(surface, ImageTest::Amber, 1.5f);
  }
  const auto view = ImageTest::AddView(window, { { 0.35, 1, -0.3 } }, { { 0.502, 0, 1, 0.498 } });
  view->SetBackground(ImageTest::Night.data());
  ImageTest::AddSmoothSurface(view, surface, ImageTest::Amber);
  ImageTest::Fit(view, surface);
  return ImageTest::Compare(window, argc, argv);
}
