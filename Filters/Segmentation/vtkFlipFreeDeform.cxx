#include "vtkFlipFreeDeform.h"

#include "ContourMeshAdapter.h"
#include "Deformation/DeformationStep.h"
#include "Deformation/SegmentationParameters.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "FilterReport.h"
#include "StageProperties.h"

#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <string>

vtkStandardNewMacro(vtkFlipFreeDeform);

struct vtkFlipFreeDeform::Workspace
{
  FlipFree::ContourMeshCache Meshes;
  FlipFree::ContourMeshCache::Mesh Mesh; // of the guard and the solver
  std::unique_ptr<FlipFree::EmbeddingGuard> Guard;
  std::unique_ptr<FlipFree::DeformationSolver> Solver;

  void PrepareFor(const FlipFree::ContourMeshCache::Mesh& mesh, bool guard)
  {
    if (mesh != this->Mesh)
    {
      this->Guard.reset();
      this->Solver = std::make_unique<FlipFree::DeformationSolver>(*mesh);
      this->Mesh = mesh;
    }
    if (guard && !this->Guard)
    {
      this->Guard = std::make_unique<FlipFree::EmbeddingGuard>(*mesh);
    }
  }
};

#define FLIPFREE_STAGE vtkFlipFreeDeform

#define PROPERTIES(P) FLIPFREE_STEP_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkFlipFreeDeform::vtkFlipFreeDeform()
  : Settings(std::make_unique<FlipFree::DeformationStepSettings>())
  , Kept(std::make_unique<Workspace>())
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
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  try
  {
    this->RequireProperties();
    const std::string name = "the surface{ on port 0}";
    const bool guarded = this->Settings->Guard;
    FlipFree::PointList points = FlipFree::CopyPoints(input);
    const auto mesh = this->Kept->Meshes.MeshOf(input, points, name);
    FlipFree::NamingSurface(name, [&] { this->Kept->PrepareFor(mesh, guarded); });
    if (guarded)
    {
      FlipFree::RequireEmbedded(*mesh, this->Kept->Guard->Hulls(), points, name);
    }
    FlipFree::CorrespondenceField field = FlipFree::FieldOf(input, name);
    const FlipFree::DeformationStepReport report =
      FlipFree::DeformOnce(*this->Kept->Solver, guarded ? this->Kept->Guard.get() : nullptr,
        *this->Settings, FlipFree::SMPFor, FlipFree::MonitorOf(this), field, points);
    if (FlipFree::IsAborted(this))
    {
      return 1;
    }
    output->ShallowCopy(input);
    output->SetPoints(FlipFree::MakePoints(points));
    // They belong to the surface before the step.
    output->GetPointData()->SetNormals(nullptr);
    output->GetPointData()->SetTangents(nullptr);
    output->GetCellData()->SetNormals(nullptr);
    output->GetCellData()->SetTangents(nullptr);
    FlipFree::AttachField(field, output);
    FlipFree::AddFieldValues("FlippingVertices", { static_cast<double>(report.Flipping) }, output);
    FlipFree::AddFieldValues("GuardedVertices", { static_cast<double>(report.Guarded) }, output);
    FlipFree::AttachCertificate(guarded, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("Nothing deformed: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeDeform::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
