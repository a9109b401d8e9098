#include "Interrupt.h"

#include <csignal>

namespace Command
{
namespace
{

volatile std::sig_atomic_t Stopped = 0;

void Stop(int)
{
  Stopped = 1;
}

} // namespace

void CatchSignals()
{
  struct sigaction action = {};
  action.sa_handler = Stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool WasInterrupted()
{
  return Stopped != 0;
}

} // namespace Command
