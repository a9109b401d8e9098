/**
 * The matrix of bad input: for each kind of port, everything that may be wrong with what is
 * connected, and the words that the error must contain. Tests of filters run it over their ports.
 */
#ifndef FlipFreeBadInput_h
#define FlipFreeBadInput_h

#include "ExamplePolyData.h"
#include "FilterErrors.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkPhantomSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>
#include <string>
#include <vector>

namespace FlipFree
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinite = std::numeric_limits<double>::infinity();

/// Of the sphere in SphereImage, and of a seed in it.
const Eigen::Vector3d ExampleCenter(46.5, 46.5, 46.5);
constexpr double ExampleRadius = 18;

/// A bright sphere of radius 30 mm in 32 x 32 x 32 voxels of 3 mm.
inline vtkSmartPointer<vtkImageData> SphereImage(int port = 0)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetDimensions(32, 32, 32);
  phantom->SetSpacing(3, 3, 3);
  phantom->Update();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->DeepCopy(phantom->GetOutputDataObject(port));
  return image;
}

/// The sphere's label map.
inline vtkSmartPointer<vtkImageData> SphereLabels()
{
  return SphereImage(1);
}

inline vtkSmartPointer<vtkImageData> ImageOfType(int type, int components = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(32, 32, 32);
  image->SetSpacing(3, 3, 3);
  image->AllocateScalars(type, components);
  image->GetPointData()->GetScalars()->Fill(1);
  return image;
}

/// The sphere in floating point, with one voxel of the seed replaced.
inline vtkSmartPointer<vtkImageData> ImageWith(double value)
{
  auto image = ImageOfType(VTK_DOUBLE);
  image->GetPointData()->GetScalars()->DeepCopy(SphereImage()->GetPointData()->GetScalars());
  image->SetScalarComponentFromDouble(15, 16, 17, 0, value);
  return image;
}

/// The sphere with other scalars.
template <typename Array>
vtkSmartPointer<vtkImageData> ImageWithArray(vtkIdType size)
{
  vtkNew<Array> scalars;
  scalars->SetName("Intensities");
  scalars->SetNumberOfValues(size);
  scalars->Fill(1);
  auto image = SphereImage();
  image->GetPointData()->SetScalars(scalars);
  return image;
}

inline vtkSmartPointer<vtkPolyData> StartSphere(double radius = ExampleRadius)
{
  const QuadSphere sphere =
    MakeQuadSphere(4, ExampleCenter, radius, QuadSphereSpacing::Equiangular);
  return PolyDataOf(sphere.Points, sphere.Faces);
}

/// Without its last face.
inline vtkSmartPointer<vtkPolyData> OpenSphere()
{
  auto sphere = StartSphere();
  vtkNew<vtkCellArray> faces;
  for (vtkIdType face = 0; face + 1 < sphere->GetNumberOfPolys(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    sphere->GetPolys()->GetCellAtId(face, size, points);
    faces->InsertNextCell(size, points);
  }
  sphere->SetPolys(faces);
  return sphere;
}

/// Its faces turned inward.
inline vtkSmartPointer<vtkPolyData> SphereInsideOut()
{
  auto sphere = StartSphere();
  sphere->GetPolys()->Modified();
  for (vtkIdType face = 0; face < sphere->GetNumberOfPolys(); ++face)
  {
    sphere->GetPolys()->ReverseCellAtId(face);
  }
  return sphere;
}

/// One vertex moved to the opposite side.
inline vtkSmartPointer<vtkPolyData> SelfIntersectingSphere()
{
  auto sphere = StartSphere();
  const Eigen::Vector3d vertex(sphere->GetPoint(5));
  const Eigen::Vector3d opposite = ExampleCenter - 1.5 * (vertex - ExampleCenter);
  sphere->GetPoints()->SetPoint(5, opposite.data());
  return sphere;
}

inline vtkSmartPointer<vtkPolyData> SphereWithPointAt(double x)
{
  auto sphere = StartSphere();
  sphere->GetPoints()->SetPoint(7, x, 0, 0);
  return sphere;
}

/// Closed, but three or six triangles meet at its vertices.
inline vtkSmartPointer<vtkPolyData> TriangulatedBox()
{
  return PolyDataOf(Box({ 36, 36, 36 }, { 56, 56, 56 }));
}

template <typename Data>
struct Bad
{
  std::string Name;
  vtkSmartPointer<Data> Input;
  std::vector<std::string> Words; ///< of the error, beside the name of the port
};

/// Images whose voxels have no places.
inline std::vector<Bad<vtkImageData>> BadGrids()
{
  std::vector<Bad<vtkImageData>> images{
    { "no voxels", vtkSmartPointer<vtkImageData>::New(), { "no voxels" } },
  };
  for (const double spacing : { 0.0, -3.0, NotANumber })
  {
    const auto image = SphereImage();
    image->SetSpacing(3, spacing, 3);
    images.push_back(
      { "spacing of " + std::to_string(spacing), image, { "has a spacing of (3, ", "positive" } });
  }
  const auto flat = SphereImage();
  flat->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 0);
  images.push_back({ "axes in a plane", flat, { "direction matrix", "inverted" } });
  return images;
}

