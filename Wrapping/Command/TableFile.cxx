#include "TableFile.h"

#include "OutputFile.h"
#include "Run.h"

#include "vtkDelimitedTextWriter.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <cstring>
#include <memory>

namespace Command
{

void WriteTable(const std::string& name, vtkTable* table)
{
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(table);
  writer->WriteToOutputStringOn();
  Run(writer, "writing", {}, [&writer]() { writer->Write(); });
  const std::unique_ptr<char[]> text(writer->RegisterAndGetOutputString());
  WriteBytes(name, text.get(), std::strlen(text.get()));
}

} // namespace Command
