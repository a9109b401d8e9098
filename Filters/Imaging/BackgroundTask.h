/**
 * Private to the module: runs what cannot be stopped, such as ITK's reading and writing of a file,
 * in a thread of its own, so that the caller can be stopped at once all the same.
 */
#ifndef FlipFreeBackgroundTask_h
#define FlipFreeBackgroundTask_h

#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace FlipFree
{

class BackgroundTask
{
public:
  /// Starts the body. It may outlive the caller: all that it uses must be its own, or shared.
  explicit BackgroundTask(std::function<void()> body)
  {
    std::packaged_task<void()> task(std::move(body));
    this->Done = task.get_future();
    this->Thread = std::thread(std::move(task));
  }
  ~BackgroundTask()
  {
    if (this->Thread.joinable())
    {
      Abandoned::All().Take({ std::move(this->Thread), std::move(this->Done) });
    }
  }
  BackgroundTask(const BackgroundTask&) = delete;
  void operator=(const BackgroundTask&) = delete;

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
    this->Thread.join(); // what the body holds is gone then, too
    this->Done.get();
    return true;
  }

private:
  struct Orphan
  {
    std::thread Thread;
    std::future<void> Done;
  };

  /// The tasks for which nobody waits. The end of the program does: a thread must not outlive the
  /// libraries that it runs in.
  class Abandoned
  {
  public:
    static Abandoned& All()
    {
      static Abandoned all;
      return all;
    }
    ~Abandoned()
    {
      for (Orphan& orphan : this->Orphans)
      {
        orphan.Thread.join();
      }
    }
    void Take(Orphan orphan)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      for (std::size_t i = this->Orphans.size(); i-- > 0;)
      {
        if (this->Orphans[i].Done.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        {
          this->Orphans[i].Thread.join();
          this->Orphans.erase(this->Orphans.begin() + static_cast<std::ptrdiff_t>(i));
        }
      }
      this->Orphans.push_back(std::move(orphan));
    }

  private:
    Abandoned() = default;
    std::mutex Mutex;
    std::vector<Orphan> Orphans;
  };

  std::thread Thread;
  std::future<void> Done;
};

} // namespace FlipFree

#endif
