#include "ProgressBar.h"

#include "Messages.h"

#include <algorithm>

#include <unistd.h>

namespace Command
{
namespace ProgressBar
{
namespace
{

constexpr int Width = 32;
bool Enabled = isatty(STDERR_FILENO) != 0;
std::string Shown;

} // namespace

void Disable()
{
  Enabled = false;
}

void Show(const std::string& title, double fraction)
{
  if (!Enabled)
  {
    return;
  }
  const double part = std::clamp(fraction, 0.0, 1.0);
  const auto full = static_cast<std::string::size_type>(part * Width);
  const std::string percent = std::to_string(static_cast<int>(100 * part));
  const std::string line = title + std::string(title.size() < 14 ? 14 - title.size() : 1, ' ') +
    '[' + std::string(full, '#') + std::string(Width - full, '.') + "] " +
    std::string(3 - percent.size(), ' ') + percent + " %";
  if (line != Shown)
  {
    WriteToUser('\r' + line);
    Shown = line;
  }
}

void Clear()
{
  if (!Shown.empty())
  {
    WriteToUser("\r\x1b[K");
    Shown.clear();
  }
}

} // namespace ProgressBar
} // namespace Command
