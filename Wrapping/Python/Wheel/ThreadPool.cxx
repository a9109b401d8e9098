#include "ThreadPool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace FlipFree
{
namespace
{

// Parts per thread, so that one that is late does not keep all others waiting.
constexpr std::ptrdiff_t PartsPerThread = 4;

thread_local bool IsInPart = false;

// One call of For(), cut into parts.
class Work
{
public:
  Work(std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t parts, const RangeBody& body)
    : Begin(begin)
    , Size(end - begin)
    , Parts(parts)
    , Body(body)
  {
  }

  // Takes on parts until none is left.
  void Help()
  {
    const bool before = IsInPart;
    IsInPart = true;
    for (std::ptrdiff_t part = this->Next++; part < this->Parts; part = this->Next++)
    {
      this->Run(part);
    }
    IsInPart = before;
  }

  bool IsTaken() const { return this->Next >= this->Parts; }

  // Until the last part is done; throws what a part has thrown.
  void Wait()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Changed.wait(lock, [this] { return this->Done == this->Parts; });
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
  }

private:
  void Run(std::ptrdiff_t part)
  {
    std::exception_ptr failure;
    try
    {
      this->Body(this->Begin + this->Size * part / this->Parts,
        this->Begin + this->Size * (part + 1) / this->Parts);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Failure = this->Failure ? this->Failure : failure;
    if (++this->Done == this->Parts)
    {
      this->Changed.notify_all();
    }
  }

  const std::ptrdiff_t Begin;
  const std::ptrdiff_t Size;
  const std::ptrdiff_t Parts;
  const RangeBody& Body; // lives until all parts are done
  std::atomic<std::ptrdiff_t> Next{ 0 };
  std::mutex Mutex;
  std::condition_variable Changed;
  std::ptrdiff_t Done = 0;
  std::exception_ptr Failure;
};

class Pool
{
public:
  void Offer(const std::shared_ptr<Work>& work, int helpers)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Works.push_back(work);
    while (this->Helpers < helpers && this->HasStartedHelper())
    {
      ++this->Helpers;
    }
    this->Changed.notify_all();
  }

  void Withdraw(const std::shared_ptr<Work>& work)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Works.erase(std::remove(this->Works.begin(), this->Works.end(), work), this->Works.end());
  }

private:
  // Containers and login nodes limit threads. Where no more can be had, those that there are do the
  // work, the caller among them.
  bool HasStartedHelper()
  {
    try
    {
      std::thread([this] { this->Help(); }).detach();
    }
    catch (const std::exception&) // std::system_error, or no memory for its stack
    {
      return false;
    }
    return true;
  }

  void Help()
  {
    for (;;)
    {
      std::shared_ptr<Work> work;
      {
        std::unique_lock<std::mutex> lock(this->Mutex);
        this->Changed.wait(lock, [this, &work] { return (work = this->FirstOpen()) != nullptr; });
      }
      work->Help();
    }
  }

  std::shared_ptr<Work> FirstOpen() const
  {
    const auto open = std::find_if(this->Works.begin(), this->Works.end(),
      [](const auto& work) { return !work->IsTaken(); });
    return open == this->Works.end() ? nullptr : *open;
  }

  std::mutex Mutex;
  std::condition_variable Changed;
  std::deque<std::shared_ptr<Work>> Works;
  int Helpers = 0;
};

// Never destroyed: its threads wait in it until the process ends.
std::atomic<Pool*> ThePool{ nullptr };

std::atomic<int> Number{ 0 }; // 0: as many as the machine has

Pool& GetPool()
{
  Pool* pool = ThePool;
  if (!pool)
  {
    auto made = std::make_unique<Pool>();
    if (ThePool.compare_exchange_strong(pool, made.get()))
    {
      pool = made.release();
    }
  }
  return *pool;
}

} // namespace

int NumberOfThreads()
{
  const int number = Number;
  return number > 0 ? number : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void SetNumberOfThreads(int number)
{
  Number = number;
}

void PoolFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  const int threads = NumberOfThreads();
  const std::ptrdiff_t parts = std::min(end - begin, PartsPerThread * threads);
  if (threads == 1 || parts <= 1 || IsInPart)
  {
    SerialFor(begin, end, body);
    return;
  }
  const auto work = std::make_shared<Work>(begin, end, parts, body);
  Pool& pool = GetPool();
  pool.Offer(work, threads - 1);
  work->Help();
  pool.Withdraw(work);
  work->Wait();
}

Threading PoolThreading()
{
  return { PoolFor, NumberOfThreads() };
}

void ForgetThreads()
{
  ThePool = nullptr;
}

} // namespace FlipFree
