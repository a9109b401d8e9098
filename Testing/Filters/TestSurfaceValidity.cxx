#include "vtkSurfaceValidity.h"

#include "ExamplePolyData.h"
#include "FilterErrors.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMeshQuality.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

double Measure(vtkSurfaceValidity* validity, const char* column)
{
  return validity->GetMeasures()->GetValueByName(0, column).ToDouble();
}

vtkUnsignedCharArray* Defects(vtkSurfaceValidity* validity)
{
  return vtkUnsignedCharArray::SafeDownCast(
    validity->GetOutput()->GetCellData()->GetArray("Defects"));
}

vtkSmartPointer<vtkPolyData> QuadPotato(int n)
{
  QuadSphere sphere =
    MakeQuadSphere(n, Eigen::Vector3d::Zero(), 10, QuadSphereSpacing::Equiangular);
  return PolyDataOf(Potato(n, Eigen::Vector3d::Zero(), 10).Points, sphere.Faces);
}

} // namespace

TEST(SurfaceValidityFilter, PassesAValidSurfaceThrough)
{
  const auto surface = QuadPotato(8);
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  EXPECT_FALSE(validity->IsValid());
  validity->Update();
  EXPECT_TRUE(validity->IsValid());
  EXPECT_EQ(validity->GetOutput()->GetPoints(), surface->GetPoints());
  EXPECT_EQ(validity->GetOutput()->GetNumberOfPolys(), surface->GetNumberOfPolys());
  ASSERT_EQ(validity->GetMeasures()->GetNumberOfRows(), 1);
  EXPECT_EQ(validity->GetMeasures()->GetNumberOfColumns(), 12);
  EXPECT_EQ(Measure(validity, "Valid"), 1);
  EXPECT_EQ(Measure(validity, "SelfIntersections"), 0);
  EXPECT_EQ(Measure(validity, "FlippedCorners"), -1);
  EXPECT_EQ(Measure(validity, "EulerNumber"), 2);
  EXPECT_EQ(Measure(validity, "BoundaryEdges"), 0);
  EXPECT_EQ(Measure(validity, "NonManifoldEdges"), 0);
  EXPECT_EQ(Measure(validity, "MisorientedEdges"), 0);
  EXPECT_GT(Measure(validity, "MinimumDihedralAngle"), 60);
  EXPECT_GT(Measure(validity, "MinimumGap"), 0);
  EXPECT_GT(Measure(validity, "EdgeLengthVariation"), 0);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(Defects(validity)->GetValue(cell), 0);
  }
  EXPECT_EQ(surface->GetCellData()->GetNumberOfArrays(), 0) << "the input was changed";
}

TEST(SurfaceValidityFilter, ScaledJacobianIsVerdicts)
{
  const auto surface = QuadPotato(9);
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  validity->Update();
  vtkNew<vtkMeshQuality> verdict;
  verdict->SetInputData(surface);
  verdict->SetQuadQualityMeasureToScaledJacobian();
  verdict->SetTriangleQualityMeasureToScaledJacobian();
  verdict->Update();
  vtkDataArray* expected = verdict->GetOutput()->GetCellData()->GetArray("Quality");
  vtkDataArray* jacobians = validity->GetOutput()->GetCellData()->GetArray("ScaledJacobian");
  ASSERT_EQ(jacobians->GetNumberOfTuples(), expected->GetNumberOfTuples());
  double least = 1;
  for (vtkIdType cell = 0; cell < expected->GetNumberOfTuples(); ++cell)
  {
    EXPECT_NEAR(jacobians->GetTuple1(cell), expected->GetTuple1(cell), 1e-12);
    least = std::min(least, expected->GetTuple1(cell));
  }
  EXPECT_NEAR(Measure(validity, "MinimumScaledJacobian"), least, 1e-12);
  EXPECT_GE(Measure(validity, "FirstPercentileScaledJacobian"), least);
}

TEST(SurfaceValidityFilter, FindsFoldsAgainstAReference)
{
  const auto reference = QuadPotato(8);
  const auto folded = QuadPotato(8);
  const Eigen::Vector3d inside = -0.3 * Eigen::Vector3d(folded->GetPoint(100));
  folded->GetPoints()->SetPoint(100, inside.data());
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(folded);
  validity->SetReferenceSurfaceData(reference);
  validity->Update();
  EXPECT_FALSE(validity->IsValid());
  EXPECT_GT(Measure(validity, "FlippedCorners"), 0);
  int marked = 0;
  for (vtkIdType cell = 0; cell < folded->GetNumberOfCells(); ++cell)
  {
    const bool isFlipped =
      (Defects(validity)->GetValue(cell) & vtkSurfaceValidity::FLIPPED_CORNER) != 0;
    EXPECT_TRUE(!isFlipped || folded->GetCell(cell)->GetPointIds()->IsId(100) >= 0);
    marked += isFlipped;
  }
  EXPECT_GT(marked, 0);
  validity->SetInputData(reference);
  validity->Update();
  EXPECT_TRUE(validity->IsValid());
  EXPECT_EQ(Measure(validity, "FlippedCorners"), 0);
}

TEST(SurfaceValidityFilter, MarksSelfIntersectionsAndHolesBesideOtherCells)
{
  const auto surface = QuadPotato(8);
  const Eigen::Vector3d beyond = -2 * Eigen::Vector3d(surface->GetPoint(100));
  surface->GetPoints()->SetPoint(100, beyond.data());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  surface->SetLines(lines);
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  validity->Update();
  EXPECT_GT(Measure(validity, "SelfIntersections"), 0);
  EXPECT_EQ(Measure(validity, "MinimumGap"), 0);
  EXPECT_EQ(Defects(validity)->GetNumberOfValues(), surface->GetNumberOfCells());
  EXPECT_EQ(Defects(validity)->GetValue(0), 0) << "the line";
  int marked = 0;
  for (vtkIdType cell = 1; cell < surface->GetNumberOfCells(); ++cell)
  {
    const bool isMarked =
      (Defects(validity)->GetValue(cell) & vtkSurfaceValidity::SELF_INTERSECTING) != 0;
    marked += isMarked;
    // All faces at the vertex that was pulled through the far side run into that side.
    EXPECT_TRUE(isMarked || surface->GetCell(cell)->GetPointIds()->IsId(100) < 0) << cell;
  }
  EXPECT_GT(marked, 4);

  vtkNew<vtkCellArray> fewer;
  fewer->DeepCopy(QuadPotato(8)->GetPolys());
  vtkNew<vtkPolyData> open;
  open->SetPoints(QuadPotato(8)->GetPoints());
  vtkNew<vtkIdList> ids;
  vtkNew<vtkCellArray> polys;
  for (vtkIdType cell = 1; cell < fewer->GetNumberOfCells(); ++cell)
  {
    fewer->GetCellAtId(cell, ids);
    polys->InsertNextCell(ids);
  }
  open->SetPolys(polys);
  validity->SetInputData(open);
  validity->Update();
  EXPECT_FALSE(validity->IsValid());
  EXPECT_EQ(Measure(validity, "BoundaryEdges"), 4);
  EXPECT_EQ(Measure(validity, "EulerNumber"), 1);
}
