// The surfaces of the labels of label maps, exact and smooth, both also as coarse as the tolerance
// allows, and exact ones of parts of at least 100 mm3 without cavities; beside them those of the
// usual chain, as 3D Slicer has it: vtkDiscreteFlyingEdges3D and vtkWindowedSincPolyDataFilter, a
// label at a time.
//
//   MeasureLabelSurfaces [--folder DIR] LABELS ...
//
// A row per label map and way:
//
//   invalid    labels whose STL file, read back, is not closed, has an edge on other than two
//              triangles, or has triangles that intersect, as CGAL finds them
//   differing  voxels that are other ones once the surfaces are voxelized; "-" where some cannot be
//   rough      angle between the normals of neighboring triangles, degrees: root of the mean
//              square, and median, over all labels
//   volume     greatest deviation of labels of more than 1,000 voxels, percent
//   collapse   greatest distance to the walls before edges were collapsed, mm
//   seconds    in memory, without files; memory is the peak above that of the label map
#include "CaseList.h"
#include "FindWithCGAL.h"
#include "LabelAdapter.h"
#include "Mesh/SurfaceTopology.h"
#include "Stopwatch.h"
#include "SurfaceAdapter.h"

#include "vtkDiscreteFlyingEdges3D.h"
#include "vtkFieldData.h"
#include "vtkFlipFreeLabelSurfaces.h"
#include "vtkImageConstantPad.h"
#include "vtkImageData.h"
#include "vtkMedicalImageReader.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkWindowedSincPolyDataFilter.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

namespace
{

using Surfaces = std::map<int, vtkSmartPointer<vtkPolyData>>;

enum class Mode
{
  Fine,
  Coarse,
  LargeParts
};

Surfaces ByFlipFree(vtkImageData* labels, bool exact, Mode mode, double& collapse)
{
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(labels);
  filter->SetExact(exact);
  filter->SetTriangles(mode == Mode::Coarse ? 1 : 0);
  filter->SetSmallestPart(mode == Mode::LargeParts ? 100 : 0);
  filter->SetFillCavities(mode == Mode::LargeParts);
  filter->Update();
  collapse = filter->GetCollapseDistance();
  Surfaces surfaces;
  for (unsigned int block = 0; block < filter->GetSurfaces()->GetNumberOfBlocks(); ++block)
  {
    auto* const surface = vtkPolyData::SafeDownCast(filter->GetSurfaces()->GetBlock(block));
    if (surface->GetNumberOfPolys() == 0)
    {
      continue; // no part is large enough
    }
    surfaces[static_cast<int>(surface->GetFieldData()->GetArray("Label")->GetTuple1(0))] = surface;
  }
  return surfaces;
}

// With 3D Slicer's default, a smoothing factor of 0.5, and closed at the image's border as there.
Surfaces ByUsualChain(vtkImageData* labels, const std::map<int, std::size_t>& voxels)
{
  int extent[6];
  labels->GetExtent(extent);
  vtkNew<vtkImageConstantPad> padded;
  padded->SetInputData(labels);
  padded->SetOutputWholeExtent(extent[0] - 1, extent[1] + 1, extent[2] - 1, extent[3] + 1,
    extent[4] - 1, extent[5] + 1);
  padded->Update();
  // The contour filter places images by their origin, whatever their first index is.
  vtkImageData* const image = padded->GetOutput();
  double origin[3];
  labels->TransformContinuousIndexToPhysicalPoint(extent[0] - 1, extent[2] - 1, extent[4] - 1,
    origin);
  image->SetDimensions(image->GetDimensions());
  image->SetOrigin(origin);
  image->SetDirectionMatrix(labels->GetDirectionMatrix());
  Surfaces surfaces;
  for (const auto& label : voxels)
  {
    vtkNew<vtkDiscreteFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, label.first);
    vtkNew<vtkWindowedSincPolyDataFilter> smooth;
    smooth->SetInputConnection(edges->GetOutputPort());
    smooth->SetNumberOfIterations(40);
    smooth->SetPassBand(0.01);
    smooth->BoundarySmoothingOff();
    smooth->FeatureEdgeSmoothingOff();
    smooth->NonManifoldSmoothingOn();
    smooth->NormalizeCoordinatesOn();
    smooth->Update();
    surfaces[label.first] = smooth->GetOutput();
  }
  return surfaces;
}

bool IsValidFile(vtkPolyData* surface, const std::string& name)
{
  if (surface->GetNumberOfPolys() == 0)
  {
    return false;
  }
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName(name.c_str());
  writer->SetFileTypeToBinary();
  writer->Write();
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  const auto found = FlipFree::SurfaceOf(reader->GetOutput(), "the surface");
  for (const FlipFree::SurfaceEdge& edge :
    FlipFree::CollectEdges(static_cast<int>(found.Points.rows()), found.Faces))
  {
    if (edge.Forward != 1 || edge.Backward != 1)
    {
      return false;
    }
  }
  try
  {
    return FlipFree::FindWithCGAL(found.Points, found.Faces).empty();
  }
  catch (const std::invalid_argument&)
  {
    return false; // a vertex that is not manifold
  }
}

