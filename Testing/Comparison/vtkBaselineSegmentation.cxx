#include "vtkBaselineSegmentation.h"

#include "BaselineTask.h"
#include "FieldSurface.h"
#include "FilterReport.h"
#include "MaskVoxels.h"
#include "PathEnds.h"

#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "Image/SmoothRegion.h"
#include "LabelAdapter.h"
#include "Mesh/SurfaceTopology.h"
#include "Mesh/SurfaceVoxelization.h"
#include "MeshAdapter.h"
#include "PipelineAdapter.h"
#include "PropertyCheck.h"
#include "StageProperties.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

constexpr const char* InputName = "the image{ on port 0}";

// Shares of the progress.
constexpr double MethodBegins = 0.1;
constexpr double MethodEnds = 0.95;

// Repeated points are left out: a plane across the path needs a direction.
FlipFree::PathLines LinesOf(vtkPolyData* path)
{
  FlipFree::PathLines lines;
  for (vtkIdType line = 0; line < path->GetNumberOfLines(); ++line)
  {
    vtkNew<vtkIdList> places;
    path->GetLines()->GetCellAtId(line, places);
    FlipFree::PointList points(places->GetNumberOfIds(), 3);
    Eigen::Index size = 0;
    for (vtkIdType place = 0; place < places->GetNumberOfIds(); ++place)
    {
      points.row(size) = Eigen::Vector3d(path->GetPoint(places->GetId(place)));
      size += size == 0 || points.row(size) != points.row(size - 1);
    }
    points.conservativeResize(size, Eigen::NoChange);
    if (size < 2 || !points.allFinite())
    {
      throw FlipFree::Error(FlipFree::ErrorCode::InvalidLine,
        "line " + std::to_string(line) +
          "{ on port 1} has no two points that differ, or one that is not a number; give the lines "
          "that vtkVesselPath finds");
    }
    lines.push_back(points);
  }
  if (lines.empty())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::InvalidLine,
      "there is no line{ on port 1}; give those that vtkVesselPath finds, or disconnect it");
  }
  return lines;
}

// Offsets in the region that is cropped for the seeds, ascending.
std::vector<std::size_t> VoxelsOfSeeds(const std::vector<FlipFree::SeedSphere>& seeds,
  const FlipFree::BitMask& beyond)
{
  FlipFree::BitMask mask(beyond.GetGeometry());
  for (const FlipFree::SeedSphere& seed : seeds)
  {
    const auto voxels = FlipFree::VoxelsInSphere(mask.GetGeometry(), seed);
    if (voxels.empty())
    {
      throw FlipFree::Error(FlipFree::ErrorCode::SeedWithoutVoxels,
        "no voxel center of " + std::string(InputName) +
          " lies in the seed sphere; raise {SeedRadius} beyond a voxel, or move the sphere onto "
          "one");
    }
    for (const std::size_t voxel : voxels)
    {
      FlipFree::InsertVoxel(mask, voxel);
    }
  }
  mask.Remove(beyond);
  if (mask.Count() == 0)
  {
    throw FlipFree::Error(FlipFree::ErrorCode::SeedWithoutVoxels,
      "the seeds lie beyond the ends of the path{ on port 1}; move them "
      "onto the path, or disconnect it");
  }
  return FlipFree::OffsetsOf(mask);
}

// To the methods, what lies beyond the ends does not look like an organ.
void HideVoxels(const FlipFree::BitMask& hidden, std::vector<float>& voxels)
{
  const auto [least, greatest] = std::minmax_element(voxels.begin(), voxels.end());
  const float nothing = *least - 1000 * (1 + *greatest - *least);
  hidden.ForEach([&voxels, nothing](std::size_t voxel) { voxels[voxel] = nothing; });
}

// What a method has found, as voxels of the image; a field gets a surface, unless it has an
// outline.
std::vector<FlipFree::VoxelRun> TakeVoxels(const FlipFree::ImageGeometry& image,
  const FlipFree::ImageGeometry& region, const std::array<int, 3>& first,
  FlipFree::BaselineResult& result)
{
  if (result.Field.empty())
  {
    return FlipFree::VoxelizeSurface(result.Points, result.Triangles, image, FlipFree::SMPFor);
  }
  const FlipFree::ImageView<float> field{ result.Field.data(), region };
  if (result.Points.rows() == 0)
  {
    FlipFree::FieldSurface contour = FlipFree::SurfaceOfField(field);
    result.Points = std::move(contour.Points);
    result.Triangles = std::move(contour.Triangles);
  }
  return FlipFree::RunsOfField(field, first);
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

// Of points without triangles, a closed line.
void AttachSurface(const FlipFree::BaselineResult& result, vtkPolyData* surface)
{
  surface->SetPoints(FlipFree::MakePoints(result.Points));
  if (result.Triangles.rows() > 0)
  {
    surface->SetPolys(FlipFree::MakePolys(FlipFree::FacesOf(result.Triangles)));
  }
  else
  {
    surface->SetLines(ClosedLine(surface->GetNumberOfPoints()));
  }
}

} // namespace

