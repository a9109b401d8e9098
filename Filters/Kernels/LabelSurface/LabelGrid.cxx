#include "LabelSurface/LabelGrid.h"

#include <sstream>

namespace FlipFree
{
namespace
{

std::string FirstOf(const std::set<int>& values)
{
  constexpr int Most = 20;
  std::ostringstream text;
  int count = 0;
  for (const int value : values)
  {
    if (++count > Most)
    {
      return text.str() + " and more";
    }
    text << (count > 1 ? ", " : "") << value;
  }
  return text.str();
}

} // namespace

void LabelCensus::Merge(const LabelCensus& other)
{
  this->Values.insert(other.Values.begin(), other.Values.end());
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
    this->High[axis] = std::max(this->High[axis], other.High[axis]);
  }
  this->Invalid = std::min(this->Invalid, other.Invalid);
}

void RequireLabels(LabelCensus& census, const std::vector<int>& wanted, const std::string& name,
  const std::array<int, 3>& invalidVoxel, double invalidValue)
{
  if (census.Invalid != std::numeric_limits<std::size_t>::max())
  {
    std::ostringstream message;
    message << name << " has the value " << invalidValue << " at voxel (" << invalidVoxel[0] << ", "
            << invalidVoxel[1] << ", " << invalidVoxel[2]
            << "); a label map holds whole numbers from 0 to " << std::numeric_limits<int>::max()
            << ", 0 being background";
    throw Error(ErrorCode::InvalidInput, message.str());
  }
  if (census.Values.size() > MaximumLabels)
  {
    throw Error(ErrorCode::TooLarge,
      name + " has more than " + std::to_string(MaximumLabels) +
        " different values; give a label map, not a scan, or name the {Labels} that are wanted");
  }
  for (const int label : wanted)
  {
    if (census.Values.count(label) == 0)
    {
      throw Error(ErrorCode::EmptyMask,
        name + " has no voxel with label " + std::to_string(label) + "; change {Labels}" +
          (census.Values.empty() ? ""
                                 : "; those of them that it has are " + FirstOf(census.Values)));
    }
  }
  if (census.Values.empty())
  {
    throw Error(ErrorCode::EmptyMask,
      name + " has no labels, since all voxels are 0; give one that has some");
  }
}

} // namespace FlipFree
