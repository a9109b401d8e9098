/**
 * What the readers of polygon files share: the file's bytes, its numbers, and polygons that are
 * checked as they come.
 */
#ifndef FlipFreeCommandCheckedPolygons_h
#define FlipFreeCommandCheckedPolygons_h

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace Command
{

/// All functions throw a Failure that says what is wrong in the file.
class CheckedPolygons
{
public:
  CheckedPolygons() { this->Points->SetDataTypeToDouble(); }

  vtkIdType NumberOfPoints() const { return this->Points->GetNumberOfPoints(); }

  void AddPoint(const double* point);

  /// After all points.
  void AddFace(const std::vector<vtkIdType>& vertices);

  vtkSmartPointer<vtkPolyData> Surface() const;

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
};

/// All bytes of a file.
std::string Contents(const std::string& name);

/// A number that takes up the whole word.
double NumberIn(const std::string& word);

vtkIdType IndexIn(double number);

} // namespace Command

#endif
