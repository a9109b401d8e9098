#include "LabelNames.h"

#include "Failure.h"
#include "FieldData.h"
#include "UnreadableFile.h"

#include "vtkImageData.h"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace Command
{
namespace
{

const char* const Blanks = " \t\r";

std::string Trimmed(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(Blanks);
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(Blanks) - begin + 1);
}

std::string Unquoted(const std::string& text)
{
  const bool isQuoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return isQuoted ? text.substr(1, text.size() - 2) : text;
}

} // namespace

void NameLabels(const std::string& file, vtkImageData* labels)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw UnreadableFile(file);
  }
  std::vector<double> values;
  std::vector<std::string> names;
  std::string line;
  while (std::getline(stream, line))
  {
    line = Unquoted(Trimmed(line));
    char* end = nullptr;
    const long label = std::strtol(line.c_str(), &end, 10);
    std::string rest = Trimmed(end);
    if (end == line.c_str() || rest.empty())
    {
      continue;
    }
    if (rest.front() == ',' || rest.front() == ';')
    {
      rest = Trimmed(rest.substr(1));
    }
    const std::string name = Unquoted(rest);
    if (label < 0 || label > INT_MAX || name.empty())
    {
      std::ostringstream text;
      text << "'" << file << "' has the line '" << line
           << "', which is not a label and its name. Give lines such as '5,liver'.";
      throw Failure(text.str());
    }
    values.push_back(static_cast<double>(label));
    names.push_back(name);
  }
  if (names.empty())
  {
    throw Failure("'" + file + "' names no labels. Give lines such as '5,liver'.");
  }
  FlipFree::AddFieldValues("SegmentLabels", values, labels);
  FlipFree::AddFieldText("SegmentNames", names, labels);
}

std::string FileNamePart(const std::string& name)
{
  std::string part = name;
  std::replace_if(
    part.begin(), part.end(),
    [](char letter)
    {
      const auto code = static_cast<unsigned char>(letter);
      return code < 0x80 && !std::isalnum(code) && letter != '.' && letter != '-';
    },
    '_');
  return part;
}

} // namespace Command
