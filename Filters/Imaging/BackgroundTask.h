/**
 * Private to the module: runs what cannot be stopped, such as ITK's reading and writing of a file,
 * in a thread of its own, so that the caller can be stopped at once all the same. Where the system
 * starts no more threads, as in containers that limit them, the caller's own thread does the work.
 */
#ifndef FlipFreeBackgroundTask_h
#define FlipFreeBackgroundTask_h

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <system_error>
#include <vector>

namespace FlipFree
{

class BackgroundTask
{
public:
  /// Starts the body. It may outlive the caller: all that it uses must be its own, or shared.
  explicit BackgroundTask(const std::function<void()>& body)
  {
    try
    {
      this->Done = std::async(std::launch::async, body);
    }
    catch (const std::system_error&)
    {
      this->Done = std::async(std::launch::deferred, body); // until it is waited for
    }
  }
  ~BackgroundTask()
  {
    if (this->Done.valid())
    {
      Abandon(std::move(this->Done));
    }
  }
  BackgroundTask(const BackgroundTask&) = delete;
  void operator=(const BackgroundTask&) = delete;

  /// Waits for the end and passes on what the body throws; what the body holds is released then.
  /// Returns false at once if `proceed`, asked every 20 ms, says no. The task is then left to end
  /// by itself, unless Wait is called again.
  bool Wait(const std::function<bool()>& proceed)
  {
    do
    {
      if (!proceed())
      {
        return false;
      }
    } while (!IsReady(this->Done, std::chrono::milliseconds(20)));
    this->Done.get();
    return true;
  }

private:
  /// Or put off until somebody waits for it.
  static bool IsReady(const std::future<void>& done, std::chrono::milliseconds patience)
  {
    return done.wait_for(patience) != std::future_status::timeout;
  }

  /// Keeps the tasks for which nobody waits. The end of the program does, in the destructors of the
  /// futures: a thread must not outlive the libraries that it runs in.
  static void Abandon(std::future<void> task)
  {
    static std::mutex mutex;
    static std::vector<std::future<void>> abandoned;
    const std::lock_guard<std::mutex> lock(mutex);
    abandoned.erase(std::remove_if(abandoned.begin(), abandoned.end(),
                      [](const std::future<void>& other)
                      { return IsReady(other, std::chrono::milliseconds(0)); }),
      abandoned.end());
    abandoned.push_back(std::move(task));
  }

  std::future<void> Done;
};

} // namespace FlipFree

#endif
