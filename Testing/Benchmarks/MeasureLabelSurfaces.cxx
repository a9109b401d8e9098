// The surfaces of the labels of label maps, exact and smooth, both also as coarse as the tolerance
// allows, and exact ones of parts of at least 100 mm3 without cavities; beside them those of the
// usual chain, as 3D Slicer has it: vtkDiscreteFlyingEdges3D and vtkWindowedSincPolyDataFilter, a
// label at a time; and those of surface nets and zmesh, where a Python has them
// (label_surface_peers.py). With --fill, TetGen and gmsh fill all with tetrahedra.
//
//   MeasureLabelSurfaces [--folder DIR] [--peers PYTHON [--fill]] LABELS ...
//
// A row per label map and way:
//
//   invalid    labels without a surface, or whose STL file, read back, is not closed, has an edge
//              on other than two triangles, or has triangles that intersect, as CGAL finds them
//   differing  voxels that are other ones once the surfaces are voxelized; those that are not
//              closed, by vtkPolyDataToImageStencil
//   rough      angle between the normals of neighboring triangles, degrees: root of the mean
//              square, and median, over all labels
//   volume     greatest deviation of labels of more than 1,000 voxels, percent
//   collapse   greatest distance to the walls before edges were collapsed, mm
//   seconds    in memory, without files; memory is the peak above that of the label map (of what
//              Python made, that of reading it back)
//   not filled labels that TetGen and gmsh do not fill (fill_surfaces.py)
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
#include "vtkImageStencilData.h"
#include "vtkMedicalImageReader.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataToImageStencil.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkWindowedSincPolyDataFilter.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>

namespace
{

namespace fs = std::filesystem;
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

vtkSmartPointer<vtkPolyData> ReadStl(const std::string& file)
{
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
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
  const auto found = FlipFree::SurfaceOf(ReadStl(name), "the surface");
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

// Adds the voxels in a surface that is not closed everywhere, as VTK's stencil has them.
void FillByStencil(vtkPolyData* surface, int label, const FlipFree::ImageGeometry& geometry,
  std::vector<int>& voxels)
{
  vtkNew<vtkPoints> points;
  points->DeepCopy(surface->GetPoints());
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    const Eigen::Map<const Eigen::Vector3d> place(surface->GetPoint(point));
    points->SetPoint(point, geometry.ToIndex(place).data());
  }
  vtkNew<vtkPolyData> inIndices;
  inIndices->ShallowCopy(surface);
  inIndices->SetPoints(points);
  vtkNew<vtkPolyDataToImageStencil> stencil;
  stencil->SetInputData(inIndices);
  stencil->SetOutputWholeExtent(0, geometry.Dimensions[0] - 1, 0, geometry.Dimensions[1] - 1, 0,
    geometry.Dimensions[2] - 1);
  stencil->Update();
  for (int k = 0; k < geometry.Dimensions[2]; ++k)
  {
    for (int j = 0; j < geometry.Dimensions[1]; ++j)
    {
      int begin = 0;
      int end = 0;
      for (int next = 0; stencil->GetOutput()->GetNextExtent(begin, end, 0,
                           geometry.Dimensions[0] - 1, j, k, next) != 0;)
      {
        std::fill(&voxels[geometry.Offset(begin, j, k)], &voxels[geometry.Offset(end, j, k)] + 1,
          label);
      }
    }
  }
}

// The labels of the voxels in the surfaces.
std::vector<int> Voxelize(const Surfaces& surfaces, vtkImageData* labels)
{
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(labels);
  std::vector<int> voxels(geometry.NumberOfVoxels(), 0);
  for (const auto& [label, data] : surfaces)
  {
    if (data->GetNumberOfPolys() == 0)
    {
      continue;
    }
    try
    {
      const auto surface = FlipFree::SurfaceOf(data, "the surface");
      FlipFree::FillRuns(
        FlipFree::VoxelizeSurface(surface.Points, surface.Triangles, geometry, FlipFree::SMPFor),
        label, geometry, voxels.data());
    }
    catch (const FlipFree::Error&)
    {
      FillByStencil(data, label, geometry, voxels);
    }
  }
  return voxels;
}

struct Way
{
  std::string Name;
  std::function<Surfaces()> Make;
  double Seconds = 0;     // if it was timed elsewhere
  bool LeavesOut = false; // labels without a large part
};

// How many surfaces TetGen and gmsh do not fill: some of a folder, and those that are missing.
std::string UnfilledIn(const fs::path& folder, int missing, const std::string& python)
{
  const std::string command =
    python + " \"" FLIPFREE_FILL_SURFACES "\" \"" + folder.string() + "\"";
  const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), &pclose);
  int counts[2] = { -1, -1 };
  if (!output || std::fscanf(output.get(), "%d %d", &counts[0], &counts[1]) != 2)
  {
    throw std::runtime_error("failed: " + command);
  }
  return std::to_string(counts[0] + missing) + ", " + std::to_string(counts[1] + missing);
}

