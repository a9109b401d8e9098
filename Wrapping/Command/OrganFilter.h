/**
 * What the filters of organs and of vessels have in common, by which the command runs them,
 * writes what they have found, and reports it.
 */
#ifndef FlipFreeCommandOrganFilter_h
#define FlipFreeCommandOrganFilter_h

#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <string>

class vtkAlgorithm;
class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace Command
{

class OrganFilter
{
public:
  virtual ~OrganFilter() = default;

  virtual vtkAlgorithm* Algorithm() const = 0;
  virtual vtkPolyData* Surface() const = 0;
  virtual vtkImageData* LabelMap() const = 0;
  virtual vtkTable* Convergence() const = 0;
  virtual int StopReason() const = 0; ///< of vtkFlipFreeSegmentation::StopReasons
  virtual std::string StopReasonText() const = 0;
  virtual int SelfIntersections() const = 0;
  virtual std::array<double, 4> StageSeconds() const = 0;
};

template <typename Filter>
class OrganFilterOf : public OrganFilter
{
public:
  explicit OrganFilterOf(vtkSmartPointer<Filter> filter)
    : Wrapped(filter)
  {
  }

  Filter* Algorithm() const override { return this->Wrapped; }
  vtkPolyData* Surface() const override { return this->Wrapped->GetSurface(); }
  vtkImageData* LabelMap() const override { return this->Wrapped->GetLabelMap(); }
  vtkTable* Convergence() const override { return this->Wrapped->GetConvergence(); }
  int StopReason() const override { return this->Wrapped->GetStopReason(); }
  std::string StopReasonText() const override { return this->Wrapped->GetStopReasonAsString(); }
  int SelfIntersections() const override { return this->Wrapped->GetNumberOfSelfIntersections(); }
  std::array<double, 4> StageSeconds() const override
  {
    std::array<double, 4> seconds;
    this->Wrapped->GetStageSeconds(seconds.data());
    return seconds;
  }

private:
  vtkSmartPointer<Filter> Wrapped;
};

} // namespace Command

#endif
