#include "SurfaceOrigin.h"

#include "FieldData.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <vector>

namespace Command
{
namespace
{

const char* const FieldName = "Provenance";

} // namespace

std::string ProvenanceOf(vtkPolyData* surface)
{
  auto* const text =
    vtkStringArray::SafeDownCast(surface->GetFieldData()->GetAbstractArray(FieldName));
  return text && text->GetNumberOfValues() == 1 ? text->GetValue(0) : std::string();
}

vtkSmartPointer<vtkPolyData> WithNames(vtkPolyData* surface, const OriginNames& names)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(surface);
  const std::string provenance = ProvenanceOf(surface);
  if (!provenance.empty())
  {
    vtkNew<vtkFieldData> fields; // the copy's own
    fields->ShallowCopy(surface->GetFieldData());
    copy->SetFieldData(fields);
    FlipFree::AddFieldText(FieldName, { NamedProvenance(provenance, names) }, copy);
  }
  return copy;
}

void NameSegments(vtkImageData* labels, int first, const OriginNames& names)
{
  std::vector<double> values;
  std::vector<std::string> colors;
  for (std::size_t index = 0; index < names.Organs.size(); ++index)
  {
    values.push_back(first + static_cast<double>(index));
    colors.push_back(index < names.Colors.size() ? names.Colors[index] : std::string());
  }
  FlipFree::AddFieldValues("SegmentLabels", values, labels);
  FlipFree::AddFieldText("SegmentNames", names.Organs, labels);
  FlipFree::AddFieldText("SegmentColors", colors, labels);
}

} // namespace Command