// What a Python with other software makes of a label map.
std::vector<Way> PeersOf(const std::string& python, const std::string& file, const fs::path& folder)
{
  fs::remove_all(folder);
  const std::string command =
    python + " \"" FLIPFREE_LABEL_SURFACE_PEERS "\" \"" + file + "\" \"" + folder.string() + "\"";
  if (std::system(command.c_str()) != 0)
  {
    throw std::runtime_error("failed: " + command);
  }
  std::vector<Way> ways;
  for (const fs::directory_entry& way : fs::directory_iterator(folder))
  {
    const auto read = [way]
    {
      Surfaces surfaces;
      for (const fs::directory_entry& entry : fs::directory_iterator(way))
      {
        if (entry.path().extension() == ".stl")
        {
          surfaces[std::stoi(entry.path().stem())] = ReadStl(entry.path());
        }
      }
      return surfaces;
    };
    double seconds = 0;
    std::ifstream(way.path() / "seconds") >> seconds;
    ways.push_back({ way.path().filename(), read, seconds });
  }
  std::sort(ways.begin(), ways.end(),
    [](const Way& one, const Way& other) { return one.Name < other.Name; });
  return ways;
}

void Measure(const std::string& file, const std::string& folder, const std::string& peers,
  bool fill)
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
  const std::string name = fs::path(file).stem().stem().string();
  double collapse = 0;
  const auto ours = [&](bool exact, Mode mode)
  { return [&, exact, mode] { return ByFlipFree(labels, exact, mode, collapse); }; };
  std::vector<Way> ways{ { "exact", ours(true, Mode::Fine) },
    { "exact, coarse", ours(true, Mode::Coarse) },
    { "exact, large parts", ours(true, Mode::LargeParts), 0, true },
    { "smooth", ours(false, Mode::Fine) }, { "smooth, coarse", ours(false, Mode::Coarse) },
    { "usual chain", [&] { return ByUsualChain(labels, voxels); } } };
  if (!peers.empty())
  {
    for (Way& way : PeersOf(peers, file, fs::path(folder) / "flipfree-peers"))
    {
      ways.push_back(std::move(way));
    }
  }
  for (const Way& way : ways)
  {
    collapse = 0;
    const double before = ResetPeakMemory();
    FlipFree::Stopwatch watch;
    const Surfaces surfaces = way.Make();
    const double seconds = way.Seconds > 0 ? way.Seconds : watch.Lap();
    const double memory = PeakMemory() - before;
    int invalid = 0;
    const fs::path files = fs::path(folder) / "flipfree-surfaces";
    fs::remove_all(files);
    fs::create_directories(files);
    std::vector<double> angles;
    double deviation = 0;
    std::size_t triangles = 0;
    for (const auto& [label, data] : surfaces)
    {
      invalid += IsValidFile(data, files / (std::to_string(label) + ".stl")) ? 0 : 1;
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
    int missing = 0;
    if (!way.LeavesOut)
    {
      const auto written = std::distance(fs::directory_iterator(files), fs::directory_iterator());
      missing = static_cast<int>(voxels.size()) - static_cast<int>(written);
      invalid += static_cast<int>(voxels.size()) - static_cast<int>(surfaces.size());
    }
    const std::vector<int> found = Voxelize(surfaces, labels);
    std::size_t differing = 0;
    for (std::size_t voxel = 0; voxel < found.size(); ++voxel)
    {
      differing += found[voxel] != wanted[voxel] ? 1 : 0;
    }
    double squares = 0;
    for (const double angle : angles)
    {
      squares += angle * angle;
    }
    std::nth_element(angles.begin(),
      angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2), angles.end());
    std::printf(
      "| %s | %s | %zu | %zu | %d | %zu | %.1f, %.1f | %.2f | %.2f | %.2f | %.0f | %s |\n",
      name.c_str(), way.Name.c_str(), voxels.size(), triangles, invalid, differing,
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, angles.size()))),
      angles.empty() ? 0.0 : angles[angles.size() / 2], deviation, collapse, seconds,
      memory / (1 << 20), fill ? UnfilledIn(files, missing, peers).c_str() : "-");
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  std::string folder = std::filesystem::temp_directory_path().string();
  std::string peers;
  std::vector<std::string> files;
  CLI::App app("Measures surfaces of labels, ours and those of the usual chain.");
  app.add_option("--folder", folder, "where files are written")->capture_default_str();
  auto* const option = app.add_option("--peers", peers, "a Python that has other software");
  bool fill = false;
  app.add_flag("--fill", fill, "fill the surfaces with tetrahedra")->needs(option);
  app.add_option("labels", files, "label maps")->required();
  CLI11_PARSE(app, argc, argv);
  std::puts("| label map | way | labels | triangles | invalid | differing | rough | volume, % | "
            "collapse, mm | seconds | memory, MiB | not filled |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|");
  try
  {
    for (const std::string& file : files)
    {
      Measure(file, folder, peers, fill);
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
