#include "Exchange/TableText.h"

#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"
#include "MessageText.h"
#include "TextWords.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace FlipFree
{
namespace
{

/// Spreadsheet programs have a Macintosh form, in which carriage returns alone end lines.
std::string WithLineFeeds(std::string text)
{
  if (text.find('\n') == std::string::npos)
  {
    std::replace(text.begin(), text.end(), '\r', '\n');
  }
  return text;
}

/// Splits text, cell by cell.
class TableParser
{
public:
  TableParser(const std::string& name, const std::string& text, std::size_t begin, int line,
    char separator)
    : Name(name)
    , Text(text)
    , At(begin)
    , Line(line)
    , Separator(separator)
  {
  }

  bool HasMore() const { return this->At < this->Text.size(); }

  /// Up to the end of the line, or of the one in which the last quote ends.
  TableLine Next()
  {
    TableLine line;
    line.Number = this->Line;
    bool goesOn = true;
    while (goesOn)
    {
      line.Cells.push_back(this->Cell());
      goesOn = this->HasMore() && this->Text[this->At] == this->Separator;
      ++this->At; // the separator, or the end of the line
    }
    ++this->Line;
    return line;
  }

private:
  std::string Cell()
  {
    this->SkipBlanks();
    std::string cell;
    if (this->HasMore() && this->Text[this->At] == '"')
    {
      cell = this->Quoted();
    }
    const std::string ends{ this->Separator, '\n' };
    const std::size_t end = std::min(this->Text.find_first_of(ends, this->At), this->Text.size());
    cell += this->Text.substr(this->At, end - this->At);
    this->At = end;
    return Trimmed(cell);
  }

  void SkipBlanks()
  {
    while (this->HasMore() && this->Text[this->At] != this->Separator &&
      (this->Text[this->At] == ' ' || this->Text[this->At] == '\t'))
    {
      ++this->At;
    }
  }

  /// What stands between quotes; two in it are one.
  std::string Quoted()
  {
    const int first = this->Line;
    std::string text;
    for (++this->At; this->HasMore(); ++this->At)
    {
      const char letter = this->Text[this->At];
      const bool isTwice = this->Text.compare(this->At, 2, "\"\"") == 0;
      if (letter == '"' && !isTwice)
      {
        ++this->At;
        return text;
      }
      this->At += isTwice ? 1 : 0;
      this->Line += letter == '\n' ? 1 : 0;
      text += letter;
    }
    throw FileProblem(FileProblem::Kind::Unusable,
      InQuotes(this->Name) + ", line " + std::to_string(first) +
        ": a cell begins with a quote that does not end.");
  }

  const std::string& Name;
  const std::string& Text;
  std::size_t At;
  int Line;
  const char Separator;
};

bool IsEmpty(const TableLine& line)
{
  return std::all_of(line.Cells.begin(), line.Cells.end(),
    [](const std::string& cell) { return cell.empty(); });
}

TableText SplitBy(char separator, const std::string& name, const std::string& text,
  std::size_t begin, int line)
{
  TableText table;
  table.Separator = separator;
  for (TableParser parser(name, text, begin, line, separator); parser.HasMore();)
  {
    TableLine next = parser.Next();
    if (!IsEmpty(next))
    {
      table.Lines.push_back(std::move(next));
    }
  }
  return table;
}

/// What a line such as `sep=;` says, which some programs write; 0 for any other line.
char SaidSeparator(std::string line)
{
  line.erase(std::remove(line.begin(), line.end(), '"'), line.end());
  const std::string start = "sep=";
  const bool says =
    line.size() > start.size() && InSmallLetters(line.substr(0, start.size())) == start;
  const char separator = says ? line[start.size()] : '\0';
  const bool isSeparator = separator == '\t' || std::ispunct(static_cast<unsigned char>(separator));
  return says && isSeparator &&
      line.find_first_not_of(" \t\r,;", start.size() + 1) == std::string::npos
    ? separator
    : '\0';
}

/// Whether a first line is parted by a separator: it has several cells, and none is left with
/// another separator at its end.
bool AreParted(const TableLine& line)
{
  const auto filled = std::count_if(line.Cells.begin(), line.Cells.end(),
    [](const std::string& cell) { return !cell.empty(); });
  return filled > 1 &&
    std::none_of(line.Cells.begin(), line.Cells.end(),
      [](const std::string& cell)
      { return !cell.empty() && (cell.back() == ',' || cell.back() == ';'); });
}

/// Neither names nor numbers have tabs or semicolons in them; numbers may have commas.
char FoundSeparator(const std::string& name, const std::string& text)
{
  for (const char separator : { '\t', ';' })
  {
    TableLine first;
    for (TableParser parser(name, text, 0, 1, separator); parser.HasMore() && IsEmpty(first);)
    {
      first = parser.Next();
    }
    if (AreParted(first))
    {
      return separator;
    }
  }
  return ',';
}

/// Whether all words are numbers whose decimal mark, if they have one, is this; and one has it.
bool HasMark(char mark, const std::string& cell)
{
  const char other = mark == ',' ? '.' : ',';
  std::string points = cell;
  std::replace(points.begin(), points.end(), ',', '.');
  return cell.find(mark) != std::string::npos && cell.find(other) == std::string::npos &&
    AreDecimals(points);
}

std::string TextOfCell(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text)
  {
    quoted.append(letter == '"' ? 2 : 1, letter);
  }
  return quoted + '"';
}

std::string TextOfCell(std::int64_t number)
{
  return std::to_string(number);
}

std::string TextOfCell(double number)
{
  return ExactTextOf(number);
}

std::string TextOfCell(const TableCell& cell)
{
  return std::visit([](const auto& value) { return TextOfCell(value); }, cell);
}

template <typename Cell>
std::string LineOf(const std::vector<Cell>& cells)
{
  std::string line;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    line += (cell == 0 ? "" : ",") + TextOfCell(cells[cell]);
  }
  return line + '\n';
}

} // namespace

