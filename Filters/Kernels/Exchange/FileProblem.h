/**
 * Why a file cannot be used. The message is for the user and stands alone: whole sentences that
 * name the file, what is wrong with it, and the remedy. Every front end shows it as it is.
 */
#ifndef FlipFreeFileProblem_h
#define FlipFreeFileProblem_h

#include <stdexcept>
#include <string>

namespace FlipFree
{

class FileProblem : public std::runtime_error
{
public:
  enum class Kind
  {
    Missing,      ///< no such file, folder or series, or no permission
    Unrecognized, ///< of another format than those that are read
    Unusable,     ///< damaged, or not a volume of one number per voxel
    Incomplete    ///< with fewer voxels than its header says
  };

  FileProblem(Kind kind, const std::string& message)
    : std::runtime_error(message)
    , KindOfProblem(kind)
  {
  }

  Kind GetKind() const { return this->KindOfProblem; }

private:
  Kind KindOfProblem;
};

} // namespace FlipFree

#endif
