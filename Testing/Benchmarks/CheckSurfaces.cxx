// Whether files hold valid surfaces, whatever other software makes of them: each surface (.vtp) is
// written as STL, PLY and OBJ by VTK's own writers, which ParaView and PyVista use, and read back.
// Prints per format the edges that are open, the pairs of faces that some cuts make intersect, as
// our exact test and as CGAL's counts them, and how the quads are bent: the angle between their two
// triangles, the larger of the two cuts' angles. With --tetgen, also fills each STL with
// tetrahedra. Exits with an error if a surface is not valid.
//
//   CheckSurfaces [--folder DIR] [--tetgen] surface.vtp ...
#include "FindWithCGAL.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/SurfaceTopology.h"
#include "SurfaceAdapter.h"

#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkOBJWriter.h"
#include "vtkPLYReader.h"
#include "vtkPLYWriter.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataReader.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

namespace
{

struct Count
{
  int Open = 0;
  std::ptrdiff_t Ours = 0;
  std::ptrdiff_t Theirs = 0;

  void Add(const Count& other)
  {
    this->Open += other.Open;
    this->Ours += other.Ours;
    this->Theirs += other.Theirs;
  }
};

template <typename Reader>
vtkSmartPointer<vtkPolyData> ReadBack(const std::string& name)
{
  vtkNew<Reader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutput();
}

template <typename Writer, typename Reader>
vtkSmartPointer<vtkPolyData> Roundtrip(vtkPolyData* surface, const std::string& name)
{
  vtkNew<Writer> writer;
  writer->SetInputData(surface);
  writer->SetFileName(name.c_str());
  writer->Write();
  return ReadBack<Reader>(name);
}

vtkSmartPointer<vtkPolyData> TrianglesOf(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  triangles->Update();
  return triangles->GetOutput();
}

Count CountDefects(vtkPolyData* data)
{
  const auto surface = FlipFree::SurfaceOf(data, "the surface");
  Count count;
  for (const FlipFree::SurfaceEdge& edge :
    FlipFree::CollectEdges(static_cast<int>(surface.Points.rows()), surface.Faces))
  {
    count.Open += edge.Forward == 1 && edge.Backward == 1 ? 0 : 1;
  }
  count.Ours = FlipFree::CountSelfIntersections(surface.Points, surface.Faces);
  count.Theirs =
    static_cast<std::ptrdiff_t>(FlipFree::FindWithCGAL(surface.Points, surface.Faces).size());
  return count;
}

// Degrees; 0 is flat.
std::vector<double> BendsOf(vtkPolyData* data)
{
  const auto surface = FlipFree::SurfaceOf(data, "the surface");
  std::vector<double> bends;
  for (int face = 0; face < surface.Faces.NumberOfFaces(); ++face)
  {
    if (surface.Faces.FaceSize(face) != 4)
    {
      continue;
    }
    const auto at = [&](int corner) -> Eigen::Vector3d
    { return surface.Points.row(surface.Faces.Face(face)[corner % 4]); };
    double bend = 0;
    for (int cut : { 0, 1 })
    {
      const Eigen::Vector3d one = (at(cut + 1) - at(cut)).cross(at(cut + 2) - at(cut));
      const Eigen::Vector3d two = (at(cut + 2) - at(cut)).cross(at(cut + 3) - at(cut));
      bend = std::max(bend, std::atan2(one.cross(two).norm(), one.dot(two)));
    }
    bends.push_back(bend * 180 / 3.141592653589793);
  }
  std::sort(bends.begin(), bends.end());
  return bends;
}

double PercentileOf(const std::vector<double>& sorted, double percent)
{
  return sorted.empty()
    ? 0.0
    : sorted[static_cast<std::size_t>(percent / 100 * static_cast<double>(sorted.size() - 1))];
}

bool HasTetGen()
{
  return std::system("command -v tetgen > /dev/null") == 0;
}

// How many TetGen fills it with, 0 if it refuses. It writes its results beside the file.
long CountTetrahedra(const std::string& stl)
{
  const std::string result = std::filesystem::path(stl).replace_extension(".1.ele").string();
  std::filesystem::remove(result);
  std::string quoted = "'";
  for (const char c : stl)
  {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  long count = 0;
  if (std::system(("tetgen -pQ " + quoted + "' > /dev/null").c_str()) == 0)
  {
    std::ifstream(result) >> count;
  }
  return count;
}

void Print(const char* name, const std::array<Count, 4>& counts, const std::vector<double>& bends)
{
  std::printf("| %s |", name);
  for (const Count& count : counts)
  {
    std::printf(" %d, %td, %td |", count.Open, count.Ours, count.Theirs);
  }
  std::printf(" %.0f, %.0f, %.0f |\n", PercentileOf(bends, 50), PercentileOf(bends, 99),
    PercentileOf(bends, 100));
  std::fflush(stdout);
}

} // namespace

int main(int argc, char* argv[])
{
  std::string folder = std::filesystem::temp_directory_path().string();
  std::vector<std::string> names;
  CLI::App app("Checks the surfaces that files of each format hold.");
  app.add_option("--folder", folder, "where files are written")->capture_default_str();
  bool useTetGen = false;
  app.add_flag("--tetgen", useTetGen, "fill each STL with tetrahedra by TetGen");
  app.add_option("surfaces", names, "surfaces (.vtp)")->required();
  CLI11_PARSE(app, argc, argv);

  if (useTetGen && !HasTetGen())
  {
    std::fputs("There is no program tetgen; install it.\n", stderr);
    return 2;
  }
  std::puts("Per format: open edges, pairs of faces that intersect, by CGAL.\n\n"
            "| surface | VTP | STL | PLY | OBJ | bend of quads, degrees: median, 99 %, maximum |\n"
            "|---|---|---|---|---|---|");
  std::array<Count, 4> total;
  std::vector<double> allBends;
  int refused = 0;
  try
  {
    for (const std::string& name : names)
    {
      const vtkSmartPointer<vtkPolyData> surface = ReadBack<vtkXMLPolyDataReader>(name);
      const std::string file = folder + "/flipfree-check";
      const std::array<Count, 4> counts{ { CountDefects(surface),
        CountDefects(Roundtrip<vtkSTLWriter, vtkSTLReader>(TrianglesOf(surface), file + ".stl")),
        CountDefects(Roundtrip<vtkPLYWriter, vtkPLYReader>(surface, file + ".ply")),
        CountDefects(Roundtrip<vtkOBJWriter, vtkOBJReader>(surface, file + ".obj")) } };
      const std::vector<double> bends = BendsOf(surface);
      Print(std::filesystem::path(name).stem().string().c_str(), counts, bends);
      if (useTetGen && CountTetrahedra(file + ".stl") == 0)
      {
        std::fprintf(stderr, "TetGen does not fill %s\n", name.c_str());
        ++refused;
      }
      for (std::size_t format = 0; format < 4; ++format)
      {
        total[format].Add(counts[format]);
      }
      allBends.insert(allBends.end(), bends.begin(), bends.end());
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  std::sort(allBends.begin(), allBends.end());
  Print("all", total, allBends);
  if (useTetGen)
  {
    std::printf("\nTetGen fills %zu of %zu.\n", names.size() - refused, names.size());
  }
  return refused == 0 &&
      std::all_of(total.begin(), total.end(),
        [](const Count& count) { return count.Open + count.Ours + count.Theirs == 0; })
    ? 0
    : 1;
}
