/**
 * Private to the module: the bytes of a file, inflated where they are packed by gzip or zlib.
 */
#ifndef FlipFreeInflatedFile_h
#define FlipFreeInflatedFile_h

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace FlipFree
{

class InflatedFile
{
public:
  /// Reads what stands from `offset` on.
  InflatedFile(const std::string& name, bool isPacked, std::uint64_t offset = 0);
  ~InflatedFile();
  InflatedFile(const InflatedFile&) = delete;
  void operator=(const InflatedFile&) = delete;

  /// Returns how many bytes there were, fewer at the end or where the stream breaks off.
  std::size_t Read(void* bytes, std::size_t size);

  /// Past the ends of so many lines, as they are stored; before anything is read.
  void SkipLines(std::uint64_t lines);

  /// Reads on to the end of the stream, or of the part that has been begun, and returns whether it
  /// is whole; of several gzip members, one after the other. Always so of a file that is not
  /// packed.
  bool EndsProperly();

private:
  struct Stream;

  std::size_t Inflate(unsigned char* bytes, std::size_t size, bool isInOneMember);

  std::ifstream File;
  std::unique_ptr<Stream> Packed;
};

/// Whether the file begins with the mark of gzip.
bool IsPackedFile(const std::string& name);

} // namespace FlipFree

#endif
