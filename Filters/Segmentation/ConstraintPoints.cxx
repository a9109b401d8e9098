#include "ConstraintPoints.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace FlipFree
{
namespace
{

// One value per point.
void RequireForm(vtkPointSet* points, vtkAbstractArray* values, const std::string& name)
{
  const std::string array =
    "the point array '" + std::string(values->GetName()) + "' of " + name + " has ";
  if (values->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(
      array + std::to_string(values->GetNumberOfComponents()) + " components; it needs one");
  }
  if (values->GetNumberOfTuples() != points->GetNumberOfPoints())
  {
    throw std::invalid_argument(array + std::to_string(values->GetNumberOfTuples()) +
      " values for " + std::to_string(points->GetNumberOfPoints()) +
      " points; it needs one for each");
  }
}

vtkDataArray* ArrayOf(vtkPointSet* points, const char* array, const std::string& name,
  const char* meaning)
{
  vtkDataArray* const values = points->GetPointData()->GetArray(array);
  if (!values)
  {
    throw std::invalid_argument(name + " has no point array '" + array + "'; add it: " + meaning);
  }
  RequireForm(points, values, name);
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

void AddConstraintsOf(vtkPointSet* points, const std::string& name, NamedConstraints& organs)
{
  const ConstraintList constraints = ConstraintsOf(points, name);
  if (constraints.empty())
  {
    return;
  }
  auto* const names =
    vtkStringArray::SafeDownCast(points->GetPointData()->GetAbstractArray("Organ"));
  vtkDataArray* const numbers = names
    ? nullptr
    : ArrayOf(points, "Organ", name, "the name of each point's organ, or its number, from 1");
  if (names)
  {
    RequireForm(points, names, name);
  }
  for (std::size_t index = 0; index < constraints.size(); ++index)
  {
    const auto row = static_cast<vtkIdType>(index);
    auto organ = organs.end();
    if (names)
    {
      organ = std::find_if(organs.begin(), organs.end(),
        [&](const auto& candidate) { return candidate.first == names->GetValue(row); });
    }
    else
    {
      const double number = numbers->GetTuple1(row);
      const auto next = static_cast<double>(organs.size() + 1);
      if (!(number >= 1 && number <= next && number == std::floor(number)))
      {
        throw std::invalid_argument("the point array 'Organ' of " + name + " is " +
          std::to_string(number) + " at point " + std::to_string(index) +
          "; organs are numbered from 1, without gaps");
      }
      organ = organs.begin() + static_cast<std::ptrdiff_t>(number) - 1;
    }
    if (organ == organs.end())
    {
      organs.push_back(
        { names ? names->GetValue(row) : "organ " + std::to_string(organs.size() + 1), {} });
      organ = organs.end() - 1;
    }
    organ->second.push_back(constraints[index]);
  }
}

void TakeSeed(const std::string& name, SeedSphere& seed, ConstraintList& constraints)
{
  const auto first = std::find_if(constraints.begin(), constraints.end(),
    [](const PointConstraint& constraint) { return constraint.Kind == ConstraintKind::Seed; });
  if (first == constraints.end())
  {
    throw std::invalid_argument(name + " has no seed; give a sphere that lies within it");
  }
  seed = { first->Point, first->Radius };
  constraints.erase(first);
  TakeLargestSeed(seed, constraints);
}

} // namespace FlipFree
