#include "LabelNames.h"

#include "Failure.h"
#include "FieldData.h"
#include "TextFile.h"

#include "Exchange/FileProblem.h"
#include "Exchange/LabelNameTable.h"

#include "vtkImageData.h"

#include <vector>

namespace Command
{

void NameLabels(const std::string& file, vtkImageData* labels)
{
  std::vector<double> values;
  std::vector<std::string> names;
  try
  {
    for (const auto& [label, name] : FlipFree::ReadLabelNameTable(file, ReadText(file)))
    {
      values.push_back(label);
      names.push_back(name);
    }
  }
  catch (const FlipFree::FileProblem& problem)
  {
    throw Failure(problem.what());
  }
  FlipFree::AddFieldValues("SegmentLabels", values, labels);
  FlipFree::AddFieldText("SegmentNames", names, labels);
}

} // namespace Command