vtkBaselineSegmentation::vtkBaselineSegmentation()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

void vtkBaselineSegmentation::SetSeedRadius(double value)
{
  FlipFree::SetSeedRadius(this, value, this->SeedRadius);
}

void vtkBaselineSegmentation::AddFurtherSeed(double x, double y, double z, double radius)
{
  this->FurtherSeeds.push_back({ { x, y, z, radius } });
  this->Modified();
}

void vtkBaselineSegmentation::RemoveAllFurtherSeeds()
{
  if (!this->FurtherSeeds.empty())
  {
    this->FurtherSeeds.clear();
    this->Modified();
  }
}

void vtkBaselineSegmentation::SetPathData(vtkPolyData* path)
{
  this->SetInputDataObject(1, path);
}

vtkPolyData* vtkBaselineSegmentation::GetSurface()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkImageData* vtkBaselineSegmentation::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkBaselineSegmentation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
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
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* surface = vtkPolyData::GetData(outputs, 0);
  vtkImageData* labels = vtkImageData::GetData(outputs, 1);
  surface->Initialize();
  labels->Initialize();
  this->NumberOfIterations = 0;
  try
  {
    this->Segment(vtkImageData::GetData(inputs[0]), vtkPolyData::GetData(inputs[1]), surface,
      labels);
  }
  catch (const std::exception& error)
  {
    surface->Initialize();
    labels->Initialize();
    this->NumberOfIterations = 0;
    FlipFreeErrorMacro("No segmentation: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkBaselineSegmentation::RequireProperties()
{
  FlipFree::RequireNumbers({ { "Reach", this->Reach } });
}

std::vector<FlipFree::SeedSphere> vtkBaselineSegmentation::Seeds() const
{
  std::vector<FlipFree::SeedSphere> seeds{ { Eigen::Vector3d(this->SeedCenter),
    this->SeedRadius } };
  for (const std::array<double, 4>& seed : this->FurtherSeeds)
  {
    seeds.push_back({ { seed[0], seed[1], seed[2] }, seed[3] });
  }
  return seeds;
}

void vtkBaselineSegmentation::Segment(vtkImageData* image, vtkPolyData* path, vtkPolyData* surface,
  vtkImageData* labels)
{
  this->RequireProperties();
  FlipFree::RequireGrayImage(image, InputName);
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::BaselineTask task;
  task.Seeds = this->Seeds();
  FlipFree::SmoothingSettings settings; // for the default reach
  settings.Reach = this->Reach;
  FlipFree::VoxelBox box;
  for (const FlipFree::SeedSphere& seed : task.Seeds)
  {
    FlipFree::RequireSeed(geometry, seed, InputName);
    FlipFree::RequireReach(settings, seed.Radius);
    box = box.Joined(
      FlipFree::BoxAround(geometry, seed.Center, FlipFree::ReachOf(settings, seed.Radius)));
  }
  FlipFree::RequireFinite(image, box, InputName);
  FlipFree::BitMask beyond(FlipFree::CropGeometry(geometry, box));
  if (path)
  {
    beyond = FlipFree::VoxelsBeyondEnds(LinesOf(path), beyond.GetGeometry(), FlipFree::SMPFor);
  }
  task.SeedVoxels = VoxelsOfSeeds(task.Seeds, beyond);
  for (const FlipFree::SeedSphere& seed : task.Seeds)
  {
    task.Noise += FlipFree::NoiseOf(image, seed) / static_cast<double>(task.Seeds.size());
  }
  FlipFree::AnisotropicDiffusionSettings diffusion;
  diffusion.Iterations = this->DiffusionIterations;
  diffusion.Contrast = FlipFree::ContrastOfNoise(task.Noise);
  FlipFree::BaselineResult result;
  if (!FlipFree::SmoothRegionOf(image, box, diffusion, FlipFree::MonitorOf(this, 0, MethodBegins),
        task.Region))
  {
    return;
  }
  HideVoxels(beyond, task.Region.Voxels);
  if (!this->Segment(task, FlipFree::MonitorOf(this, MethodBegins, MethodEnds), result))
  {
    return;
  }
  if (!result.Field.empty())
  {
    // A rim may have been added.
    beyond.ForEach([&result](std::size_t voxel) { result.Field[voxel] = -1; });
  }
  const std::vector<FlipFree::VoxelRun> runs =
    TakeVoxels(geometry, task.Region.Geometry, box.Begin, result);
  if (runs.empty())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::NoContrast,
      "nothing was found that is connected to the seed sphere; check "
      "that it lies in the organ, or raise {SeedRadius}");
  }
  AttachSurface(result, surface);
  FlipFree::MakeLabelMap(runs, static_cast<unsigned char>(this->LabelValue), image, labels);
  this->NumberOfIterations = result.Iterations;
  this->UpdateProgress(1);
}
