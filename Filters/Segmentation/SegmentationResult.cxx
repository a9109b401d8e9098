#include "SegmentationResult.h"

#include "ContourMeshAdapter.h"
#include "TableAdapter.h"

#include "Deformation/ConvergenceColumns.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

namespace FlipFree
{

void SegmentationResult::Store(const VolumeSegmentation& result, bool guarded)
{
  const OrganSurface& organ = result.Organ;
  AddColumns(this->Convergence, ConvergenceColumns(), organ.Iterations);
  AddColumns(this->Questions, QuestionColumns(), result.Questions);
  if (organ.Reason == StopReason::Aborted)
  {
    this->History.Clear();
    return;
  }
  AttachMesh(organ.Mesh, organ.Points, this->Surface);
  AttachField(organ.Field, this->Surface);
  AttachConfidence(result.Confidence, this->Surface);
  AttachCertificate(guarded, this->Surface);
  AttachProvenance(this->Provenance, this->Surface);
}

bool SegmentationResult::IsUpToDate(vtkInformationVector** inputs, vtkMTimeType filterTime) const
{
  if (this->Time < filterTime)
  {
    return false;
  }
  for (int port = 0; port < 4; ++port)
  {
    for (int index = 0; index < inputs[port]->GetNumberOfInformationObjects(); ++index)
    {
      vtkDataObject* const input = vtkDataObject::GetData(inputs[port], index);
      if (input && this->Time < input->GetMTime())
      {
        return false;
      }
    }
  }
  return true;
}

void SegmentationResult::CopyTo(vtkInformationVector* outputs) const
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* surface = this->Surface;
  if (!this->History.IsEmpty())
  {
    this->History.Announce(info);
    surface = this->History.SurfaceAt(info, surface);
  }
  vtkPolyData::GetData(outputs, 0)->ShallowCopy(surface);
  vtkImageData::GetData(outputs, 1)->ShallowCopy(this->Labels);
  vtkTable::GetData(outputs, 2)->ShallowCopy(this->Convergence);
  vtkTable::GetData(outputs, 3)->ShallowCopy(this->Questions);
}

} // namespace FlipFree
