#include "Polygons.h"

#include "Exchange/PolygonFile.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <vector>

namespace Command
{
namespace
{

vtkSmartPointer<vtkPolyData> SurfaceOf(const FlipFree::CheckedPolygons& polygons)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t at = 0; at < polygons.GetPoints().size(); at += 3)
  {
    points->InsertNextPoint(&polygons.GetPoints()[at]);
  }
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> face;
  for (std::size_t index = 0; index + 1 < polygons.GetOffsets().size(); ++index)
  {
    const auto corners = polygons.GetCorners().begin();
    face.assign(corners + polygons.GetOffsets()[index], corners + polygons.GetOffsets()[index + 1]);
    cells->InsertNextCell(static_cast<vtkIdType>(face.size()), face.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

} // namespace

vtkSmartPointer<vtkPolyData> ReadPolygons(const std::string& name, const std::string& bytes)
{
  return SurfaceOf(FlipFree::ReadPolygonFile(name, bytes));
}

vtkSmartPointer<vtkPolyData> JudgedPolygons(vtkPolyData* surface)
{
  if (!surface->GetPolys()->IsValid() || !surface->GetStrips()->IsValid())
  {
    FlipFree::RefusePolygons("its list of faces is damaged");
  }
  FlipFree::CheckedPolygons polygons;
  double point[3];
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    surface->GetPoint(vertex, point);
    polygons.AddPoint(point);
  }
  vtkNew<vtkIdList> vertices;
  std::vector<std::int64_t> face;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); ++cell)
  {
    surface->GetPolys()->GetCellAtId(cell, vertices);
    face.assign(vertices->begin(), vertices->end());
    polygons.AddFace(face);
  }
  for (vtkIdType strip = 0; strip < surface->GetNumberOfStrips(); ++strip)
  {
    surface->GetStrips()->GetCellAtId(strip, vertices);
    for (vtkIdType first = 0; first + 2 < vertices->GetNumberOfIds(); ++first)
    {
      // Every other triangle of a strip is turned round.
      const vtkIdType turn = first % 2;
      polygons.AddFace({ vertices->GetId(first + turn), vertices->GetId(first + 1 - turn),
        vertices->GetId(first + 2) });
    }
  }
  return SurfaceOf(polygons);
}

} // namespace Command
