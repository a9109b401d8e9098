#include "VesselOutputs.h"

#include "Vessel/Polyline.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace FlipFree
{

void FillCenterline(const VesselTree& tree, vtkPolyData* centerline)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Radius");
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("ArcLength");
  vtkNew<vtkIntArray> parents;
  parents->SetName("Parent");
  for (const VesselBranch& branch : tree.Branches)
  {
    const PointList centers = branch.Sections.Centers();
    const Eigen::VectorXd radius = branch.Sections.MeanRadii();
    const Eigen::VectorXd length = ArcLengths(centers);
    lines->InsertNextCell(static_cast<int>(centers.rows()));
    for (Eigen::Index place = 0; place < centers.rows(); ++place)
    {
      lines->InsertCellPoint(
        points->InsertNextPoint(centers(place, 0), centers(place, 1), centers(place, 2)));
      radii->InsertNextValue(radius[place]);
      lengths->InsertNextValue(length[place]);
    }
    parents->InsertNextValue(branch.Parent);
  }
  centerline->SetPoints(points);
  centerline->SetLines(lines);
  centerline->GetPointData()->AddArray(radii);
  centerline->GetPointData()->AddArray(lengths);
  centerline->GetCellData()->AddArray(parents);
}

} // namespace FlipFree
