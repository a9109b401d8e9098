// Fig. 4 of the paper: the mean distance from the vertices to their targets falls from iteration to
// iteration, here for the liver of the abdomen phantom. Each level of refinement has its color.
#include "ImageTest.h"
#include "PhantomCases.h"

#include "vtkAxis.h"
#include "vtkChartLegend.h"
#include "vtkChartXY.h"
#include "vtkContextScene.h"
#include "vtkContextView.h"
#include "vtkFloatArray.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkVariant.h"

#include <string>

namespace
{

/// The rows of one level.
vtkSmartPointer<vtkTable> LevelOf(vtkTable* convergence, int level)
{
  auto part = vtkSmartPointer<vtkTable>::New();
  for (const char* name : { "Iteration", "MeanDistance" })
  {
    vtkNew<vtkFloatArray> column;
    column->SetName(name);
    for (vtkIdType row = 0; row < convergence->GetNumberOfRows(); ++row)
    {
      if (convergence->GetValueByName(row, "Level").ToInt() == level)
      {
        column->InsertNextValue(convergence->GetValueByName(row, name).ToFloat());
      }
    }
    part->AddColumn(column);
  }
  return part;
}

void Label(vtkAxis* axis, const char* title)
{
  axis->SetTitle(title);
  for (vtkTextProperty* text : { axis->GetTitleProperties(), axis->GetLabelProperties() })
  {
    text->SetFontSize(14);
    text->BoldOff();
    text->SetColor(ImageTest::Ink.data());
  }
  axis->SetMinimumLimit(0);
}

} // namespace

int TestConvergenceChart(int argc, char* argv[])
{
  vtkNew<vtkPhantomSource> phantom;
  vtkNew<vtkFlipFreeSegmentation> segmentation;
  FlipFree::SegmentLiver(segmentation, phantom);
  segmentation->Update();

  vtkNew<vtkChartXY> chart;
  Label(chart->GetAxis(vtkAxis::BOTTOM), "Iteration");
  Label(chart->GetAxis(vtkAxis::LEFT), "Mean distance to targets (mm)");
  const ImageTest::Color colors[] = { ImageTest::Ink, ImageTest::Blue, ImageTest::Red };
  for (int level = 0; level < segmentation->GetLevels(); ++level)
  {
    vtkPlot* curve = chart->AddPlot(vtkChart::LINE);
    curve->SetInputData(LevelOf(segmentation->GetConvergence(), level), 0, 1);
    curve->GetPen()->SetColorF(colors[level][0], colors[level][1], colors[level][2]);
    curve->SetWidth(3);
    curve->SetLabel("Level " + std::to_string(level + 1));
  }

  chart->SetShowLegend(true);
  vtkChartLegend* legend = chart->GetLegend();
  legend->SetLabelSize(14);
  legend->GetLabelProperties()->SetColor(ImageTest::Ink.data());
  legend->GetPen()->SetLineType(vtkPen::NO_PEN);

  vtkNew<vtkContextView> view;
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(480, 320); // not finer: charts are laid out by the pixel
  view->GetScene()->AddItem(chart);
  return ImageTest::Compare(view->GetRenderWindow(), argc, argv, 2, 1);
}