TableText ReadTableText(const std::string& name, const std::string& text)
{
  const std::string lines = WithLineFeeds(text);
  const std::size_t end = std::min(lines.find('\n'), lines.size());
  const char said = SaidSeparator(lines.substr(0, end));
  return said ? SplitBy(said, name, lines, std::min(end + 1, lines.size()), 2)
              : SplitBy(FoundSeparator(name, lines), name, lines, 0, 1);
}

bool AreDecimals(const std::string& cell)
{
  const char* const ends = " \t\r\n;";
  std::size_t at = cell.find_first_not_of(ends);
  bool areNumbers = at != std::string::npos;
  while (areNumbers && at != std::string::npos)
  {
    const std::size_t end = std::min(cell.find_first_of(ends, at), cell.size());
    const std::string word = cell.substr(at, end - at);
    double number = 0;
    areNumbers = word.find_first_not_of("0123456789+-.eE") == std::string::npos &&
      ToNumber(word, number) && std::isfinite(number);
    at = cell.find_first_not_of(ends, end);
  }
  return areNumbers;
}

std::vector<std::string> WithDecimalPoints(const std::string& name, std::vector<std::string> cells)
{
  const auto find = [&cells](char mark)
  {
    return std::find_if(cells.begin(), cells.end(),
      [mark](const std::string& cell) { return HasMark(mark, cell); });
  };
  const auto comma = find(',');
  const auto point = find('.');
  if (comma != cells.end() && point != cells.end())
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      InQuotes(name) + ": some numbers have a decimal point (" + point->substr(0, 40) +
        "), and others a comma (" + comma->substr(0, 40) + "). Write all of them alike.");
  }
  for (std::string& cell : cells)
  {
    if (HasMark(',', cell))
    {
      std::replace(cell.begin(), cell.end(), ',', '.');
    }
  }
  return cells;
}

std::string TextOfTable(const std::vector<std::string>& columns,
  const std::vector<std::vector<TableCell>>& rows)
{
  std::string text = LineOf(columns);
  for (const std::vector<TableCell>& row : rows)
  {
    text += LineOf(row);
  }
  return text;
}

} // namespace FlipFree
