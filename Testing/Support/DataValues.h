/**
 * The numbers in VTK's objects, as vectors, which tests compare and print.
 */
#ifndef FlipFreeDataValues_h
#define FlipFreeDataValues_h

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <vector>

namespace FlipFree
{

inline std::vector<double> ValuesOf(vtkDataArray* array)
{
  std::vector<double> values;
  const int components = array ? array->GetNumberOfComponents() : 1;
  for (vtkIdType value = 0; array && value < array->GetNumberOfValues(); ++value)
  {
    const auto component = static_cast<int>(value % components);
    values.push_back(array->GetComponent(value / components, component));
  }
  return values;
}

/// Of its voxels; none where it has no scalars.
inline std::vector<double> ValuesOf(vtkImageData* image)
{
  return ValuesOf(image->GetPointData()->GetScalars());
}

/// Of its points, one coordinate after the other.
inline std::vector<double> PointsOf(vtkPolyData* surface)
{
  return ValuesOf(surface->GetPoints() ? surface->GetPoints()->GetData() : nullptr);
}

} // namespace FlipFree

#endif
