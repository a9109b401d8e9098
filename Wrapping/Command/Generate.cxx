#include "Generate.h"

#include "OptionTable.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace Command
{

void AddGenerateOption(CLI::App& program)
{
  const auto print = [&program](const std::string& what)
  {
    const std::vector<CommandEntry>& table = OptionTable();
    std::cout << (what == "man" ? ManualPage(table, program.version())
        : what == "bash"        ? BashCompletion(table)
                                : ZshCompletion(table));
    throw CLI::Success();
  };
  program.add_option_function<std::string>("--generate", print)
    ->check(CLI::IsMember({ "man", "bash", "zsh" }))
    ->trigger_on_parse()
    ->group("");
}

} // namespace Command
