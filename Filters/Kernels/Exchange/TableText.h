/**
 * Tables as text. Read as spreadsheet programs write them: cells are separated by commas,
 * semicolons or tabs, or by what a line `sep=;` before the table says. Cells may be in quotes. With
 * another separator than the comma, numbers may have decimal commas. Lines end as in any system.
 * Written as CSV: a line of column names, then a line per row, in UTF-8.
 */
#ifndef FlipFreeTableText_h
#define FlipFreeTableText_h

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace FlipFree
{

struct TableLine
{
  int Number = 1; ///< of the line in which it begins
  std::vector<std::string> Cells;
};

struct TableText
{
  std::vector<TableLine> Lines; ///< but for those of empty cells
  char Separator = ',';
};

/// The cells of a table without the blanks around them. Throws FileProblem, naming the file by
/// `name`, for a quote that does not end.
TableText ReadTableText(const std::string& name, const std::string& text);

/// Whether all words of a cell, which blanks or semicolons separate, are decimal numbers.
bool AreDecimals(const std::string& cell);

/// The same cells, numbers with decimal points in place of commas. Throws FileProblem where there
/// are both: a comma may part thousands.
std::vector<std::string> WithDecimalPoints(const std::string& name, std::vector<std::string> cells);

using TableCell = std::variant<std::int64_t, double, std::string>;

/// Numbers have the fewest digits that read back as the same. Texts are in quotes where they hold
/// commas, quotes or line breaks.
std::string TextOfTable(const std::vector<std::string>& columns,
  const std::vector<std::vector<TableCell>>& rows);

} // namespace FlipFree

#endif
