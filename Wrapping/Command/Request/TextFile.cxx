#include "TextFile.h"

#include "Failure.h"
#include "UnreadableFile.h"

#include "TextWords.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace Command
{

std::string ReadBytes(const std::string& name)
{
  const std::ifstream file(name, std::ios::binary);
  std::ostringstream content;
  std::error_code ignored;
  const bool isFile = file && !std::filesystem::is_directory(name, ignored);
  if (isFile)
  {
    content << file.rdbuf();
  }
  if (!isFile || content.bad())
  {
    throw UnreadableFile(name);
  }
  return content.str();
}

std::string ReadText(const std::string& name)
{
  const std::string text = ReadBytes(name);
  if (!FlipFree::IsUtf8(text) || text.find('\0') != std::string::npos)
  {
    throw Failure("'" + name + "' is not UTF-8 text. Save it as UTF-8.");
  }
  return text.rfind("\xEF\xBB\xBF", 0) == 0 ? text.substr(3) : text;
}

} // namespace Command
