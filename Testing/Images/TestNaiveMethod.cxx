// Fig. 3 of the paper: the naive method, which takes targets as they are found, beside the
// flip-free one, from the same sphere outside the cup. Cells that intersect others are red: the
// naive surface is full of them, the flip-free one has none.
#include "ImageTest.h"
#include "PhantomCases.h"

#include "vtkSurfaceValidity.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkUnsignedCharArray.h"

namespace
{

vtkSmartPointer<vtkPolyData> WithDefectsMarked(vtkFlipFreeSegmentation* segmentation)
{
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputConnection(segmentation->GetOutputPort());
  validity->Update();
  vtkSmartPointer<vtkPolyData> surface = validity->GetOutput();
  vtkDataArray* defects = surface->GetCellData()->GetArray("Defects");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    const bool intersects =
      (static_cast<int>(defects->GetTuple1(cell)) & vtkSurfaceValidity::SELF_INTERSECTING) != 0;
    const ImageTest::Color& color = intersects ? ImageTest::Red : ImageTest::Sand;
    colors->InsertNextTuple3(255 * color[0], 255 * color[1], 255 * color[2]);
  }
  surface->GetCellData()->SetScalars(colors);
  return surface;
}

} // namespace

int TestNaiveMethod(int argc, char* argv[])
{
  const auto window = ImageTest::MakeWindow(600, 300);
  for (const bool naive : { true, false })
  {
    vtkNew<vtkPhantomSource> phantom;
    vtkNew<vtkFlipFreeSegmentation> segmentation;
    FlipFree::SegmentCup(segmentation, phantom);
    phantom->SetNoiseStandardDeviation(0);
    phantom->PartialVolumeOff();
    // Off the grid's symmetry, where the last digit decides between two voxels.
    double* offset = segmentation->GetStartCenterOffset();
    segmentation->SetStartCenterOffset(offset[0] + 0.3, offset[1] + 0.2, offset[2] + 0.1);
    if (naive)
    {
      FlipFree::MakeNaive(segmentation);
    }
    const auto surface = WithDefectsMarked(segmentation);
    const double left = naive ? 0 : 0.5;
    const auto view =
      ImageTest::AddView(window, { { -2, 3, -3.5 } }, { { left, 0, left + 0.5, 1 } });
    ImageTest::AddSurface(view, surface, ImageTest::White)->GetMapper()->ScalarVisibilityOn();
    ImageTest::AddLines(view, surface, ImageTest::Ink);
    ImageTest::Fit(view, surface);
  }
  return ImageTest::Compare(window, argc, argv);
}
