#include "Exchange/PolygonFile.h"

#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"

namespace FlipFree
{

CheckedPolygons ReadPolygonFile(const std::string& name, const std::string& bytes)
{
  const std::string extension = ExtensionOf(name);
  try
  {
    return extension == ".ply" ? ReadPly(bytes)
      : extension == ".stl"    ? ReadStl(bytes)
                               : ReadObj(bytes);
  }
  catch (const FileProblem& fault)
  {
    throw FileProblem(FileProblem::Kind::Unusable, DamagedSurface(name, fault.what()));
  }
}

std::string DamagedSurface(const std::string& name, const std::string& fault)
{
  return InQuotes(name) + " cannot be read: it is damaged or its format does not match its " +
    "extension (" + fault + "). Check its extension, or create it again.";
}

} // namespace FlipFree
