#include "ConstraintPoints.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <stdexcept>

namespace FlipFree
{
namespace
{

vtkDataArray* ArrayOf(vtkPointSet* points, const char* array, const std::string& name,
  const char* meaning)
{
  vtkDataArray* const values = points->GetPointData()->GetArray(array);
  if (!values)
  {
    throw std::invalid_argument(name + " has no point array '" + array + "'; add it: " + meaning);
  }
  if (values->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("the point array '" + std::string(array) + "' of " + name +
      " has " + std::to_string(values->GetNumberOfComponents()) + " components; it needs one");
  }
  return values;
}

} // namespace

ConstraintList ConstraintsOf(vtkPointSet* points, const std::string& name)
{
  ConstraintList constraints;
  if (points->GetNumberOfPoints() == 0)
  {
    return constraints;
  }
  vtkDataArray* const kinds = ArrayOf(points, "Constraint", name,
    "0 for a point outside the organ, 1 inside, 2 on its boundary, 3 for a seed");
  for (vtkIdType index = 0; index < points->GetNumberOfPoints(); ++index)
  {
    const double kind = kinds->GetTuple1(index);
    if (kind != 0 && kind != 1 && kind != 2 && kind != 3)
    {
      throw std::invalid_argument("the point array 'Constraint' of " + name + " is " +
        std::to_string(kind) + " at point " + std::to_string(index) +
        "; it can be 0 (outside), 1 (inside), 2 (on the boundary) or 3 (a seed)");
    }
    PointConstraint constraint;
    constraint.Kind = static_cast<ConstraintKind>(static_cast<int>(kind));
    points->GetPoint(index, constraint.Point.data());
    if (constraint.Kind == ConstraintKind::Seed)
    {
      constraint.Radius =
        ArrayOf(points, "Radius", name, "the radii of the seeds, in millimeters")->GetTuple1(index);
    }
    constraints.push_back(constraint);
  }
  return constraints;
}

} // namespace FlipFree
