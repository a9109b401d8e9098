#include "AccuracyGate.h"

#include "Statistics.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace
{

constexpr double LeastChange = 0.002; // of Dice, to be printed
constexpr double MostOfRow = 0.02;    // what may be lost
constexpr double MostOfMedian = 0.003;

std::size_t HashOfValues(vtkDataArray* values)
{
  const auto bytes = static_cast<std::size_t>(values->GetNumberOfValues()) *
    static_cast<std::size_t>(values->GetDataTypeSize());
  return std::hash<std::string_view>()(
    { static_cast<const char*>(values->GetVoidPointer(0)), bytes });
}

} // namespace

std::string HashOf(vtkPolyData* surface)
{
  if (surface->GetNumberOfPoints() == 0)
  {
    return {};
  }
  const std::size_t points = HashOfValues(surface->GetPoints()->GetData());
  const std::size_t quads = HashOfValues(surface->GetPolys()->GetConnectivityArray());
  char text[17];
  std::snprintf(text, sizeof text, "%016zx", points ^ (quads << 1));
  return text;
}

std::vector<GateRow> ReadGate(const std::string& file)
{
  std::ifstream stream(file);
  std::vector<GateRow> rows;
  std::string line;
  std::getline(stream, line); // the names of the columns
  while (std::getline(stream, line))
  {
    std::istringstream fields(line);
    GateRow row;
    std::string dice;
    if (std::getline(fields, row.Case, ',') && std::getline(fields, row.Organ, ',') &&
      std::getline(fields, dice, ','))
    {
      std::getline(fields, row.Hash);
      row.Dice = std::stod(dice);
      rows.push_back(row);
    }
  }
  if (rows.empty())
  {
    throw std::runtime_error(file + " has no rows: write it by --write-gate");
  }
  return rows;
}

void WriteGate(const std::string& file, const std::vector<GateRow>& rows)
{
  std::ofstream stream(file);
  stream << "case,organ,dice,hash\n";
  for (const GateRow& row : rows)
  {
    char dice[16];
    std::snprintf(dice, sizeof dice, "%.4f", row.Dice);
    stream << row.Case << ',' << row.Organ << ',' << dice << ',' << row.Hash << '\n';
  }
  stream.flush();
  if (!stream)
  {
    throw std::runtime_error(file + " cannot be written");
  }
}

bool PassesGate(const std::vector<GateRow>& before, const std::vector<GateRow>& after)
{
  std::map<std::string, GateRow> old;
  for (const GateRow& row : before)
  {
    old[row.Case] = row;
  }
  std::map<std::string, std::array<std::vector<double>, 2>> organs;
  int changed = 0;
  int lost = 0;
  for (const GateRow& row : after)
  {
    const auto found = old.find(row.Case);
    if (found == old.end())
    {
      std::printf("%s: NOT IN THE TABLE\n", row.Case.c_str());
      ++lost;
      continue;
    }
    const GateRow& was = found->second;
    organs[row.Organ][0].push_back(was.Dice);
    organs[row.Organ][1].push_back(row.Dice);
    changed += row.Hash == was.Hash ? 0 : 1;
    const double change = row.Dice - was.Dice;
    lost += change < -MostOfRow ? 1 : 0;
    if (std::abs(change) > LeastChange)
    {
      std::printf("%s: %.3f, was %.3f%s\n", row.Case.c_str(), row.Dice, was.Dice,
        change < -MostOfRow ? ": TOO MUCH LOST" : "");
    }
  }
  for (const auto& [organ, scores] : organs)
  {
    const double was = Median(scores[0]);
    const double now = Median(scores[1]);
    lost += now < was - MostOfMedian ? 1 : 0;
    if (std::abs(now - was) > LeastChange)
    {
      std::printf("median of %s: %.3f, was %.3f%s\n", organ.c_str(), now, was,
        now < was - MostOfMedian ? ": TOO MUCH LOST" : "");
    }
  }
  std::printf("gate: %d of %zu surfaces changed; %s\n", changed, after.size(),
    lost ? "failed" : "passed");
  return lost == 0;
}
