#include "SurfaceFile.h"

#include "Deformation/Provenance.h"
#include "Failure.h"
#include "Mesh/SurfaceTopology.h"
#include "MeshAdapter.h"
#include "OutputFile.h"
#include "Polygons.h"
#include "Run.h"
#include "SurfaceOrigin.h"
#include "TextFile.h"
#include "UnreadableFile.h"

#include "Exchange/FileProblem.h"
#include "Exchange/PolygonFile.h"
#include "Exchange/SurfaceBytes.h"
#include "Exchange/VtpHeader.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSurfaceValidity.h"
#include "vtkTable.h"
#include "vtkVariant.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>

namespace Command
{
namespace
{

vtkSmartPointer<vtkPolyData> ReadVtp(const std::string& name, const std::string& bytes)
{
  FlipFree::ValidateVtp(name, bytes);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(name.c_str());
  Run(reader, "reading");
  try
  {
    return JudgedPolygons(reader->GetOutput());
  }
  catch (const FlipFree::FileProblem& fault)
  {
    throw Failure(fault.what());
  }
}

/// By a format of triangles.
template <std::string (*Bytes)(const FlipFree::PointView&, const FlipFree::TriangleView&,
  const std::vector<std::string>&)>
void WriteTriangles(const std::string& name, vtkPolyData* surface)
{
  WriteText(name,
    Bytes(FlipFree::CopyPoints(surface), FlipFree::Triangulate(FlipFree::CopyPolys(surface)),
      FlipFree::CommentsOn(ProvenanceOf(surface))));
}

void WriteObj(const std::string& name, vtkPolyData* surface)
{
  WriteText(name,
    FlipFree::ObjBytes(FlipFree::CopyPoints(surface), FlipFree::CopyPolys(surface),
      FlipFree::CommentsOn(ProvenanceOf(surface))));
}

/// VTK writes whatever arrays there are.
void WriteVtp(const std::string& name, vtkPolyData* surface)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(name.c_str());
  writer->SetInputData(surface);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  Run(writer, "writing", {}, [&writer]() { writer->Write(); });
}

struct Format
{
  const char* Ending;
  std::function<vtkSmartPointer<vtkPolyData>(const std::string& name, const std::string& bytes)>
    Read;
  std::function<void(const std::string&, vtkPolyData*)> Write;
};

const Format& FormatOf(const std::string& name)
{
  static const std::vector<Format> formats{
    { ".vtp", ReadVtp, WriteVtp },
    { ".stl", ReadPolygons, WriteTriangles<FlipFree::StlBytes> },
    { ".ply", ReadPolygons, WriteTriangles<FlipFree::PlyBytes> },
    { ".obj", ReadPolygons, WriteObj },
  };
  for (const Format& format : formats)
  {
    if (HasEnding(name, { format.Ending }))
    {
      return format;
    }
  }
  throw std::logic_error("the ending of '" + name + "' was not checked");
}

/// Compares the faces' vertex indices only: most formats round positions.
bool SameFaces(vtkPolyData* a, vtkPolyData* b)
{
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints() ||
    a->GetNumberOfPolys() != b->GetNumberOfPolys())
  {
    return false;
  }
  vtkNew<vtkIdList> first;
  vtkNew<vtkIdList> second;
  for (vtkIdType face = 0; face < a->GetNumberOfPolys(); ++face)
  {
    a->GetPolys()->GetCellAtId(face, first);
    b->GetPolys()->GetCellAtId(face, second);
    if (first->GetNumberOfIds() != second->GetNumberOfIds() ||
      !std::equal(first->begin(), first->end(), second->begin()))
    {
      return false;
    }
  }
  return true;
}

/// The last byte of text is the only one whose loss a reader does not notice.
bool EndsWhole(const std::string& name)
{
  char last = '\0';
  std::ifstream file(name, std::ios::binary);
  return !HasEnding(name, { ".obj", ".vtp" }) ||
    (file.seekg(-1, std::ios::end) && file.get(last) && last == '\n');
}

/// Each face cut from its first vertex, as the kernels measure it, and as the wheel and the page
/// do.
vtkSmartPointer<vtkPolyData> TrianglesOf(vtkPolyData* surface)
{
  auto triangles = vtkSmartPointer<vtkPolyData>::New();
  triangles->SetPoints(surface->GetPoints());
  triangles->SetPolys(
    FlipFree::MakePolys(FlipFree::FacesOf(FlipFree::Triangulate(FlipFree::CopyPolys(surface)))));
  triangles->SetFieldData(surface->GetFieldData());
  return triangles;
}

