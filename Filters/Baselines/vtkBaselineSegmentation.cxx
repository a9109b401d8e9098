#include "vtkBaselineSegmentation.h"

#include "BaselineTask.h"
#include "FieldSurface.h"

#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "Mesh/SurfaceTopology.h"
#include "Mesh/SurfaceVoxelization.h"
#include "MeshAdapter.h"
#include "PipelineAdapter.h"
#include "PropertyCheck.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace
{

constexpr const char* InputName = "the image on port 0";

// As vtkFlipFreeSegmentation has them.
constexpr double ReachInRadii = 10;
constexpr double MinimumReach = 100;
constexpr double MaximumReach = 250;

// Shares of the progress.
constexpr double MethodBegins = 0.1;
constexpr double MethodEnds = 0.95;

double ReachOf(double reach, double seedRadius)
{
  return reach > 0 ? reach
                   : std::max(MinimumReach, std::min(MaximumReach, ReachInRadii * seedRadius));
}

vtkSmartPointer<vtkCellArray> ClosedLine(vtkIdType size)
{
  auto line = vtkSmartPointer<vtkCellArray>::New();
  line->InsertNextCell(static_cast<int>(size + 1));
  for (vtkIdType i = 0; i <= size; ++i)
  {
    line->InsertCellPoint(i % size);
  }
  return line;
}

} // namespace

vtkBaselineSegmentation::vtkBaselineSegmentation()
{
  this->SetNumberOfOutputPorts(2);
}

vtkPolyData* vtkBaselineSegmentation::GetSurface()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkImageData* vtkBaselineSegmentation::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkBaselineSegmentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkBaselineSegmentation::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

int vtkBaselineSegmentation::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector*)
{
  FlipFree::RequestWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkBaselineSegmentation::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  FlipFree::AnnounceLabelMap(inputs[0]->GetInformationObject(0), outputs->GetInformationObject(1));
  return 1;
}

int vtkBaselineSegmentation::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkPolyData* surface = vtkPolyData::GetData(outputs, 0);
  vtkImageData* labels = vtkImageData::GetData(outputs, 1);
  surface->Initialize();
  labels->Initialize();
  this->NumberOfIterations = 0;
  try
  {
    this->Segment(vtkImageData::GetData(inputs[0]), surface, labels);
  }
  catch (const std::exception& error)
  {
    surface->Initialize();
    labels->Initialize();
    this->NumberOfIterations = 0;
    vtkErrorMacro("No segmentation: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkBaselineSegmentation::RequireProperties()
{
  FlipFree::RequireNumbers({ { "Reach", this->Reach } });
}

void vtkBaselineSegmentation::Segment(vtkImageData* image, vtkPolyData* surface,
  vtkImageData* labels)
{
  this->RequireProperties();
  FlipFree::RequireGrayImage(image, InputName);
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::BaselineTask task;
  task.Seed = { Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::RequireSeed(geometry, task.Seed, InputName);

  const FlipFree::VoxelBox box =
    FlipFree::BoxAround(geometry, task.Seed.Center, ReachOf(this->Reach, this->SeedRadius));
  FlipFree::RequireFinite(image, box, InputName);
  if (FlipFree::VoxelsInSphere(FlipFree::CropGeometry(geometry, box), task.Seed).empty())
  {
    throw std::invalid_argument("no voxel center of " + std::string(InputName) +
      " lies in the seed sphere; enlarge it, or move it onto one");
  }
  task.Noise = FlipFree::NoiseOf(image, task.Seed);
  FlipFree::AnisotropicDiffusionSettings diffusion;
  diffusion.Iterations = this->DiffusionIterations;
  diffusion.Contrast = FlipFree::ContrastOfNoise(task.Noise);
  FlipFree::BaselineResult result;
  if (!FlipFree::SmoothRegionOf(image, box, diffusion, FlipFree::MonitorOf(this, 0, MethodBegins),
        task.Region) ||
    !this->Segment(task, FlipFree::MonitorOf(this, MethodBegins, MethodEnds), result))
  {
    return;
  }

  std::vector<FlipFree::VoxelRun> runs;
  if (result.Field.empty())
  {
    runs = FlipFree::VoxelizeSurface(result.Points, result.Triangles, geometry, FlipFree::SMPFor);
  }
  else
  {
    const FlipFree::ImageView<float> field{ result.Field.data(), task.Region.Geometry };
    runs = FlipFree::RunsOfField(field, box.Begin);
    if (result.Points.rows() == 0)
    {
      FlipFree::FieldSurface contour = FlipFree::SurfaceOfField(field);
      result.Points = std::move(contour.Points);
      result.Triangles = std::move(contour.Triangles);
    }
  }
  if (runs.empty())
  {
    throw std::invalid_argument("nothing was found that hangs together with the seed sphere; check "
                                "that it lies in the organ, or enlarge it");
  }
  surface->SetPoints(FlipFree::MakePoints(result.Points));
  if (result.Triangles.rows() > 0)
  {
    surface->SetPolys(FlipFree::MakePolys(FlipFree::FacesOf(result.Triangles)));
  }
  else
  {
    surface->SetLines(ClosedLine(surface->GetNumberOfPoints()));
  }
  FlipFree::MakeLabelMap(runs, static_cast<unsigned char>(this->LabelValue), image, labels);
  this->NumberOfIterations = result.Iterations;
  this->UpdateProgress(1);
}

void vtkBaselineSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  os << indent << "LabelValue: " << this->LabelValue << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "DiffusionIterations: " << this->DiffusionIterations << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
}
