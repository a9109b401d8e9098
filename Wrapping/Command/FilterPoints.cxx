#include "FilterPoints.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"

namespace Command
{
namespace
{

using FlipFree::ConstraintKind;

/// False for a seed.
template <typename Filter>
bool AddPoint(const CorrectionPoint& point, Filter* filter)
{
  const auto& [x, y, z] = point.Place;
  switch (point.Kind)
  {
    case ConstraintKind::Outside:
      filter->AddOutsidePoint(x, y, z);
      return true;
    case ConstraintKind::Inside:
      filter->AddInsidePoint(x, y, z);
      return true;
    case ConstraintKind::Boundary:
      filter->AddBoundaryPoint(x, y, z);
      return true;
    case ConstraintKind::Seed:
      break;
  }
  return false;
}

} // namespace

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeSegmentation* filter)
{
  for (const CorrectionPoint& point : points)
  {
    if (!AddPoint(point, filter))
    {
      const auto& [x, y, z] = point.Place;
      filter->AddSeed(x, y, z, point.Radius);
    }
  }
}

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeVesselSegmentation* filter)
{
  for (const CorrectionPoint& point : points)
  {
    AddPoint(point, filter);
  }
}

} // namespace Command
