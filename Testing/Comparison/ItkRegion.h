/**
 * The region as an image of ITK, and ITK's filters with progress and abort.
 */
#ifndef FlipFreeItkRegion_h
#define FlipFreeItkRegion_h

#include "BackgroundTask.h"
#include "Image/SeedRegion.h"

#include "itkCommand.h"
#include "itkImage.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

namespace FlipFree
{

using ItkImage = itk::Image<float, 3>;

/// An image of ITK's own with the grid's spacing, its first voxel at zero and its axes along those
/// of space: all that the methods measure is lengths along the grid's axes. ITK refuses some
/// direction matrices that are good here.
inline ItkImage::Pointer NewItkImage(const ImageGeometry& geometry)
{
  ItkImage::SizeType size;
  ItkImage::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<itk::SizeValueType>(geometry.Dimensions[axis]);
    spacing[axis] = geometry.Spacing[axis];
  }
  auto image = ItkImage::New();
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->Allocate();
  return image;
}

inline ItkImage::Pointer CopyToItk(const std::vector<float>& voxels, const ImageGeometry& geometry)
{
  auto image = NewItkImage(geometry);
  std::copy(voxels.begin(), voxels.end(), image->GetBufferPointer());
  return image;
}

/// Updates a filter of ITK in a thread of its own. Returns false as soon as the monitor says stop;
/// the filter then ends alone, at its next report, and must own or share all that it uses.
/// `progress` is asked in the filter's thread at every report.
template <typename TFilter>
bool UpdateMonitored(TFilter* filter, const std::function<double(const TFilter*)>& progress,
  const Monitor& monitor)
{
  struct State
  {
    std::atomic<bool> Stopped{ false };
    std::atomic<double> Fraction{ 0 };
  };
  auto state = std::make_shared<State>();
  const typename TFilter::Pointer shared = filter;
  BackgroundTask task(
    [state, shared, progress]()
    {
      TFilter* const running = shared.GetPointer();
      running->AddObserver(itk::AnyEvent(),
        [state, running, progress](const itk::EventObject&)
        {
          state->Fraction = progress(running);
          if (state->Stopped)
          {
            running->AbortGenerateDataOn();
          }
        });
      running->Update();
      running->RemoveAllObservers();
    });
  const bool done = task.Wait([&]() { return monitor(state->Fraction); });
  state->Stopped = !done;
  return done;
}

/// The progress that most filters of ITK report.
template <typename TFilter>
double ReportedProgress(const TFilter* filter)
{
  return static_cast<double>(filter->GetProgress());
}

} // namespace FlipFree

#endif
