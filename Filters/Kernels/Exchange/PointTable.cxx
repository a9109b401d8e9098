#include "Exchange/PointTable.h"

#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"
#include "Exchange/TableText.h"
#include "TextWords.h"

#include <algorithm>
#include <optional>
#include <set>

namespace FlipFree
{
namespace
{

std::size_t CountFilled(const std::vector<std::string>& cells)
{
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(),
    [](const std::string& cell) { return !cell.empty(); }));
}

/// A table with columns of these names, of which the last may be missing.
class PointTableReader
{
public:
  PointTableReader(std::string name, std::vector<std::string> columns, std::size_t needed,
    std::string meaning, std::string whatTakesPlaces = {})
    : Name(std::move(name))
    , Columns(std::move(columns))
    , Needed(needed)
    , Meaning(std::move(meaning))
    , WhatTakesPlaces(std::move(whatTakesPlaces))
  {
  }

  /// Calls take() with the cells of each line in the order of the columns.
  template <typename Take>
  void Read(const std::string& text, const Take& take)
  {
    const TableText table = ReadTableText(this->Name, text);
    std::vector<std::size_t> order;
    for (const TableLine& line : table.Lines)
    {
      this->Line = line.Number;
      std::vector<std::string> cells =
        table.Separator == ',' ? line.Cells : WithDecimalPoints(this->Name, line.Cells);
      while (cells.back().empty())
      {
        cells.pop_back();
      }
      const bool isFirst = &line == &table.Lines.front();
      if (isFirst && std::none_of(cells.begin(), cells.end(), AreDecimals) && this->IsHeader(cells))
      {
        order = this->OrderOf(cells);
        continue;
      }
      take(this->Ordered(cells, order));
    }
  }

  [[noreturn]] void Refuse(const std::string& what) const
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      InQuotes(this->Name) + ", line " + std::to_string(this->Line) + ": " + what + ".");
  }

  /// What a column must hold, by its place among all columns.
  const std::string& Filled(const std::vector<std::string>& cells, std::size_t column) const
  {
    if (cells[column].empty())
    {
      this->Refuse(
        "the column " + this->Columns[column] + " is empty; needed are " + this->Meaning);
    }
    return cells[column];
  }

  double Number(const std::vector<std::string>& cells, std::size_t column) const
  {
    const std::string& cell = this->Filled(cells, column);
    double number = 0;
    if (!AreDecimals(cell) || !ToNumber(cell, number))
    {
      this->Refuse("'" + cell + "' is not a number");
    }
    return number;
  }

private:
  /// Texts alone: names of columns, but for a line whose kind is known and whose numbers are wrong.
  bool IsHeader(const std::vector<std::string>& cells) const
  {
    return this->Columns.front() != "kind" || !KindNamed(InSmallLetters(cells.front()));
  }

  /// Where the cell of each column is.
  std::vector<std::size_t> OrderOf(const std::vector<std::string>& cells) const
  {
    std::vector<std::size_t> order;
    for (const std::string& column : this->Columns)
    {
      const auto found = std::find_if(cells.begin(), cells.end(),
        [&column](const std::string& cell) { return InSmallLetters(cell) == column; });
      if (found != cells.end())
      {
        order.push_back(static_cast<std::size_t>(found - cells.begin()));
      }
      else if (order.size() < this->Needed)
      {
        break;
      }
    }
    if (order.size() < this->Needed || order.size() != CountFilled(cells))
    {
      this->Refuse("the header must be " + this->Meaning + ", in any order" + this->Remedy(cells));
    }
    return order;
  }

  /// Without an order, the columns' own.
  std::vector<std::string> Ordered(const std::vector<std::string>& cells,
    const std::vector<std::size_t>& order) const
  {
    std::vector<std::string> ordered(this->Columns.size());
    for (std::size_t column = 0; column < ordered.size(); ++column)
    {
      const std::size_t none = cells.size();
      const std::size_t at = order.empty() ? column : column < order.size() ? order[column] : none;
      ordered[column] = at < none ? cells[at] : std::string();
    }
    const bool areFew = order.empty() && cells.size() < this->Needed;
    if (areFew || CountFilled(ordered) < CountFilled(cells))
    {
      this->Refuse(std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") +
        "; needed are " + this->Meaning + this->Remedy(cells));
    }
    return ordered;
  }

  /// For a header or a line of x, y and z alone.
  std::string Remedy(const std::vector<std::string>& cells) const
  {
    std::set<std::string> names;
    for (const std::string& cell : cells)
    {
      names.insert(InSmallLetters(cell));
    }
    const bool arePlaces = names == std::set<std::string>{ "x", "y", "z" } ||
      (cells.size() == 3 && std::all_of(cells.begin(), cells.end(), AreDecimals));
    return arePlaces && !this->WhatTakesPlaces.empty()
      ? "; a table of x, y and z alone is for " + this->WhatTakesPlaces
      : std::string();
  }

  const std::string Name;
  const std::vector<std::string> Columns;
  const std::size_t Needed; ///< of the columns
  const std::string Meaning;
  const std::string WhatTakesPlaces;
  int Line = 0;
};

} // namespace

ConstraintList ReadConstraintTable(const std::string& name, const std::string& text,
  const std::string& whatTakesPlaces)
{
  PointTableReader reader(name, { "kind", "x", "y", "z", "radius" }, 4,
    "kind, x, y, z and, for seeds, radius", whatTakesPlaces);
  ConstraintList points;
  reader.Read(text,
    [&](const std::vector<std::string>& cells)
    {
      PointConstraint point;
      for (int axis = 0; axis < 3; ++axis)
      {
        point.Point[axis] = reader.Number(cells, static_cast<std::size_t>(axis) + 1);
      }
      const double radius = cells[4].empty() ? 0 : reader.Number(cells, 4);
      const std::string kind = InSmallLetters(reader.Filled(cells, 0));
      const std::optional<ConstraintKind> known = KindNamed(kind);
      if (!known)
      {
        reader.Refuse("the kind is '" + kind + "'; it can be " + KindsInWords);
      }
      point.Kind = *known;
      if (point.Kind == ConstraintKind::Seed)
      {
        point.Radius = radius;
        if (!(radius > 0))
        {
          reader.Refuse("a seed has no radius");
        }
      }
      points.push_back(point);
    });
  return points;
}

std::vector<Eigen::Vector3d> ReadPlaceTable(const std::string& name, const std::string& text)
{
  PointTableReader reader(name, { "x", "y", "z" }, 3, "x, y, z");
  std::vector<Eigen::Vector3d> places;
  reader.Read(text,
    [&](const std::vector<std::string>& cells)
    {
      places.emplace_back(reader.Number(cells, 0), reader.Number(cells, 1),
        reader.Number(cells, 2));
    });
  return places;
}

} // namespace FlipFree
