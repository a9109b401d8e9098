/**
 * The small whole files that FuzzFiles damages: one of each form of each format that the command
 * reads, and what else belongs to them.
 */
#ifndef FlipFreeFuzzInputs_h
#define FlipFreeFuzzInputs_h

#include <map>
#include <string>
#include <vector>

struct FuzzInput
{
  std::string Name; ///< of the form
  std::string Main; ///< the file that is given to the command, or "" for the whole folder
  std::map<std::string, std::string> Files; ///< contents by name
  bool IsSurface = false;
  bool IsText = false;      ///< its header is
  bool IsPacked = false;    ///< by gzip as a whole; also damaged before it is packed
  std::size_t Header = 400; ///< bytes that count as header
  bool IsRead = true;       ///< where it is whole
};

/// Writes into a folder what the inputs are made of: label maps of 12 x 10 x 8 voxels (`truth.nii`,
/// with its gray volume `ball.nii`) and surfaces of 96 vertices, all of the same ball. Starts
/// threads.
void WriteFuzzBases(const std::string& folder);

/// From such a folder. Starts none.
std::vector<FuzzInput> MakeFuzzInputs(const std::string& folder);

std::string Inflated(const std::string& bytes);
std::string Deflated(const std::string& bytes);
std::string ReadWhole(const std::string& name);
void WriteWhole(const std::string& name, const std::string& bytes);

#endif
