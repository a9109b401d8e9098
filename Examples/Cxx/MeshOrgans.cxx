/**
 * Writes the walls of all labels of a label map for TetGen (walls.smesh) and for gmsh (organs.geo
 * and walls.msh), in the folder where it is run. Either fills them with one mesh of tetrahedra with
 * one or more regions for each label, in which neighbors share their walls.
 *
 *   MeshOrgans
 *   MeshOrgans labels.nii.gz 3
 *   tetgen -pqAY walls.smesh
 *   gmsh -3 organs.geo
 *
 * The number is the greatest length of the walls' edges in millimeters, 5 by default. Without a
 * label map, that of the built-in phantom serves. mesh_organs.py also looks at the tetrahedra.
 */
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFlipFreeLabelSurfaces.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMedicalImageReader.h>
#include <vtkNew.h>
#include <vtkPhantomSource.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/// None where the file cannot be read; the reader has told why.
vtkSmartPointer<vtkImageData> ReadLabels(const std::string& name)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetErrorCode() == 0 ? reader->GetOutput() : nullptr;
}

vtkSmartPointer<vtkImageData> LabelsOfPhantom()
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShapeToAbdomen();
  phantom->Update();
  return phantom->GetLabelMap();
}

/// A text file that tells whether all of it could be written.
class Output : public std::ofstream
{
public:
  explicit Output(const char* name)
    : std::ofstream(name)
    , Name(name)
  {
    this->precision(std::numeric_limits<double>::max_digits10);
  }

  bool Finish()
  {
    this->close();
    if (!*this)
    {
      std::cerr << this->Name << " cannot be written; run this in a folder that has room for it.\n";
    }
    return !this->fail();
  }

private:
  const char* Name;
};

/// Lines of a number, counted from `first`, and the coordinates.
void WritePoints(vtkPolyData* walls, vtkIdType first, std::ostream& file)
{
  for (vtkIdType point = 0; point < walls->GetNumberOfPoints(); ++point)
  {
    double place[3];
    walls->GetPoint(point, place);
    file << point + first << " " << place[0] << " " << place[1] << " " << place[2] << "\n";
  }
}

/// Lines of a head and the three corners, counted from `first`.
template <typename Head>
void WriteTriangles(vtkPolyData* walls, vtkIdType first, const Head& headOf, std::ostream& file)
{
  vtkNew<vtkIdList> corners;
  for (vtkIdType triangle = 0; triangle < walls->GetNumberOfCells(); ++triangle)
  {
    walls->GetCellPoints(triangle, corners);
    file << headOf(triangle);
    for (const vtkIdType corner : *corners)
    {
      file << " " << corner + first;
    }
    file << "\n";
  }
}

/// No holes, and no regions, since TetGen numbers these itself.
bool WriteForTetGen(vtkPolyData* walls)
{
  Output file("walls.smesh");
  file << walls->GetNumberOfPoints() << " 3 0 0\n";
  WritePoints(walls, 0, file);
  file << walls->GetNumberOfCells() << " 0\n";
  WriteTriangles(
    walls, 0, [](vtkIdType) { return "3"; }, file);
  file << "0\n0\n";
  return file.Finish();
}

/// A surface for each pair of labels, and volumes that these enclose.
bool WriteForGmsh(vtkPolyData* walls)
{
  vtkDataArray* const labels = walls->GetCellData()->GetArray("BoundaryLabels");
  const auto pairOf = [labels](vtkIdType triangle)
  {
    return std::array<int, 2>{ { static_cast<int>(labels->GetComponent(triangle, 0)),
      static_cast<int>(labels->GetComponent(triangle, 1)) } };
  };
  std::map<std::array<int, 2>, std::size_t> surfaces;
  for (vtkIdType triangle = 0; triangle < walls->GetNumberOfCells(); ++triangle)
  {
    surfaces.emplace(pairOf(triangle), surfaces.size() + 1);
  }
  Output mesh("walls.msh");
  mesh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << walls->GetNumberOfPoints() << "\n";
  WritePoints(walls, 1, mesh);
  mesh << "$EndNodes\n$Elements\n" << walls->GetNumberOfCells() << "\n";
  WriteTriangles(
    walls, 1,
    [&](vtkIdType triangle)
    {
      const std::string surface = std::to_string(surfaces.at(pairOf(triangle)));
      return std::to_string(triangle + 1) + " 2 2 " + surface + " " + surface; // two tags
    },
    mesh);
  mesh << "$EndElements\n";

  std::map<int, std::string> around; // the surfaces of each label
  for (const auto& [pair, surface] : surfaces)
  {
    for (const int label : pair)
    {
      std::string& list = around[label];
      list += (list.empty() ? "" : ", ") + std::to_string(surface);
    }
  }
  around.erase(0); // background
  Output geometry("organs.geo");
  geometry << "Merge \"walls.msh\";\n";
  for (const auto& [label, list] : around)
  {
    geometry << "Surface Loop(" << label << ") = {" << list << "};\nVolume(" << label << ") = {"
             << label << "};\nPhysical Volume(" << label << ") = {" << label << "};\n";
  }
  return mesh.Finish() && geometry.Finish();
}

} // namespace

int main(int argc, char* argv[])
{
  const std::string usage = "Usage: MeshOrgans [LABEL-MAP [EDGE-LENGTH]]\n";
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "--help")
  {
    std::cout << usage;
    return EXIT_SUCCESS;
  }
  double edgeLength = 5;
  std::istringstream number(words.size() == 2 ? words[1] : "5");
  if (words.size() > 2 || !(number >> edgeLength) || !number.eof())
  {
    std::cerr << usage;
    return 2;
  }
  const vtkSmartPointer<vtkImageData> labels =
    words.empty() ? LabelsOfPhantom() : ReadLabels(words[0]);
  if (!labels)
  {
    return EXIT_FAILURE;
  }
  vtkNew<vtkFlipFreeLabelSurfaces> surfaces;
  surfaces->SetInputData(labels);
  surfaces->ExactOn();
  surfaces->SetEdgeLength(edgeLength);
  surfaces->Update();
  vtkPolyData* const walls = surfaces->GetOutput();
  if (walls->GetNumberOfCells() == 0)
  {
    return EXIT_FAILURE; // the filter has told why
  }
  if (!WriteForTetGen(walls) || !WriteForGmsh(walls))
  {
    return EXIT_FAILURE;
  }
  std::cout << "walls.smesh, organs.geo, walls.msh: " << walls->GetNumberOfPoints() << " points, "
            << walls->GetNumberOfCells() << " triangles\n";
  return EXIT_SUCCESS;
}
