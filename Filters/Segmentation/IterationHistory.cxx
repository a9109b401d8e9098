#include "IterationHistory.h"

#include "ContourMeshAdapter.h"

#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <numeric>

namespace FlipFree
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

void IterationHistory::Add(const ContourMesh& mesh, const PointList& points,
  const CorrespondenceField& field)
{
  this->Surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
  AttachMesh(mesh, points, this->Surfaces.back());
  AttachField(field, this->Surfaces.back());
}

void IterationHistory::Announce(vtkInformation* output) const
{
  std::vector<double> times(std::max<std::size_t>(1, this->Surfaces.size()));
  std::iota(times.begin(), times.end(), 1.0);
  const double range[2] = { times.front(), times.back() };
  output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output->Set(Pipeline::TIME_RANGE(), range, 2);
}

void IterationHistory::AnnounceAtMost(double iterations, vtkInformation* output)
{
  const double range[2] = { 1, std::max(1.0, iterations) };
  output->Remove(Pipeline::TIME_STEPS());
  output->Set(Pipeline::TIME_RANGE(), range, 2);
}

vtkPolyData* IterationHistory::SurfaceAt(vtkInformation* output, vtkPolyData* result) const
{
  if (!output->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    return result;
  }
  const auto size = static_cast<int>(this->Surfaces.size());
  const double time = output->Get(Pipeline::UPDATE_TIME_STEP());
  const int step = static_cast<int>(std::max(1.0, std::min<double>(time, size)));
  vtkPolyData* surface = step < size ? this->Surfaces[step - 1].Get() : result;
  surface->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  return surface;
}

} // namespace FlipFree