/// Images that no port for an image accepts.
inline std::vector<Bad<vtkImageData>> BadImages()
{
  auto bare = vtkSmartPointer<vtkImageData>::New();
  bare->SetDimensions(32, 32, 32);
  std::vector<Bad<vtkImageData>> images = BadGrids();
  images[0].Words.emplace_back("give one that has");
  images.insert(images.end(),
    {
      { "no scalars", bare, { "no point scalars", "active" } },
      { "too few scalars", ImageWithArray<vtkDoubleArray>(100),
        { "100 scalars for 32768 voxels" } },
      { "bits", ImageWithArray<vtkBitArray>(32 * 32 * 32), { "are of type bit", "unsigned char" } },
      { "several components", ImageOfType(VTK_SHORT, 3),
        { "3 components", "vtkImageExtractComponents" } },
    });
  return images;
}

/// Images that lack data in the seed.
inline std::vector<Bad<vtkImageData>> ImagesWithoutData()
{
  std::vector<Bad<vtkImageData>> images;
  for (const double value : { NotANumber, Infinite, -Infinite })
  {
    images.push_back({ "voxel of " + std::to_string(value), ImageWith(value),
      { "(45, 48, 51) mm", "not a finite number" } });
  }
  return images;
}

/// Surfaces that no port for a surface accepts.
inline std::vector<Bad<vtkPolyData>> BadPolygons()
{
  const auto points = StartSphere();
  points->SetPolys(nullptr);
  const auto missing = StartSphere();
  missing->GetPolys()->InsertNextCell({ 0, 1, 9999 });
  const auto beyond = StartSphere();
  beyond->GetPolys()->InsertNextCell({ 0, 1, (vtkIdType(1) << 32) + 2 }); // 2 as an int
  const auto degenerate = StartSphere();
  degenerate->GetPolys()->InsertNextCell({ 0, 1 });
  vtkNew<vtkCellArray> strip;
  strip->InsertNextCell({ 0, 1, 2, 3 });
  const auto strips = StartSphere();
  strips->SetStrips(strip);
  return {
    { "no points", vtkSmartPointer<vtkPolyData>::New(), { "no points", "connect" } },
    { "points alone", points, { "no polygons" } },
    { "strips", strips, { "triangle strips", "vtkTriangleFilter" } },
    { "not finite", SphereWithPointAt(NotANumber), { "point 7", "finite", "repair" } },
    { "missing point", missing, { "point 9999", "repair" } },
    { "index beyond int", beyond, { "point 4294967298", "repair" } },
    { "two corners", degenerate, { "fewer than three vertices", "remove" } },
  };
}

/// Surfaces that no port for a closed mesh accepts.
inline std::vector<Bad<vtkPolyData>> BadSurfaces()
{
  std::vector<Bad<vtkPolyData>> surfaces = BadPolygons();
  surfaces.push_back({ "open", OpenSphere(), { "closed" } });
  return surfaces;
}

/// Runs a column of the matrix: whatever is connected to this port is refused.
template <typename Data>
void ExpectRefused(const std::vector<Bad<Data>>& inputs, vtkAlgorithm* filter, int port,
  const std::string& noun)
{
  for (const Bad<Data>& bad : inputs)
  {
    SCOPED_TRACE(bad.Name);
    std::vector<std::string> words = bad.Words;
    words.push_back(noun);
    filter->SetInputDataObject(port, bad.Input);
    ExpectRefusal(filter, words);
  }
}

/// Seeds that no filter accepts. Leaves a bad one.
template <typename Filter>
void ExpectBadSeedsRefused(Filter* filter)
{
  filter->SetInputDataObject(0, SphereImage());
  filter->SetSeedRadius(ExampleRadius);
  filter->SetSeedCenter(46, 46, 94.6);
  ExpectRefusal(filter,
    { "(46, 46, 94.6) mm", "outside the image on port 0", "spans (", ") to (",
      "physical coordinates" });
  filter->SetSeedCenter(NotANumber, 46, 46);
  ExpectRefusal(filter, { "the seed's center (nan, 46, 46) mm", "is not a place" });
  filter->SetSeedCenter(ExampleCenter.data());
  for (const double radius : { 2.9, 0.0, -10.0, NotANumber })
  {
    filter->SetSeedRadius(radius);
    filter->Modified(); // the minimum radius may be set already
    ExpectRefusal(filter,
      { "radius", "below a voxel of the image on port 0 (3 mm)", "raise SeedRadius" });
  }
}

/// A seed so small that it fits between two slices.
template <typename Filter>
void ExpectSeedBetweenSlicesRefused(Filter* filter)
{
  const auto image = SphereImage();
  image->SetSpacing(3, 3, 9);
  filter->SetInputDataObject(0, image);
  filter->SetSeedCenter(45, 45, 139.5);
  filter->SetSeedRadius(3.5);
  ExpectRefusal(filter, { "no voxel center", "seed sphere", "raise SeedRadius" });
}

} // namespace FlipFree

#endif
