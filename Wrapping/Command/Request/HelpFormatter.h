/**
 * Lays out --help: `--radius MM (required)`, `--levels N [3]`, and lines of at most 100 columns.
 */
#ifndef FlipFreeCommandHelpFormatter_h
#define FlipFreeCommandHelpFormatter_h

#include <CLI/CLI.hpp>

#include <sstream>

namespace Command
{

class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter() { this->column_width(Column); }

  std::string make_option_name(const CLI::Option* option, bool positional) const override
  {
    const std::string name = option->get_name(positional, true);
    return name.substr(0, name.find('{')); // the user need not know a flag's value
  }

  std::string make_option_opts(const CLI::Option* option) const override
  {
    std::string text;
    if (option->get_type_size() != 0 && !option->get_positional())
    {
      const std::string type = option->get_type_name();
      text += " " + type.substr(0, type.find(':')); // without CLI11's checks
    }
    return text;
  }

  std::string make_option_desc(const CLI::Option* option) const override
  {
    std::string text = option->get_description();
    if (!option->get_default_str().empty())
    {
      text += " [" + option->get_default_str() + "]";
    }
    if (option->get_required() && !option->get_positional())
    {
      text += " (required)";
    }
    return Wrapped(text);
  }

private:
  static constexpr int Column = 30;

  static std::string Wrapped(const std::string& text)
  {
    std::istringstream words(text);
    std::string wrapped;
    std::size_t length = 0;
    for (std::string word; words >> word; length += word.size() + 1)
    {
      if (length + word.size() > 100 - Column)
      {
        wrapped.back() = '\n'; // CLI11 indents the next line
        length = 0;
      }
      wrapped += word + " ";
    }
    wrapped.pop_back();
    return wrapped;
  }
};

} // namespace Command

#endif
