/**
 * Private to the modules, never installed: the numbers that travel with an image from stage to
 * stage as field data.
 */
#ifndef FlipFreeFieldData_h
#define FlipFreeFieldData_h

#include "Error.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <string>
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

inline void AddFieldText(const char* name, const std::vector<std::string>& texts,
  vtkDataObject* data)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->GetFieldData()->AddArray(array);
}

/// The values of a field array of numbers; empty where there is none. Throws Error, naming the data
/// object by `owner`, unless they are `size` finite numbers, not negative if asked.
inline std::vector<double> FieldValues(const std::string& name, vtkIdType size, bool negative,
  vtkDataObject* data, const std::string& owner)
{
  std::vector<double> values;
  vtkDataArray* array = data->GetFieldData()->GetArray(name.c_str());
  if (!array)
  {
    return values;
  }
  bool valid = array->GetNumberOfValues() == size;
  for (vtkIdType i = 0; valid && i < size; ++i)
  {
    values.push_back(array->GetVariantValue(i).ToDouble());
    valid = std::isfinite(values.back()) && (negative || values.back() >= 0);
  }
  if (!valid)
  {
    throw Error(ErrorCode::InvalidInput,
      "the field array " + name + " of " + owner + " must hold " +
        (size == 1 ? "one finite number" : std::to_string(size) + " finite numbers") +
        (negative ? "" : ", not negative") +
        "; remove it, or take it from the filter that makes it");
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
