/**
 * ITK's level sets, made to stop when the volume inside has settled. ITK's own criterion, the
 * change of the level set function per iteration, is often never met, because the front oscillates
 * in place.
 */
#ifndef FlipFreeSettlingLevelSet_h
#define FlipFreeSettlingLevelSet_h

#include "itkMacro.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

/// TFilter is one of ITK's sparse field level set filters.
template <typename TFilter>
class SettlingLevelSet : public TFilter
{
public:
  using Self = SettlingLevelSet;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  /// Stops when the volume inside has changed by less than this fraction over `interval`
  /// iterations; zero: never.
  void SetVolumeTolerance(double fraction) { this->VolumeTolerance = fraction; }

protected:
  bool Halt() override
  {
    constexpr itk::IdentifierType interval = 25;
    if (TFilter::Halt())
    {
      return true;
    }
    const itk::IdentifierType iteration = this->GetElapsedIterations();
    if (iteration == 0 || iteration % interval != 0)
    {
      return false;
    }
    const auto* image = this->GetOutput();
    const auto* begin = image->GetBufferPointer();
    const auto* end = begin + image->GetBufferedRegion().GetNumberOfPixels();
    const auto volume =
      static_cast<double>(std::count_if(begin, end, [](auto value) { return value < 0; }));
    const double change = std::abs(volume - this->Volume);
    this->Volume = volume;
    return change < this->VolumeTolerance * volume;
  }

private:
  double VolumeTolerance = 0;
  double Volume = 0;
};

} // namespace FlipFree

#endif
