/**
 * Tables as the text of CSV files: a line of column names, then a line per row, in UTF-8.
 */
#ifndef FlipFreeCommandTableText_h
#define FlipFreeCommandTableText_h

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace Command
{

using TableCell = std::variant<std::int64_t, double, std::string>;

/// Numbers have the fewest digits that read back as the same. Texts are in quotes where they hold
/// commas, quotes or line breaks.
std::string TextOfTable(const std::vector<std::string>& columns,
  const std::vector<std::vector<TableCell>>& rows);

} // namespace Command

#endif
