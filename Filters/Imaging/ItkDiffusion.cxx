#include "ItkDiffusion.h"

#include "BackgroundTask.h"
#include "ItkVtkBridge.h"

#include "vtkSMPTools.h"

#include "itkCurvatureAnisotropicDiffusionImageFilter.h"
#include "itkGradientAnisotropicDiffusionImageFilter.h"

#include <algorithm>
#include <atomic>

namespace FlipFree
{
namespace
{

/// ITK's warnings go to the terminal, past VTK's; within a scope that holds one of these they are
/// off. What matters among them is checked, and reported, here.
class ItkWarningsOff
{
public:
  ItkWarningsOff()
    : WasOn(itk::Object::GetGlobalWarningDisplay())
  {
    itk::Object::SetGlobalWarningDisplay(false);
  }
  ~ItkWarningsOff() { itk::Object::SetGlobalWarningDisplay(this->WasOn); }
  ItkWarningsOff(const ItkWarningsOff&) = delete;
  void operator=(const ItkWarningsOff&) = delete;

private:
  bool WasOn;
};

using ItkImage = itk::Image<float, 3>;

/// TFilter is one of ITK's anisotropic diffusion filters. The additions may be called from any
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

template <typename TFilter>
bool Diffuse(vtkImageData* image, const ItkDiffusionSettings& settings, const Monitor& monitor)
{
  const ItkWarningsOff quiet; // one of the two filters warns as if spacings were 1
  auto filter = MonitoredDiffusion<TFilter>::New();
  filter->SetInput(ShareWithItk<float>(image));
  filter->InPlaceOn(); // into VTK's own array
  filter->SetUseImageSpacing(true);
  filter->SetNumberOfIterations(static_cast<unsigned int>(settings.Iterations));
  filter->SetTimeStep(settings.TimeStep);
  filter->SetConductanceParameter(settings.Conductance);
  filter->SetFixedAverageGradientMagnitude(settings.GradientScale);
  filter->SetNumberOfWorkUnits(
    static_cast<itk::ThreadIdType>(vtkSMPTools::GetEstimatedNumberOfThreads()));

  BackgroundTask task([filter]() { filter->Update(); });
  const double work = static_cast<double>(image->GetNumberOfPoints()) * settings.Iterations;
  const bool done =
    task.Wait([&]() { return monitor(static_cast<double>(filter->GetVoxelsDone()) / work); });
  if (!done)
  {
    filter->Stop();
    try
    {
      task.Wait([]() { return true; });
    }
    catch (const itk::ProcessAborted&)
    {
    }
  }
  image->GetPointData()->GetScalars()->Modified();
  return done;
}

} // namespace

bool DiffuseByItk(vtkImageData* image, const ItkDiffusionSettings& settings, const Monitor& monitor)
{
  return settings.Curvature
    ? Diffuse<itk::CurvatureAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>(image, settings,
        monitor)
    : Diffuse<itk::GradientAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>(image, settings,
        monitor);
}

} // namespace FlipFree
