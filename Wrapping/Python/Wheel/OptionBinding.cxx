// The options of the command, which are those of the toolkit's.
#include "Bindings.h"

#include "OptionTable.h"

namespace FlipFree
{
namespace
{

nanobind::list ListOf(const std::vector<Command::OptionEntry>& options)
{
  nanobind::list list;
  for (const Command::OptionEntry& option : options)
  {
    nanobind::dict entry;
    entry["names"] = option.Names;
    entry["values"] = option.Values;
    entry["choices"] = option.Choices;
    entry["description"] = option.Description;
    entry["default"] = option.Default;
    entry["group"] = option.Group;
    entry["required"] = option.Required;
    entry["repeats"] = option.Repeats;
    list.append(entry);
  }
  return list;
}

nanobind::list Commands()
{
  nanobind::list list;
  for (const Command::CommandEntry& command : Command::OptionTable())
  {
    nanobind::dict entry;
    entry["name"] = command.Name;
    entry["description"] = command.Description;
    entry["footer"] = command.Footer;
    entry["positionals"] = ListOf(command.Positionals);
    entry["options"] = ListOf(command.Options);
    list.append(entry);
  }
  return list;
}

} // namespace

void BindOptions(nanobind::module_& module)
{
  module.def("commands", &Commands);
}

} // namespace FlipFree
