#include "vtkFlipFreeDeform.h"

#include "ContourMeshAdapter.h"
#include "Deformation/DeformationStep.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "StageProperties.h"

#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>

vtkStandardNewMacro(vtkFlipFreeDeform);

using Stage = vtkFlipFreeDeform;

#define PROPERTIES(P)                                                                              \
  P(AvoidFlips, bool, Settings->AvoidFlips, false, true)                                           \
  P(FlipThreshold, double, Settings->FlipThreshold, 0, 1)                                          \
  P(PropagationIterations, int, Settings->Propagation.Iterations, 0, 100000)                       \
  P(SmoothingIterations, int, Settings->Propagation.SmoothingIterations, 0, 100000)                \
  P(PositionWeight, double, Settings->Energy.PositionWeight, 0, 1e6)                               \
  P(UniformWeight, double, Settings->Energy.UniformWeight, 0, 1e6)                                 \
  P(Fairing, double, Settings->Energy.Fairing, 0, 1)                                               \
  P(Guard, bool, Settings->Guard, false, true)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkFlipFreeDeform::vtkFlipFreeDeform()
  : Settings(std::make_unique<FlipFree::DeformationStepSettings>())
{
}

vtkFlipFreeDeform::~vtkFlipFreeDeform() = default;

void vtkFlipFreeDeform::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY) });
}

int vtkFlipFreeDeform::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  try
  {
    this->RequireProperties();
    FlipFree::DeformableSurface surface =
      FlipFree::DeformableSurfaceOf(input, "the surface on port 0", this->Settings->Guard);
    FlipFree::CorrespondenceField field = FlipFree::FieldOf(input, "the surface on port 0");
    std::unique_ptr<FlipFree::EmbeddingGuard> guard;
    if (this->Settings->Guard)
    {
      guard = std::make_unique<FlipFree::EmbeddingGuard>(surface.Mesh);
    }
    FlipFree::DeformationSolver solver(surface.Mesh);
    const FlipFree::DeformationStepReport report = FlipFree::DeformOnce(solver, guard.get(),
      *this->Settings, FlipFree::SMPFor, FlipFree::MonitorOf(this), field, surface.Points);
    if (FlipFree::IsAborted(this))
    {
      return 1;
    }
    output->ShallowCopy(input);
    output->SetPoints(FlipFree::MakePoints(surface.Points));
    // Those of the surface that was.
    output->GetPointData()->SetNormals(nullptr);
    output->GetPointData()->SetTangents(nullptr);
    output->GetCellData()->SetNormals(nullptr);
    output->GetCellData()->SetTangents(nullptr);
    FlipFree::AttachField(field, output);
    FlipFree::AddFieldValues("FlippingVertices", { static_cast<double>(report.Flipping) }, output);
    FlipFree::AddFieldValues("GuardedVertices", { static_cast<double>(report.Guarded) }, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro("Nothing deformed: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeDeform::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}
