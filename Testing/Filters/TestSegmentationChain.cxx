// The stages chained by hand give the composite's surface, bit for bit.
#include "DataValues.h"
#include "PhantomCases.h"
#include "vtkFlipFreeRefinement.h"
#include "vtkQuadSphereSource.h"
#include "vtkSeedRegionDiffusion.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

namespace
{

constexpr int Resolution = 16;
constexpr int Levels = 2;

vtkSmartPointer<vtkPolyData> Detach(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(surface);
  return copy;
}

// As many iterations at each level as the composite made.
vtkSmartPointer<vtkPolyData> ChainByHand(vtkImageData* image, const double seed[4],
  vtkTable* convergence)
{
  vtkNew<vtkSeedRegionDiffusion> smooth;
  smooth->SetInputData(image);
  smooth->SetSeedCenter(seed);
  smooth->SetSeedRadius(seed[3]);
  vtkNew<vtkGMMFeatureFilter> feature;
  feature->SetInputConnection(smooth->GetOutputPort());
  feature->SetSeedCenter(seed);
  feature->SetSeedRadius(seed[3]);
  feature->CarvingOff();
  vtkNew<vtkCorrespondenceSearch> search;
  search->SetFeatureConnection(feature->GetOutputPort());
  vtkNew<vtkFlipFreeDeform> deform;
  deform->SetInputConnection(search->GetOutputPort());
  vtkNew<vtkFlipFreeRefinement> refine;
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->SetCenter(seed);
  sphere->SetRadius(seed[3]);
  sphere->SetResolution(Resolution >> (Levels - 1));
  sphere->Update();

  const vtkSmartPointer<vtkPolyData> start = Detach(sphere->GetOutput());
  vtkSmartPointer<vtkPolyData> surface = start;
  int level = 0;
  for (vtkIdType row = 0; row < convergence->GetNumberOfRows(); ++row)
  {
    if (convergence->GetValueByName(row, "Level").ToInt() > level)
    {
      ++level;
      if (level == Levels) // the second run
      {
        feature->CarvingOn();
        feature->SetSurfaceData(surface);
        surface = start;
      }
      else
      {
        refine->SetInputData(surface);
        refine->Update();
        surface = Detach(refine->GetOutput());
        if (level < Levels)
        {
          feature->SetSurfaceData(surface);
        }
      }
    }
    search->SetEdgeConnection(level + 1 == Levels ? smooth->GetOutputPort() : nullptr);
    search->SetInputData(surface);
    deform->Update();
    surface = Detach(deform->GetOutput());
  }
  return surface;
}

} // namespace

TEST(SegmentationChain, StagesByHandGiveTheCompositesSurface)
{
  double seed[4];
  ASSERT_TRUE(FlipFree::CoarseAbdomen()->GetSeed(vtkPhantomSource::SPLEEN, seed));
  vtkImageData* image = FlipFree::CoarseAbdomen()->GetOutput();
  vtkNew<vtkFlipFreeSegmentation> composite;
  composite->SetInputData(image);
  composite->SetSeedCenter(seed);
  composite->SetSeedRadius(seed[3]);
  composite->SetResolution(Resolution);
  composite->SetLevels(Levels);
  composite->Update();
  vtkPolyData* expected = composite->GetSurface();
  ASSERT_EQ(expected->GetNumberOfPoints(), 6 * Resolution * Resolution);
  ASSERT_GT(composite->GetConvergence()->GetNumberOfRows(), Levels);

  const auto surface = ChainByHand(image, seed, composite->GetConvergence());
  ASSERT_EQ(surface->GetNumberOfPoints(), expected->GetNumberOfPoints());
  EXPECT_EQ(FlipFree::PointsOf(surface), FlipFree::PointsOf(expected));
}
