#include "TableText.h"

#include "MessageText.h"

namespace Command
{
namespace
{

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
  return FlipFree::ExactTextOf(number);
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

} // namespace Command
