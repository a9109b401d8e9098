#include "CommonOptions.h"

#include "VolumeFile.h"

#include <CLI/CLI.hpp>

namespace Command
{

void AddConvergenceOption(CLI::App& command, std::string& file)
{
  command.add_option("--convergence", file, "Table of the iterations (.csv)")->type_name("FILE");
}

void AddSnapshotOption(CLI::App& command, std::string& file)
{
  command.add_option("--snapshot", file, "Picture of the result (.png)")->type_name("FILE");
}

void AddSaveSessionOption(CLI::App& command, std::string& file)
{
  command
    .add_option("--save-session", file,
      "Where the result comes from (.json): version, image, seeds, points and parameters. "
      "'flipfree "
      "segment --session' repeats it")
    ->type_name("FILE");
}

CLI::Option* AddLabelOption(CLI::App& command, const std::string& name, std::string& label,
  const std::string& description)
{
  return command.add_option(name, label, description)
    ->type_name("LABEL")
    ->check(
      [](const std::string& text)
      {
        return IsLabel(text) ? std::string()
                             : "'" + text +
            "' is no label: give a segment's name, or a whole number "
            "from 0 on";
      });
}

void AddThreadsOption(CLI::App& command, int& threads)
{
  command.add_option("--threads", threads, "Number of threads; 0: all available")
    ->type_name("N")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
}

void AddQuietOption(CLI::App& command, bool& quiet)
{
  command.add_flag("-q,--quiet", quiet, "Print nothing but errors and warnings");
}

} // namespace Command
