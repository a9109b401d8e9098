/**
 * Private to the module: the numbers that travel with an image from stage to stage as field data.
 */
#ifndef FlipFreeFieldData_h
#define FlipFreeFieldData_h

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <vector>

namespace FlipFree
{

inline void AddFieldValues(const char* name, const std::vector<double>& values, vtkDataObject* data)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (double value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetFieldData()->AddArray(array);
}

/// The values of a field array of doubles; empty where there is none.
inline std::vector<double> FieldValues(const char* name, vtkDataObject* data)
{
  std::vector<double> values;
  auto* array = vtkDoubleArray::SafeDownCast(data->GetFieldData()->GetArray(name));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    values.push_back(array->GetValue(i));
  }
  return values;
}

inline void SetFloatScalars(const char* name, const std::vector<float>& values, vtkImageData* image)
{
  vtkNew<vtkFloatArray> scalars;
  scalars->SetName(name);
  scalars->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), scalars->GetPointer(0));
  image->GetPointData()->SetScalars(scalars);
}

} // namespace FlipFree

#endif
