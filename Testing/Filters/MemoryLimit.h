/**
 * A temporary limit on memory.
 */
#ifndef FlipFreeMemoryLimit_h
#define FlipFreeMemoryLimit_h

#include <fstream>

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLIPFREE_CAN_LIMIT_MEMORY // sanitizers map all of the address space
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace FlipFree
{

#ifdef FLIPFREE_CAN_LIMIT_MEMORY
/// While it lives, allocations beyond this number of bytes fail.
class MemoryLimit
{
public:
  explicit MemoryLimit(rlim_t bytes)
  {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &this->Former);
    rlimit limit = this->Former;
    limit.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &this->Former); }
  MemoryLimit(const MemoryLimit&) = delete;
  void operator=(const MemoryLimit&) = delete;

private:
  rlimit Former{};
};
#endif

} // namespace FlipFree

#endif
