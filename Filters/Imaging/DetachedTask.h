/**
 * Private to the module: runs what cannot be stopped, such as ITK's reading and writing of a file,
 * in a thread of its own, so that the caller can be stopped at once all the same.
 */
#ifndef FlipFreeDetachedTask_h
#define FlipFreeDetachedTask_h

#include <chrono>
#include <functional>
#include <future>
#include <thread>

namespace FlipFree
{

class DetachedTask
{
public:
  /// Starts the body. It may outlive the caller: all that it uses must be its own, or shared.
  explicit DetachedTask(std::function<void()> body)
  {
    std::packaged_task<void()> task(std::move(body));
    this->Done = task.get_future();
    std::thread(std::move(task)).detach();
  }
  DetachedTask(const DetachedTask&) = delete;
  void operator=(const DetachedTask&) = delete;

  /// Waits for the end and passes on what the body throws. False, at once, if `goOn`, asked every
  /// 20 ms, says no; the task is then left to end alone, unless Wait is called again.
  bool Wait(const std::function<bool()>& goOn)
  {
    do
    {
      if (!goOn())
      {
        return false;
      }
    } while (this->Done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready);
    this->Done.get();
    return true;
  }

private:
  std::future<void> Done;
};

} // namespace FlipFree

#endif
