#include "Exchange/LabelNameTable.h"

#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"
#include "Exchange/TableText.h"
#include "TextWords.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

namespace FlipFree
{
namespace
{

using LabelCells = std::vector<std::string>;

/// Empty lines in place of comments, so that lines keep their numbers.
std::string WithoutComments(const std::string& text)
{
  const char end = text.find('\n') == std::string::npos ? '\r' : '\n';
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line, end);)
  {
    rest += (Trimmed(line).rfind('#', 0) == 0 ? "" : line) + end;
  }
  return rest;
}

std::optional<int> LabelOfCell(const std::string& cell)
{
  double number = -1;
  const bool isLabel = AreDecimals(cell) && ToNumber(cell, number) && number >= 0 &&
    number <= INT_MAX && number == std::floor(number);
  return isLabel ? std::optional<int>(static_cast<int>(number)) : std::nullopt;
}

/// A name that blanks separate from its label and from its color: `5 liver 221 130 101 255`, or, in
/// quotes, after it.
std::string NameAmong(const std::string& text)
{
  const std::size_t open = text.find('"');
  const std::size_t close = text.rfind('"');
  if (open < close)
  {
    return text.substr(open + 1, close - open - 1);
  }
  const std::vector<std::string> words = Words(text);
  const auto isNumber = [](const std::string& word) { return AreDecimals(word); };
  const auto last = std::find_if_not(words.rbegin(), words.rend(), isNumber);
  const auto numbers = last - words.rbegin();
  if (last == words.rend() || numbers < 3 || numbers > 4) // red, green, blue, and an opacity
  {
    return Trimmed(text);
  }
  std::string name;
  std::for_each(words.begin(), last.base(),
    [&name](const std::string& word) { name += (name.empty() ? "" : " ") + word; });
  return name;
}

class LabelNameReader
{
public:
  explicit LabelNameReader(const std::string& name)
    : Name(name)
  {
  }

  std::map<int, std::string> Read(const std::string& text)
  {
    const TableText table = ReadTableText(this->Name, WithoutComments(text));
    for (const TableLine& line : table.Lines)
    {
      const bool isHeader = &line == &table.Lines.front() && !this->IsEntry(line.Cells);
      isHeader ? this->TakeHeader(line.Cells) : this->TakeEntry(line);
    }
    if (this->Names.empty())
    {
      throw FileProblem(FileProblem::Kind::Unusable,
        InQuotes(this->Name) + " names no labels. Give lines such as '5,liver'.");
    }
    return std::move(this->Names);
  }

private:
  /// A label, and further cells or words.
  bool IsEntry(const LabelCells& cells) const
  {
    const std::size_t end = cells.front().find_first_of(" \t;");
    return LabelOfCell(cells.front().substr(0, end)).has_value();
  }

  void TakeHeader(const LabelCells& cells)
  {
    const auto columnOf = [&cells](const std::vector<std::string>& names, std::size_t otherwise)
    {
      const auto found = std::find_if(cells.begin(), cells.end(),
        [&names](const std::string& cell)
        { return std::count(names.begin(), names.end(), InSmallLetters(cell)) > 0; });
      return found == cells.end() ? otherwise : static_cast<std::size_t>(found - cells.begin());
    };
    this->HasHeader = true;
    this->LabelColumn = columnOf({ "label", "index", "value", "labelvalue", "id" }, 0);
    this->NameColumn = columnOf({ "name" }, this->LabelColumn == 0 ? 1 : 0);
  }

  void TakeEntry(const TableLine& line)
  {
    const LabelCells cells = this->PairOf(line.Cells);
    const std::optional<int> label = LabelOfCell(cells[0]);
    if (!label || cells[1].empty())
    {
      this->Refuse(line, "is not a label and its name. Give lines such as '5,liver'");
    }
    const auto [known, isNew] = this->Names.emplace(*label, cells[1]);
    if (!isNew && known->second != cells[1])
    {
      this->Refuse(line,
        "names label " + std::to_string(*label) + ", which is '" + known->second +
          "' in a line before it. Leave one of them out");
    }
  }

  /// The label and the name; empty ones where the line is neither.
  LabelCells PairOf(const LabelCells& cells) const
  {
    if (cells.size() == 1)
    {
      const std::string& line = cells.front();
      const std::size_t end = std::min(line.find_first_of(" \t;"), line.size());
      return { line.substr(0, end), NameAmong(line.substr(std::min(end + 1, line.size()))) };
    }
    const auto cellAt = [&cells](std::size_t column)
    { return column < cells.size() ? cells[column] : std::string(); };
    // Without columns that say what they hold, all but colors could be parts of a name.
    const bool mayBeName = !this->HasHeader &&
      std::any_of(cells.begin() + 2, cells.end(),
        [](const std::string& cell) { return !cell.empty() && !AreDecimals(cell); });
    return mayBeName ? LabelCells(2)
                     : LabelCells{ cellAt(this->LabelColumn), cellAt(this->NameColumn) };
  }

  [[noreturn]] void Refuse(const TableLine& line, const std::string& what) const
  {
    std::string shown;
    for (const std::string& cell : line.Cells)
    {
      shown += (shown.empty() ? "" : ",") + cell;
    }
    constexpr std::size_t enough = 60;
    throw FileProblem(FileProblem::Kind::Unusable,
      InQuotes(this->Name) + ", line " + std::to_string(line.Number) + ": '" +
        TextForPeople(shown.substr(0, enough), true, false) +
        (shown.size() > enough ? "...' " : "' ") + what + ".");
  }

  const std::string& Name;
  std::map<int, std::string> Names;
  bool HasHeader = false;
  std::size_t LabelColumn = 0;
  std::size_t NameColumn = 1;
};

} // namespace

std::map<int, std::string> ReadLabelNameTable(const std::string& name, const std::string& text)
{
  return LabelNameReader(name).Read(text);
}

} // namespace FlipFree
