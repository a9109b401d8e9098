#include "Interrupt.h"

#include "Failure.h"
#include "Messages.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <thread>
#include <vector>

#include <semaphore.h>
#include <unistd.h>

namespace Command
{
namespace
{

volatile std::sig_atomic_t Stopped = 0;
sem_t Signals; // counts them; a handler may do little else than post

// Never destroyed: the waiting thread may use them until the process has ended.
std::timed_mutex& Lock()
{
  static auto* const lock = new std::timed_mutex;
  return *lock;
}

std::vector<std::string>& TemporaryFolders()
{
  static auto* const folders = new std::vector<std::string>;
  return *folders;
}

void Stop(int)
{
  const int error = errno;
  Stopped = 1;
  sem_post(&Signals);
  errno = error;
}

/// Other threads may be writing into them: what comes late is removed by another turn.
void RemoveTemporaryFolders()
{
  constexpr int turns = 100;
  for (const std::string& folder : TemporaryFolders())
  {
    std::error_code failure;
    for (int turn = 0; turn < turns && std::filesystem::exists(folder, failure); ++turn)
    {
      std::filesystem::remove_all(folder, failure);
    }
  }
}

[[noreturn]] void End()
{
  // Where files are just getting their names, they all do.
  const std::unique_lock<std::timed_mutex> lock(Lock(), std::chrono::milliseconds(200));
  RemoveTemporaryFolders();
  if (isatty(STDERR_FILENO))
  {
    WriteToUser("\r\x1b[K"); // the progress bar
  }
  std::_Exit(INTERRUPTED);
}

void WaitForSignals()
{
  while (sem_wait(&Signals) != 0)
  {
  }
  // What aborts by itself does so sooner, and says so.
  timespec end;
  clock_gettime(CLOCK_REALTIME, &end);
  constexpr long patience = 600000000; // ns
  constexpr long second = 1000000000;
  end.tv_nsec += patience;
  end.tv_sec += end.tv_nsec / second;
  end.tv_nsec %= second;
  while (sem_timedwait(&Signals, &end) != 0 && errno == EINTR)
  {
  }
  End();
}

} // namespace

void CatchSignals()
{
  std::signal(SIGXFSZ, SIG_IGN);
  sem_init(&Signals, 0, 0);
  try
  {
    std::thread(WaitForSignals).detach();
  }
  catch (const std::system_error&)
  {
    return; // no thread to be had: signals go on to end the process
  }
  struct sigaction action = {};
  action.sa_handler = Stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool WasInterrupted()
{
  return Stopped != 0;
}

Uninterrupted::Uninterrupted()
  : Lock(Command::Lock())
{
}

void AddTemporaryFolder(const std::string& name)
{
  TemporaryFolders().push_back(name);
}

void EndInterrupted()
{
  End();
}

} // namespace Command