void AppendAngles(const FlipFree::PolygonalSurface& surface, std::vector<double>& angles)
{
  const auto normal = [&surface](int triangle) -> Eigen::Vector3d
  {
    const auto at = [&](int corner) -> Eigen::Vector3d
    { return surface.Points.row(surface.Triangles(triangle, corner)); };
    return (at(1) - at(0)).cross(at(2) - at(0));
  };
  for (const FlipFree::SurfaceEdge& edge :
    FlipFree::CollectEdges(static_cast<int>(surface.Points.rows()), surface.Faces))
  {
    if (edge.Faces[1] >= 0)
    {
      const Eigen::Vector3d one = normal(edge.Faces[0]);
      const Eigen::Vector3d two = normal(edge.Faces[1]);
      angles.push_back(std::atan2(one.cross(two).norm(), one.dot(two)) * 180 / 3.141592653589793);
    }
  }
}

// The labels of the voxels in the surfaces; false where one is not closed.
bool Voxelize(const Surfaces& surfaces, vtkImageData* labels, std::vector<int>& voxels)
{
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(labels);
  voxels.assign(geometry.NumberOfVoxels(), 0);
  for (const auto& [label, data] : surfaces)
  {
    try
    {
      const auto surface = FlipFree::SurfaceOf(data, "the surface");
      FlipFree::FillRuns(
        FlipFree::VoxelizeSurface(surface.Points, surface.Triangles, geometry, FlipFree::SMPFor),
        label, geometry, voxels.data());
    }
    catch (const FlipFree::Error&)
    {
      return false;
    }
  }
  return true;
}

struct Way
{
  const char* Name;
  std::function<Surfaces()> Make;
};

void Measure(const std::string& file, const std::string& folder)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* const labels = reader->GetOutput();
  std::vector<int> wanted;
  FlipFree::VisitVoxels(labels, "the label map",
    [&](const auto& view)
    {
      wanted.assign(view.Data, view.Data + view.Geometry.NumberOfVoxels());
      return 0;
    });
  std::map<int, std::size_t> voxels;
  for (const int label : wanted)
  {
    if (label != 0)
    {
      ++voxels[label];
    }
  }
  const std::string name = std::filesystem::path(file).stem().stem().string();
  double collapse = 0;
  const auto ours = [&](bool exact, Mode mode)
  { return [&, exact, mode] { return ByFlipFree(labels, exact, mode, collapse); }; };
  for (const Way& way :
    { Way{ "exact", ours(true, Mode::Fine) }, Way{ "exact, coarse", ours(true, Mode::Coarse) },
      Way{ "exact, large parts", ours(true, Mode::LargeParts) },
      Way{ "smooth", ours(false, Mode::Fine) }, Way{ "smooth, coarse", ours(false, Mode::Coarse) },
      Way{ "usual chain", [&] { return ByUsualChain(labels, voxels); } } })
  {
    collapse = 0;
    const double before = ResetPeakMemory();
    FlipFree::Stopwatch watch;
    const Surfaces surfaces = way.Make();
    const double seconds = watch.Lap();
    const double memory = PeakMemory() - before;
    int invalid = 0;
    std::vector<double> angles;
    double deviation = 0;
    std::size_t triangles = 0;
    for (const auto& [label, data] : surfaces)
    {
      invalid += IsValidFile(data, folder + "/flipfree-label.stl") ? 0 : 1;
      if (data->GetNumberOfPolys() == 0)
      {
        continue;
      }
      const auto surface = FlipFree::SurfaceOf(data, "the surface");
      AppendAngles(surface, angles);
      triangles += static_cast<std::size_t>(surface.Triangles.rows());
      const double volume = std::abs(FlipFree::EnclosedVolume(surface.Points, surface.Triangles)) /
        FlipFree::GeometryOf(labels).VoxelVolume();
      if (voxels[label] > 1000)
      {
        deviation =
          std::max(deviation, std::abs(volume / static_cast<double>(voxels[label]) - 1) * 100);
      }
    }
    std::vector<int> found;
    std::string differing = "-";
    if (Voxelize(surfaces, labels, found))
    {
      std::size_t count = 0;
      for (std::size_t voxel = 0; voxel < found.size(); ++voxel)
      {
        count += found[voxel] != wanted[voxel] ? 1 : 0;
      }
      differing = std::to_string(count);
    }
    double squares = 0;
    for (const double angle : angles)
    {
      squares += angle * angle;
    }
    std::nth_element(angles.begin(),
      angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2), angles.end());
    std::printf("| %s | %s | %zu | %zu | %d | %s | %.1f, %.1f | %.2f | %.2f | %.2f | %.0f |\n",
      name.c_str(), way.Name, voxels.size(), triangles, invalid, differing.c_str(),
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, angles.size()))),
      angles.empty() ? 0.0 : angles[angles.size() / 2], deviation, collapse, seconds,
      memory / (1 << 20));
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  std::string folder = std::filesystem::temp_directory_path().string();
  std::vector<std::string> files;
  CLI::App app("Measures surfaces of labels, ours and those of the usual chain.");
  app.add_option("--folder", folder, "where files are written")->capture_default_str();
  app.add_option("labels", files, "label maps")->required();
  CLI11_PARSE(app, argc, argv);
  std::puts(
    "| label map | way | labels | triangles | invalid | differing | rough | volume, % | "
    "collapse, mm | seconds | memory, MiB |\n|---|---|---|---|---|---|---|---|---|---|---|");
  try
  {
    for (const std::string& file : files)
    {
      Measure(file, folder);
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
