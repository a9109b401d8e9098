/**
 * Seconds since it was made or last asked.
 */
#ifndef FlipFreeStopwatch_h
#define FlipFreeStopwatch_h

#include <chrono>

namespace FlipFree
{

class Stopwatch
{
public:
  double Lap()
  {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Last = Clock::now();
};

} // namespace FlipFree

#endif
