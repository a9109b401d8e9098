/**
 * Numbers and names as messages show them, and numbers as files hold them.
 */
#ifndef FlipFreeMessageText_h
#define FlipFreeMessageText_h

#include "QuantityNames.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>

namespace FlipFree
{

/// In brackets, row after row: (1, 2.5, nan).
inline std::string TextOf(const Eigen::MatrixXd& numbers)
{
  static const Eigen::IOFormat oneLine(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", ", ", "",
    "", "(", ")");
  std::ostringstream text;
  text << numbers.format(oneLine);
  return text.str();
}

/// As streams show it: 2.5, 1e-06.
inline std::string TextOf(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

/// With the fewest digits from 15 on that read back as the same, whatever the locale.
inline std::string ExactTextOf(double number)
{
  // Every double has 15 digits, and none needs more.
  constexpr int enough = 17;
  std::string text;
  for (int digits = 15; digits <= enough; ++digits)
  {
    std::ostringstream written;
    written.imbue(std::locale::classic());
    written.precision(digits);
    written << number;
    text = written.str();
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    double found = 0;
    if (stream >> found && found == number)
    {
      break;
    }
  }
  return text;
}

/// Of a part that is neither nothing nor all, and not shown as if it were: 1 % to 99 %.
inline std::string PercentOf(double fraction)
{
  return std::to_string(std::max(1L, std::min(99L, std::lround(100 * fraction)))) + " %";
}

/// What a user has named, as part of a message.
inline std::string Quoted(const std::string& name)
{
  return "'" + Escaped(name) + "'";
}

} // namespace FlipFree

#endif
