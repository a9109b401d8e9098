// What the stages keep between updates does not show in their results.
#include "BadInput.h"
#include "DataValues.h"
#include "ProgressWatch.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace FlipFree;

namespace
{

struct Stages
{
  Stages(vtkPolyData* surface, vtkImageData* feature)
  {
    this->Search->SetInputDataObject(surface);
    this->Search->SetFeatureData(feature);
    this->Search->SetEdgeData(feature);
    this->Search->SetEdgeWindow(1);
    this->Deform->SetInputConnection(this->Search->GetOutputPort());
  }
  std::vector<double> Displacements()
  {
    this->Search->Update();
    return ValuesOf(this->Search->GetOutput()->GetPointData()->GetArray("Displacement"));
  }
  std::vector<double> Points()
  {
    this->Deform->Update();
    return PointsOf(this->Deform->GetOutput());
  }

  vtkNew<vtkCorrespondenceSearch> Search;
  vtkNew<vtkFlipFreeDeform> Deform;
};

class StageUpdates : public testing::Test
{
protected:
  // Updates the stages that are kept, and expects what stages that are new give.
  void ExpectAsIfNew()
  {
    Stages anew(this->Start, this->Image);
    anew.Search->SetEdgeWindow(this->Kept.Search->GetEdgeWindow());
    anew.Search->SetThreshold(this->Kept.Search->GetThreshold());
    anew.Deform->SetGuard(this->Kept.Deform->GetGuard());
    const std::vector<double> displacements = this->Kept.Displacements();
    EXPECT_EQ(displacements, anew.Displacements());
    EXPECT_EQ(this->Kept.Points(), anew.Points());
    EXPECT_NE(displacements, this->Last) << "the change does not matter";
    this->Last = displacements;
  }

  vtkSmartPointer<vtkPolyData> Start = StartSphere();
  vtkSmartPointer<vtkImageData> Image = SphereImage();
  Stages Kept{ this->Start, this->Image };
  std::vector<double> Last;
};

} // namespace

TEST_F(StageUpdates, FollowTheSurface)
{
  this->ExpectAsIfNew();
  vtkPoints* points = this->Start->GetPoints();
  points->SetPoint(3, points->GetPoint(4)); // and so no longer embedded
  points->Modified();
  this->Kept.Deform->GuardOff();
  this->ExpectAsIfNew();
  this->Start->ShallowCopy(StartSphere(0.8 * ExampleRadius));
  this->Kept.Deform->GuardOn();
  this->ExpectAsIfNew();
  vtkNew<vtkPoints> single;
  single->SetDataTypeToFloat();
  single->DeepCopy(this->Start->GetPoints());
  this->Start->SetPoints(single);
  this->ExpectAsIfNew();
  // The same vertices, cut along the other diagonals.
  vtkNew<vtkCellArray> turned;
  for (vtkIdType face = 0; face < this->Start->GetNumberOfPolys(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* vertices = nullptr;
    this->Start->GetPolys()->GetCellAtId(face, size, vertices);
    turned->InsertNextCell(static_cast<int>(size));
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      turned->InsertCellPoint(vertices[(corner + 1) % size]);
    }
  }
  this->Start->SetPolys(turned);
  this->ExpectAsIfNew();
}

TEST_F(StageUpdates, FollowTheFeature)
{
  for (const int type : { VTK_FLOAT, VTK_SHORT })
  {
    const auto image = ImageOfType(type);
    vtkDataArray* scalars = image->GetPointData()->GetScalars();
    scalars->DeepCopy(SphereImage()->GetPointData()->GetScalars());
    this->Image->ShallowCopy(image);
    this->Last.clear();
    this->ExpectAsIfNew();
    // In place, of which the image alone is told.
    for (vtkIdType voxel = 0; voxel < 15 * 32 * 32; ++voxel)
    {
      scalars->SetTuple1(voxel, 0);
    }
    this->Image->Modified();
    this->ExpectAsIfNew();
    this->Image->SetOrigin(2, 0, 0);
    this->ExpectAsIfNew();
    this->Image->SetOrigin(0, 0, 0);
  }
  const auto feature = ImageOfType(VTK_FLOAT);
  for (vtkIdType voxel = 0; voxel < feature->GetNumberOfPoints(); ++voxel)
  {
    const double radius = (Eigen::Vector3d(feature->GetPoint(voxel)) - ExampleCenter).norm();
    feature->GetPointData()->GetScalars()->SetTuple1(voxel, std::exp(-radius / 40));
  }
  this->Image->ShallowCopy(feature);
  this->Kept.Search->SetEdgeWindow(0);
  this->ExpectAsIfNew();
  this->Kept.Search->SetThreshold(0.6);
  this->ExpectAsIfNew();
}

// At any report of progress; and what is incomplete is not kept.
TEST_F(StageUpdates, TheSearchStopsWhenItIsTold)
{
  for (const double progress : { 0.0, 0.1, 0.4 })
  {
    this->Image->Modified();
    ProgressWatch watch(this->Kept.Search, progress);
    this->Kept.Search->Update();
    EXPECT_TRUE(watch.StoppedSoon());
    EXPECT_EQ(this->Kept.Search->GetOutput()->GetNumberOfPoints(), 0);
  }
  this->Kept.Search->Modified();
  this->ExpectAsIfNew();
}
