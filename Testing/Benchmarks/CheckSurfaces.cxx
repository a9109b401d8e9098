// Self-intersections of surfaces in files (.vtp), as our own exact test and as CGAL's counts them:
// two numbers per file, which should both be zero for whatever FlipFree wrote.
//
//   CheckSurfaces surface.vtp ...
#include "FindWithCGAL.h"
#include "Geometry/SelfIntersection.h"
#include "SurfaceAdapter.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <cstdio>
#include <exception>

int main(int argc, char* argv[])
{
  std::puts("| surface | triangles | self-intersections | by CGAL |\n|---|---|---|---|");
  std::ptrdiff_t total = 0;
  for (int argument = 1; argument < argc; ++argument)
  {
    try
    {
      vtkNew<vtkXMLPolyDataReader> reader;
      reader->SetFileName(argv[argument]);
      reader->Update();
      const auto surface = FlipFree::SurfaceOf(reader->GetOutput(), "the surface");
      const std::ptrdiff_t ours = FlipFree::CountSelfIntersections(surface.Points, surface.Faces);
      const auto others = FlipFree::FindWithCGAL(surface.Points, surface.Faces);
      const auto theirs = static_cast<std::ptrdiff_t>(others.size());
      std::printf("| %s | %td | %td | %td |\n", argv[argument],
        static_cast<std::ptrdiff_t>(surface.Triangles.rows()), ours, theirs);
      total += ours + theirs;
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "%s: %s\n", argv[argument], error.what());
      return 2;
    }
  }
  return total == 0 ? 0 : 1;
}
