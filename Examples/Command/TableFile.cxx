#include "TableFile.h"

#include "OutputFile.h"
#include "Run.h"

#include "vtkDelimitedTextWriter.h"
#include "vtkNew.h"
#include "vtkTable.h"

namespace Command
{

void WriteTable(const std::string& name, vtkTable* table)
{
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(table);
  writer->WriteToOutputStringOn();
  Run(writer, "writing", [&writer]() { writer->Write(); });
  const std::string text = writer->GetOutputString();
  WriteBytes(name, text.data(), text.size());
}

} // namespace Command