/// Field data of FlipFree's filters: the surface is proven to be embedded.
bool IsCertified(vtkPolyData* surface)
{
  vtkDataArray* certified = surface->GetFieldData()->GetArray("Certified");
  return certified && certified->GetNumberOfTuples() == 1 && certified->GetTuple1(0) == 1;
}

/// Whether the format moves a point: single precision may.
bool IsRounded(vtkPolyData* surface, const std::string& name)
{
  const FlipFree::PointList points = FlipFree::CopyPoints(surface);
  return HasEnding(name, { ".stl", ".ply" }) && points.cast<float>().cast<double>() != points;
}

/// What was certified is not the file but the surface: the file's positions may be rounded.
void RequireValid(vtkPolyData* found, vtkPolyData* surface, const std::string& name)
{
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(found);
  Run(validity, "checking");
  if (validity->IsValid())
  {
    return;
  }
  const auto count = [&validity](const char* measure)
  { return std::to_string(validity->GetMeasures()->GetValueByName(0, measure).ToInt()); };
  const std::string defects = count("SelfIntersections") + " pairs of faces touch each other, " +
    count("BoundaryEdges") + " edges are open, and " + count("NonManifoldEdges") +
    " belong to more than two faces.";
  if (!IsRounded(surface, name))
  {
    throw std::logic_error("in '" + name + "', as it is read back, " + defects +
      " That should be impossible, as every step was certified. Please report it with the image "
      "and the command.");
  }
  throw Failure("'" + name +
    "' cannot hold this surface: with positions rounded as the format asks, " + defects +
    " Write a .vtp file, which holds positions in double precision.");
}

} // namespace

vtkSmartPointer<vtkPolyData> ReadSurface(const std::string& name)
{
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored))
  {
    throw UnreadableFile(name);
  }
  if (!std::filesystem::is_regular_file(name, ignored))
  {
    throw Failure("'" + name + "' is not a regular file. Give the file of a surface.");
  }
  const std::string bytes = ReadBytes(name);
  vtkSmartPointer<vtkPolyData> surface;
  try
  {
    surface = FormatOf(name).Read(name, bytes);
  }
  catch (const std::bad_alloc&)
  {
    throw Failure("'" + name +
      "' cannot be read: it asks for more memory than is available. It is damaged; "
      "create it again.");
  }
  catch (const FlipFree::FileProblem& problem)
  {
    throw Failure(problem.what());
  }
  catch (const Failure& failure)
  {
    throw Failure(FlipFree::DamagedSurface(name, failure.what()));
  }
  if (surface->GetNumberOfPolys() == 0)
  {
    throw Failure("'" + name + "' has no faces. Check its extension, or create it again.");
  }
  return surface;
}

void WriteSurface(const std::string& name, vtkPolyData* surface, const OriginNames& names)
{
  const bool isStl = HasEnding(name, { ".stl" });
  vtkSmartPointer<vtkPolyData> written = surface;
  if (isStl || HasEnding(name, { ".ply" }))
  {
    written = TrianglesOf(surface);
  }
  else if (HasEnding(name, { ".vtp" }))
  {
    written = WithNames(surface, names);
  }
  bool whole = false;
  vtkSmartPointer<vtkPolyData> found;
  try
  {
    const Format& format = FormatOf(name);
    format.Write(name, written);
    found = format.Read(name, ReadBytes(name));
    // STL has no vertex indices to compare.
    whole =
      isStl ? found->GetNumberOfPolys() == written->GetNumberOfPolys() : SameFaces(found, written);
    whole = whole && EndsWhole(name);
  }
  catch (const std::runtime_error&) // of a command, of a file, of polygons
  {
    whole = false;
  }
  if (!whole)
  {
    throw Failure("'" + name +
      "' cannot be written completely: the disk is full, or a file size limit has been reached. "
      "Free some space, or write elsewhere.");
  }
  if (IsCertified(surface))
  {
    RequireValid(found, surface, name);
  }
}

void WriteLines(const std::string& name, vtkPolyData* lines)
{
  bool whole = false;
  try
  {
    WriteVtp(name, lines);
    FlipFree::ValidateVtp(name, ReadBytes(name));
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(name.c_str());
    Run(reader, "reading");
    vtkPolyData* found = reader->GetOutput();
    whole = found->GetNumberOfPoints() == lines->GetNumberOfPoints() &&
      found->GetNumberOfLines() == lines->GetNumberOfLines() && EndsWhole(name);
  }
  catch (const std::runtime_error&)
  {
    whole = false;
  }
  if (!whole)
  {
    throw Failure("'" + name +
      "' cannot be written completely: the disk is full, or a file size limit has been reached. "
      "Free some space, or write elsewhere.");
  }
}

} // namespace Command
