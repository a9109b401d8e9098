#include "Generate.h"
#include "OptionTable.h"

#include <sstream>

namespace Command
{
namespace
{

std::string Quoted(const std::string& text)
{
  std::string quoted = "\"";
  for (const char letter : text)
  {
    if (letter == '\n')
    {
      quoted += "\\n";
      continue;
    }
    if (letter == '"' || letter == '\\')
    {
      quoted += '\\';
    }
    quoted += letter;
  }
  return quoted + '"';
}

std::string Quoted(const std::vector<std::string>& texts)
{
  std::string list;
  for (const std::string& text : texts)
  {
    list += (list.empty() ? "" : ", ") + Quoted(text);
  }
  return "[" + list + "]";
}

std::string TextOf(const OptionEntry& entry, const std::string& indent)
{
  std::ostringstream text;
  text << indent << "{\n"
       << indent << "  \"names\": " << Quoted(entry.Names) << ",\n"
       << indent << "  \"values\": " << Quoted(entry.Values) << ",\n"
       << indent << "  \"choices\": " << Quoted(entry.Choices) << ",\n"
       << indent << "  \"description\": " << Quoted(entry.Description) << ",\n"
       << indent << "  \"default\": " << Quoted(entry.Default) << ",\n"
       << indent << "  \"group\": " << Quoted(entry.Group) << ",\n"
       << indent << "  \"required\": " << (entry.Required ? "true" : "false") << "\n"
       << indent << "}";
  return text.str();
}

std::string TextOf(const std::vector<OptionEntry>& entries, const std::string& indent)
{
  std::string list;
  for (const OptionEntry& entry : entries)
  {
    list += (list.empty() ? "\n" : ",\n") + TextOf(entry, indent + "  ");
  }
  return list.empty() ? "[]" : "[" + list + "\n" + indent + "]";
}

} // namespace

std::string OptionJson(const std::vector<CommandEntry>& table)
{
  std::string list;
  for (const CommandEntry& entry : table)
  {
    std::ostringstream text;
    text << "  {\n    \"name\": " << Quoted(entry.Name) << ",\n"
         << "    \"description\": " << Quoted(entry.Description) << ",\n"
         << "    \"footer\": " << Quoted(entry.Footer) << ",\n"
         << "    \"positionals\": " << TextOf(entry.Positionals, "    ") << ",\n"
         << "    \"options\": " << TextOf(entry.Options, "    ") << "\n  }";
    list += (list.empty() ? "" : ",\n") + text.str();
  }
  return "[\n" + list + "\n]\n";
}

} // namespace Command
