/**
 * Private to the module: ITK's anisotropic diffusion filters, which look up only once per
 * iteration, made to tell how far they are and to stop within an iteration.
 */
#ifndef FlipFreeMonitoredDiffusion_h
#define FlipFreeMonitoredDiffusion_h

#include "itkImage.h"
#include "itkMacro.h"

#include <algorithm>
#include <atomic>

namespace FlipFree
{

/// TFilter is one of ITK's anisotropic diffusion filters. Its additions may be called from any
/// thread while Update() runs in another.
template <typename TFilter>
class MonitoredDiffusion : public TFilter
{
public:
  using Self = MonitoredDiffusion;
  using Pointer = itk::SmartPointer<Self>;
  using Region = typename TFilter::ThreadRegionType;
  using TimeStepType = typename TFilter::TimeStepType;
  itkNewMacro(Self);

  /// Update() soon ends with itk::ProcessAborted.
  void Stop() { this->Stopped = true; }

  /// The number of voxels computed, over all iterations.
  std::size_t GetVoxelsDone() const { return this->VoxelsDone; }

protected:
  /// In small blocks of rows, which changes nothing in the result.
  TimeStepType ThreadedCalculateChange(const Region& region, itk::ThreadIdType thread) override
  {
    constexpr itk::SizeValueType rows = 8;
    TimeStepType step = this->GetTimeStep();
    Region block = region;
    for (itk::SizeValueType z = 0; z < region.GetSize(2); ++z)
    {
      for (itk::SizeValueType y = 0; y < region.GetSize(1) && !this->Stopped; y += rows)
      {
        block.SetIndex(1, region.GetIndex(1) + static_cast<itk::IndexValueType>(y));
        block.SetSize(1, std::min(rows, region.GetSize(1) - y));
        block.SetIndex(2, region.GetIndex(2) + static_cast<itk::IndexValueType>(z));
        block.SetSize(2, 1);
        step = TFilter::ThreadedCalculateChange(block, thread);
        this->VoxelsDone += block.GetNumberOfPixels();
      }
    }
    return step;
  }

  void ApplyUpdate(const TimeStepType& step) override
  {
    if (this->Stopped)
    {
      this->AbortGenerateDataOn(); // ITK looks at it next
      return;
    }
    TFilter::ApplyUpdate(step);
  }

private:
  std::atomic<bool> Stopped{ false };
  std::atomic<std::size_t> VoxelsDone{ 0 };
};

} // namespace FlipFree

#endif
