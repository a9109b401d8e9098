#include "Generate.h"
#include "OptionTable.h"

#include <sstream>

namespace Command
{
namespace
{

std::string NamesOf(const CommandEntry& command)
{
  std::string names;
  for (const OptionEntry& option : command.Options)
  {
    names += (names.empty() ? "" : " ") + Joined(option.Names, " ");
  }
  return names;
}

std::string SubcommandsOf(const std::vector<CommandEntry>& table)
{
  std::string names;
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    names += (command == 1 ? "" : " ") + table[command].Name;
  }
  return names;
}

bool IsFile(const OptionEntry& option)
{
  return option.Values.size() == 1 && option.Choices.empty() &&
    (option.Names.empty() || option.Values[0] == "FILE");
}

bool IsFolder(const OptionEntry& option)
{
  return option.Values.size() == 1 && option.Values[0] == "DIR";
}

/// The arguments of bash's compgen for a value; empty for a number.
std::string BashWords(const OptionEntry& option)
{
  if (!option.Choices.empty())
  {
    return "-W '" + Joined(option.Choices, " ") + "'";
  }
  return IsFile(option) ? "-f" : IsFolder(option) ? "-d" : "";
}

/// Cases that tell subcommands, and options whose values follow.
void AddBashOptions(std::ostringstream& script, const std::vector<CommandEntry>& table)
{
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    script << "      :" << table[command].Name << ") command=" << table[command].Name << " ;;\n";
    for (const OptionEntry& option : table[command].Options)
    {
      if (!option.Values.empty())
      {
        std::string pattern;
        for (const std::string& name : option.Names)
        {
          pattern += (pattern.empty() ? "" : " | ") + table[command].Name + ":" + name;
        }
        script << "      " << pattern << ") left=" << option.Values.size() << " values=\""
               << BashWords(option) << "\" ;;\n";
      }
    }
  }
}

/// Cases that list the options and positionals of a subcommand, and what there is before one.
void AddBashWords(std::ostringstream& script, const std::vector<CommandEntry>& table)
{
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    script << "    " << table[command].Name << ")\n      options='" << NamesOf(table[command])
           << "'\n      positionals=(";
    const char* separator = "";
    for (const OptionEntry& option : table[command].Positionals)
    {
      script << separator << '"' << BashWords(option) << '"';
      separator = " ";
    }
    script << ")\n      ;;\n";
  }
  script << "    *)\n      options='" << NamesOf(table.front()) << "'\n      positionals=(\"-W '"
         << SubcommandsOf(table)
         << "'\")\n"
            "      given=0\n"
            "      ;;\n";
}

/// Escapes text for single quotes, within which _arguments interprets brackets and colons.
std::string ZshText(const std::string& text)
{
  std::string quoted;
  for (const char letter : text)
  {
    if (letter == '\'')
    {
      quoted += "'\\''";
      continue;
    }
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
    {
      quoted += '\\';
    }
    quoted += letter;
  }
  return quoted;
}

std::string ZshValues(const OptionEntry& option)
{
  const std::string action = !option.Choices.empty() ? "(" + Joined(option.Choices, " ") + ")"
    : IsFile(option)                                 ? "_files"
    : IsFolder(option)                               ? "_files -/"
                                                     : " ";
  std::string values;
  for (const std::string& value : option.Values)
  {
    values += ":" + ZshText(value) + ":" + action;
  }
  return values;
}

void AddZshOptions(std::ostringstream& script, const CommandEntry& command, const char* indent)
{
  for (const OptionEntry& option : command.Options)
  {
    for (const std::string& name : option.Names)
    {
      script << " \\\n"
             << indent << "'(" << Joined(option.Names, " ") << ")" << name << "["
             << ZshText(option.Description) << "]" << ZshValues(option) << "'";
    }
  }
}

} // namespace

std::string BashCompletion(const std::vector<CommandEntry>& table)
{
  std::ostringstream script;
  script << "# Completion of flipfree for bash.\n"
            "_flipfree()\n"
            "{\n"
            "  local current=${COMP_WORDS[COMP_CWORD]}\n"
            "  local command='' values='' left=0 given=0 word options positionals\n"
            "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
            "    if ((left > 0)); then\n"
            "      left=$((left - 1))\n"
            "      continue\n"
            "    fi\n"
            "    values=''\n"
            "    case $command:$word in\n";
  AddBashOptions(script, table);
  script << "      *:-*) ;;\n"
            "      *) given=$((given + 1)) ;;\n"
            "    esac\n"
            "  done\n"
            "  case $command in\n";
  AddBashWords(script, table);
  script << "  esac\n"
            "  COMPREPLY=()\n"
            "  if ((left == 0)); then\n"
            "    if [[ $current == -* || -z ${positionals[given]:-} ]]; then\n"
            "      mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
            "      return\n"
            "    fi\n"
            "    values=${positionals[given]}\n"
            "  fi\n"
            "  if [[ -n $values ]]; then\n"
            "    [[ $values == -W* ]] || compopt -o filenames 2>/dev/null\n"
            "    mapfile -t COMPREPLY < <(eval \"compgen $values\" -- '\"$current\"')\n"
            "  fi\n"
            "}\n"
            "complete -F _flipfree flipfree\n";
  return script.str();
}

std::string ZshCompletion(const std::vector<CommandEntry>& table)
{
  std::ostringstream script;
  script << "#compdef flipfree\n"
            "# Completion of flipfree for zsh.\n"
            "_flipfree()\n"
            "{\n"
            "  local curcontext=$curcontext state line\n"
            "  local -a commands=(";
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    script << "\n    '" << table[command].Name << ":" << ZshText(table[command].Description) << "'";
  }
  script << ")\n"
            "  _arguments -C";
  AddZshOptions(script, table.front(), "    ");
  script << " \\\n"
            "    '1:command:->command' '*::argument:->argument'\n"
            "  case $state in\n"
            "    command) _describe command commands ;;\n"
            "    argument)\n"
            "      case $line[1] in\n";
  for (std::size_t command = 1; command < table.size(); ++command)
  {
    script << "        " << table[command].Name << ")\n          _arguments";
    AddZshOptions(script, table[command], "            ");
    for (std::size_t place = 0; place < table[command].Positionals.size(); ++place)
    {
      script << " \\\n            '" << place + 1 << ZshValues(table[command].Positionals[place])
             << "'";
    }
    script << "\n          ;;\n";
  }
  script << "      esac\n"
            "      ;;\n"
            "  esac\n"
            "}\n"
            "if [[ $funcstack[1] == _flipfree ]]; then\n"
            "  _flipfree \"$@\"\n"
            "else\n"
            "  compdef _flipfree flipfree\n"
            "fi\n";
  return script.str();
}

} // namespace Command
