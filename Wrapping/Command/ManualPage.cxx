#include "Generate.h"
#include "OptionTable.h"

#include <sstream>

namespace Command
{
namespace
{

/// Escapes text for roff: no line becomes a request, and dashes stay dashes.
std::string Roff(const std::string& text)
{
  std::string roff;
  for (const char letter : text)
  {
    const bool isFirst = roff.empty() || roff.back() == '\n';
    if (isFirst && (letter == '.' || letter == '\''))
    {
      roff += "\\&";
    }
    if (letter == '\\')
    {
      roff += "\\e";
    }
    else if (letter == '-')
    {
      roff += "\\-";
    }
    else
    {
      roff += letter;
    }
  }
  return roff;
}

std::string Sentence(const std::string& text)
{
  return text.empty() || text.back() == '.' ? text : text + ".";
}

/// The footer of --help: paragraphs, and examples that keep their line breaks.
void AddFooter(std::ostringstream& page, const std::string& footer)
{
  std::istringstream lines(footer);
  bool isExample = false;
  bool isNewParagraph = true;
  for (std::string line; std::getline(lines, line);)
  {
    const bool isIndented = line.compare(0, 2, "  ") == 0;
    if (isIndented != isExample)
    {
      page << (isIndented ? ".EX\n" : ".EE\n");
      isExample = isIndented;
    }
    if (line.empty())
    {
      isNewParagraph = true;
      continue;
    }
    if (isNewParagraph)
    {
      page << ".PP\n";
      isNewParagraph = false;
    }
    page << Roff(line) << '\n';
  }
  if (isExample)
  {
    page << ".EE\n";
  }
}

void AddOption(std::ostringstream& page, const OptionEntry& option)
{
  page << ".TP\n";
  for (std::size_t name = 0; name < option.Names.size(); ++name)
  {
    page << (name == 0 ? "" : ", ") << "\\fB" << Roff(option.Names[name]) << "\\fR";
  }
  for (const std::string& value : option.Values)
  {
    page << (option.Names.empty() ? "" : " ") << "\\fI" << Roff(value) << "\\fR";
  }
  page << '\n' << Roff(Sentence(option.Description));
  if (!option.Default.empty())
  {
    page << " Default: \\fB" << Roff(option.Default) << "\\fR";
  }
  if (option.Required && !option.Names.empty())
  {
    page << " Required.";
  }
  page << '\n';
}

void AddOptions(std::ostringstream& page, const CommandEntry& command)
{
  for (const OptionEntry& option : command.Positionals)
  {
    AddOption(page, option);
  }
  std::string group = command.Options.empty() ? "" : command.Options.front().Group;
  for (const OptionEntry& option : command.Options)
  {
    if (option.Group != group)
    {
      group = option.Group;
      page << ".PP\n\\fI" << Roff(group) << "\\fR\n";
    }
    AddOption(page, option);
  }
}

std::string Usage(const std::string& program, const CommandEntry& command)
{
  std::string usage = "\\fB" + program + " " + Roff(command.Name) + "\\fR";
  for (const OptionEntry& option : command.Positionals)
  {
    usage += " \\fI" + Roff(option.Values.front()) + "\\fR";
  }
  return usage + " [\\fIoptions\\fR]";
}

} // namespace

std::string ManualPage(const std::vector<CommandEntry>& table, const std::string& version)
{
  const CommandEntry& program = table.front();
  std::ostringstream page;
  page << R"(.TH FLIPFREE 1 "" ")" << Roff(version) << R"(" "User Commands")"
       << "\n.SH NAME\n"
       << program.Name << " \\- segment soft organs in CT and MR volumes\n"
       << ".SH SYNOPSIS\n";
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    page << (command == 1 ? "" : ".br\n") << Usage(program.Name, table[command]) << '\n';
  }
  page << ".SH DESCRIPTION\n" << Roff(program.Description) << '\n';
  AddFooter(page, program.Footer);
  page << ".SH OPTIONS\n";
  AddOptions(page, program);
  page << ".SH SUBCOMMANDS\n";
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    page << ".SS " << Usage(program.Name, table[command]) << '\n'
         << Roff(Sentence(table[command].Description)) << '\n';
    AddOptions(page, table[command]);
    AddFooter(page, table[command].Footer);
  }
  return page.str();
}

} // namespace Command
