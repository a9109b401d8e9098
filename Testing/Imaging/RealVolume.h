/**
 * Real volumes, which are not part of the sources: tests that need one skip themselves without it.
 */
#ifndef RealVolume_h
#define RealVolume_h

#include <cstdlib>
#include <string>

/// A file in the folder that the environment variable FLIPFREE_DATA_DIR names; it may not exist.
inline std::string RealVolume(const std::string& name)
{
  const char* const folder = std::getenv("FLIPFREE_DATA_DIR");
  return std::string(folder ? folder : "") + "/" + name;
}

/// What a test says that is skipped without the file.
inline std::string NoRealVolume(const std::string& file)
{
  return "'" + file + "' does not exist; FLIPFREE_DATA_DIR names the folder with the real volumes.";
}

#endif
