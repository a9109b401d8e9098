/**
 * Private to the module: the surfaces of all iterations as time steps of the pipeline. Time t is
 * the surface after iteration t.
 */
#ifndef FlipFreeIterationHistory_h
#define FlipFreeIterationHistory_h

#include "Deformation/OrganSegmentation.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkInformation;
class vtkPolyData;

namespace FlipFree
{

class IterationHistory
{
public:
  void Add(const ContourMesh& mesh, const PointList& points, const CorrespondenceField& field);
  void Clear() { this->Surfaces.clear(); }
  bool IsEmpty() const { return this->Surfaces.empty(); }

  /// Tells the pipeline of the time steps.
  void Announce(vtkInformation* output) const;

  /// Before the run, their number is not known, only an upper limit.
  static void AnnounceAtMost(double iterations, vtkInformation* output);

  /// The surface of the time that the pipeline asks for. The last one is that of the result.
  vtkPolyData* SurfaceAt(vtkInformation* output, vtkPolyData* result) const;

private:
  std::vector<vtkSmartPointer<vtkPolyData>> Surfaces;
};

} // namespace FlipFree

#endif
