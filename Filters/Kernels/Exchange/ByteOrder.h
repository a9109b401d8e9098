/**
 * Numbers from the bytes of files, in either order, and to bytes of the more common one.
 */
#ifndef FlipFreeByteOrder_h
#define FlipFreeByteOrder_h

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace FlipFree
{

inline bool MachineIsBigEndian()
{
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

/// Of the first sizeof(T) bytes.
template <typename T>
T NumberFrom(const void* bytes, bool isBigEndian)
{
  unsigned char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (isBigEndian != MachineIsBigEndian())
  {
    std::reverse(ordered, ordered + sizeof(T));
  }
  T number;
  std::memcpy(&number, ordered, sizeof(T));
  return number;
}

template <typename T>
void AppendLittleEndian(std::string& bytes, T number)
{
  char ordered[sizeof(T)];
  std::memcpy(ordered, &number, sizeof(T));
  if (MachineIsBigEndian())
  {
    std::reverse(ordered, ordered + sizeof(T));
  }
  bytes.append(ordered, sizeof(T));
}

} // namespace FlipFree

#endif
