#include "ConstraintPoints.h"

#include "Error.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
    throw Error(ErrorCode::InvalidInput,
      array + std::to_string(values->GetNumberOfComponents()) + " components; it needs one");
  }
  if (values->GetNumberOfTuples() != points->GetNumberOfPoints())
  {
    throw Error(ErrorCode::InvalidInput,
      array + std::to_string(values->GetNumberOfTuples()) + " values for " +
        std::to_string(points->GetNumberOfPoints()) + " points; it needs one for each");
  }
}

vtkDataArray* ArrayOf(vtkPointSet* points, const char* array, const std::string& name,
  const char* meaning)
{
  vtkDataArray* const values = points->GetPointData()->GetArray(array);
  if (!values)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has no point array '" + array + "'; add it: " + meaning);
  }
  RequireForm(points, values, name);
  return values;
}

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
      throw Error(ErrorCode::InvalidInput,
        "the point array 'Constraint' of " + name + " is " + std::to_string(kind) + " at point " +
          std::to_string(index) +
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

/// A data set of a port, as it is called in messages.
struct PointInput
{
  vtkPointSet* Points;
  std::string Name;
};

std::vector<PointInput> PointInputsOf(vtkInformationVector* inputs, int port)
{
  const int count = inputs->GetNumberOfInformationObjects();
  std::vector<PointInput> found;
  for (int index = 0; index < count; ++index)
  {
    if (vtkPointSet* const points = vtkPointSet::GetData(inputs, index))
    {
      found.push_back({ points,
        "the point set" + (count > 1 ? " " + std::to_string(index + 1) : std::string()) +
          "{ on port " + std::to_string(port) + "}" });
    }
  }
  return found;
}

/// A point of an organ that is given by its number.
struct NumberedConstraint
{
  double Organ;
  PointConstraint Constraint;
  std::string Name; // of the data set
  vtkIdType Point;
};

[[noreturn]] void RefuseOrgan(const NumberedConstraint& point)
{
  throw Error(ErrorCode::InvalidInput,
    "the point array 'Organ' of " + point.Name + " is " + std::to_string(point.Organ) +
      " at point " + std::to_string(point.Point) + "; organs are numbered from 1, without gaps");
}

void AddByName(vtkStringArray* names, const ConstraintList& constraints,
  std::vector<NamedOrgan>& organs)
{
  for (std::size_t index = 0; index < constraints.size(); ++index)
  {
    const std::string name = names->GetValue(static_cast<vtkIdType>(index));
    auto organ = std::find_if(organs.begin(), organs.end(),
      [&name](const NamedOrgan& candidate) { return candidate.Name == name; });
    if (organ == organs.end())
    {
      organ = organs.insert(organ, { name, {} });
    }
    organ->Constraints.push_back(constraints[index]);
  }
}

void AddByNumber(std::vector<NumberedConstraint> numbered, std::vector<NamedOrgan>& organs)
{
  // So that an organ that is missing is found, whichever point comes first.
  std::stable_sort(numbered.begin(), numbered.end(),
    [](const auto& a, const auto& b) { return a.Organ < b.Organ; });
  for (const NumberedConstraint& point : numbered)
  {
    const double next = static_cast<double>(organs.size()) + 1;
    if (point.Organ > next)
    {
      RefuseOrgan(point);
    }
    if (point.Organ == next)
    {
      organs.push_back({ "organ " + std::to_string(organs.size() + 1), {} });
    }
    organs[static_cast<std::size_t>(point.Organ) - 1].Constraints.push_back(point.Constraint);
  }
}

} // namespace

ConstraintList ConstraintsOf(vtkInformationVector* inputs, int port)
{
  ConstraintList constraints;
  for (const PointInput& input : PointInputsOf(inputs, port))
  {
    const ConstraintList more = ConstraintsOf(input.Points, input.Name);
    constraints.insert(constraints.end(), more.begin(), more.end());
  }
  return constraints;
}

void AddConstraintsOf(vtkInformationVector* inputs, int port, std::vector<NamedOrgan>& organs)
{
  std::vector<NumberedConstraint> numbered;
  for (const PointInput& input : PointInputsOf(inputs, port))
  {
    const ConstraintList constraints = ConstraintsOf(input.Points, input.Name);
    if (constraints.empty())
    {
      continue;
    }
    auto* const names =
      vtkStringArray::SafeDownCast(input.Points->GetPointData()->GetAbstractArray("Organ"));
    if (names)
    {
      RequireForm(input.Points, names, input.Name);
      AddByName(names, constraints, organs);
      continue;
    }
    vtkDataArray* const numbers = ArrayOf(input.Points, "Organ", input.Name,
      "the name of each point's organ, or its number, from 1");
    for (std::size_t index = 0; index < constraints.size(); ++index)
    {
      const auto point = static_cast<vtkIdType>(index);
      numbered.push_back({ numbers->GetTuple1(point), constraints[index], input.Name, point });
      const double number = numbered.back().Organ;
      if (!(number >= 1 && number == std::floor(number)))
      {
        RefuseOrgan(numbered.back());
      }
    }
  }
  AddByNumber(std::move(numbered), organs);
}

} // namespace FlipFree
