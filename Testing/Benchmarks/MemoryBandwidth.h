/**
 * The memory bandwidth of this machine, as a bound for loops over voxels: the triad a = b + s c of
 * J. McCalpin (Memory bandwidth and machine balance in current high performance computers, 1995).
 */
#ifndef MemoryBandwidth_h
#define MemoryBandwidth_h

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <thread>
#include <vector>

namespace FlipFree
{

namespace Detail
{

// A function of its own with arrays that do not overlap, so that the compiler vectorizes.
inline void Triad(const float* __restrict b, const float* __restrict c, std::size_t size,
  float* __restrict a)
{
  for (std::size_t index = 0; index < size; ++index)
  {
    a[index] = b[index] + 0.5F * c[index];
  }
}

} // namespace Detail

/// Bytes per second that `threads` threads move together: the best of `repetitions` triads over
/// three arrays of `arrayBytes` each, counted as two reads and one write, as STREAM counts. The
/// default size is that of an organ's region, 64 MB: larger than the caches that a core has for
/// itself. Takes about a tenth of a second.
inline double MemoryBandwidth(int threads, std::size_t arrayBytes = std::size_t(64) << 20U,
  int repetitions = 5)
{
  const std::size_t size = arrayBytes / sizeof(float);
  std::vector<float> a(size, 0.0F);
  const std::vector<float> b(size, 1.0F);
  const std::vector<float> c(size, 2.0F);
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < repetitions; ++repetition)
  {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> workers;
    for (int thread = 0; thread < threads; ++thread)
    {
      const std::size_t first = size * thread / threads;
      const std::size_t last = size * (thread + 1) / threads;
      workers.emplace_back([&a, &b, &c, first, last]
        { Detail::Triad(b.data() + first, c.data() + first, last - first, a.data() + first); });
    }
    for (std::thread& worker : workers)
    {
      worker.join();
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    least = std::min(least, elapsed.count());
  }
  return 3.0 * static_cast<double>(size * sizeof(float)) / least;
}

} // namespace FlipFree

#endif
