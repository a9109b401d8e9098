/**
 * Tells the parser of the options that stand in the table (OptionTable.h): what they are called,
 * take and mean, and where their values go.
 */
#ifndef FlipFreeCommandOptions_h
#define FlipFreeCommandOptions_h

#include "OptionTable.h"
#include "ParameterTable.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace Command
{

/// The subcommand of that name, without its options.
CLI::App* AddCommand(CLI::App& program, const std::string& name);

/// The names as CLI11 takes them.
std::string ParserNames(const OptionEntry& entry);

/// What the table says about an option, but for its names and its default.
CLI::Option* Describe(CLI::Option* option, const OptionEntry& entry);

/// An option of the command, by one of its names. The value becomes the default, if that is one.
template <typename T>
CLI::Option* AddOption(CLI::App& command, const std::string& name, T& value)
{
  const OptionEntry& entry = EntryOf(command.get_name(), name);
  if constexpr (std::is_same_v<T, bool>)
  {
    return Describe(command.add_flag(ParserNames(entry), value, entry.Description), entry);
  }
  else
  {
    CLI::Option* option =
      Describe(command.add_option(ParserNames(entry), value, entry.Description), entry);
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
    {
      if (!entry.Default.empty() && !CLI::detail::lexical_cast(entry.Default, value))
      {
        throw std::logic_error("the default of " + name + " is no value: " + entry.Default);
      }
    }
    return option;
  }
}

void AddThreadsOption(CLI::App& command, int& threads);

/// Calls `keep` with the numbers that an option is given: for a switch, which is Boolean, 1 or 0.
void AddNumbers(CLI::App& command, const OptionEntry& entry, FlipFree::ParameterType type,
  const std::function<void(const std::vector<double>&)>& keep);

/// Throws WrongUsage: the value is not in the parameter's range.
[[noreturn]] void RefuseNumber(const std::string& parameter, double value, double minimum,
  double maximum);

/// Parameters that users have given, as options or otherwise.
template <typename Settings>
class GivenParameters
{
public:
  using Parameter = FlipFree::Parameter<Settings>;

  /// The parameters of the table that are options of the command and have not been added yet. This
  /// object has to outlive them.
  void AddOptions(CLI::App& command, const FlipFree::ParameterTable<Settings>& table)
  {
    for (const OptionEntry& entry : EntryOf(command.get_name()).Options)
    {
      for (const Parameter& parameter : table)
      {
        if (entry.Names.front() == OptionsOf(parameter.Name).front() &&
          !command.get_option_no_throw(entry.Names.front()))
        {
          AddNumbers(command, entry, parameter.Type,
            [this, &parameter](const std::vector<double>& values)
            { this->Give(parameter, values); });
        }
      }
    }
  }

  /// The later one counts. The parameter has to outlive this object.
  void Give(const Parameter& parameter, const std::vector<double>& values)
  {
    this->Given.push_back({ &parameter, values });
  }

  void Give(const GivenParameters& others)
  {
    this->Given.insert(this->Given.end(), others.Given.begin(), others.Given.end());
  }

  struct Value
  {
    const Parameter* Of;
    std::vector<double> Numbers;
  };

  /// In the order in which they were given.
  const std::vector<Value>& Values() const { return this->Given; }

  /// Throws WrongUsage for a value out of range; in other words if `refuse` has some.
  void Apply(Settings& settings,
    const std::function<void(const Parameter&, double)>& refuse = {}) const
  {
    for (const auto& [parameter, values] : this->Given)
    {
      if (!parameter->Take(settings, values))
      {
        if (refuse)
        {
          refuse(*parameter, values.front());
        }
        RefuseNumber(parameter->Name, values.front(), parameter->Minimum, parameter->Maximum);
      }
    }
  }

private:
  std::vector<Value> Given;
};

} // namespace Command

#endif
