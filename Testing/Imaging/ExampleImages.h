/**
 * What the tests of the module Imaging share: small images with every kind of orientation, a folder
 * that goes away again, and errors counted.
 */
#ifndef FlipFreeExampleImages_h
#define FlipFreeExampleImages_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace ExampleImages
{

struct NamedDirection
{
  const char* Name;
  std::array<double, 9> Matrix;
};

/// Row by row. Oblique ones have rational entries, so that they are orthonormal to the last bit but
/// one; the test of a format must not depend on how well a format rounds.
inline const std::vector<NamedDirection>& Directions()
{
  static const std::vector<NamedDirection> all = {
    { "Identity", { { 1, 0, 0, 0, 1, 0, 0, 0, 1 } } },
    { "Permuted", { { 0, 0, 1, 1, 0, 0, 0, 1, 0 } } },
    { "PermutedLeftHanded", { { 0, 1, 0, 1, 0, 0, 0, 0, 1 } } },
    { "Reversed", { { -1, 0, 0, 0, -1, 0, 0, 0, 1 } } },
    { "Oblique", { { 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6 } } },
    { "ObliqueLeftHanded", { { 0.36, 0.48, 0.8, -0.8, 0.6, 0, 0.48, 0.64, -0.6 } } },
  };
  return all;
}

constexpr int MarkedVoxel[3] = { 5, 1, 2 };
constexpr double Mark = 113;

/// 7 x 4 x 5 voxels, anisotropic, with negative origin, all values different modulo 101, and one
/// voxel marked.
inline vtkSmartPointer<vtkImageData> Make(int scalarType, const std::array<double, 9>& direction)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(7, 4, 5);
  image->SetOrigin(-103.25, 41.5, -870.125);
  image->SetSpacing(0.75, 1.25, 3.5);
  image->SetDirectionMatrix(direction.data());
  image->AllocateScalars(scalarType, 1);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetComponent(i, 0, static_cast<double>(i % 101));
  }
  image->SetScalarComponentFromDouble(MarkedVoxel[0], MarkedVoxel[1], MarkedVoxel[2], 0, Mark);
  return image;
}

/// Where the marked voxel lies; the test fails if there is not just one.
inline std::array<double, 3> FindMark(vtkImageData* image)
{
  std::array<double, 3> place{ { 0, 0, 0 } };
  int found = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    if (image->GetPointData()->GetScalars()->GetComponent(i, 0) == Mark)
    {
      image->GetPoint(i, place.data());
      ++found;
    }
  }
  EXPECT_EQ(found, 1);
  return place;
}

inline void ExpectSameGeometry(vtkImageData* a, vtkImageData* b, double tolerance)
{
  int extents[2][6];
  a->GetExtent(extents[0]);
  b->GetExtent(extents[1]);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(extents[0][i], extents[1][i]) << "extent " << i;
  }
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(a->GetOrigin()[i], b->GetOrigin()[i], tolerance * 1000) << "origin " << i;
    EXPECT_NEAR(a->GetSpacing()[i], b->GetSpacing()[i], tolerance) << "spacing " << i;
  }
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(a->GetDirectionMatrix()->GetData()[i], b->GetDirectionMatrix()->GetData()[i],
      tolerance)
      << "direction " << i;
  }
}

inline void ExpectSameVoxels(vtkImageData* a, vtkImageData* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  ASSERT_NE(a->GetPointData()->GetScalars(), nullptr);
  ASSERT_NE(b->GetPointData()->GetScalars(), nullptr);
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(a->GetPointData()->GetScalars()->GetComponent(i, 0),
      b->GetPointData()->GetScalars()->GetComponent(i, 0))
      << "voxel " << i;
  }
}

/// A new folder, removed with its contents at the end.
class Folder
{
public:
  Folder()
  {
    std::random_device random;
    this->Path = std::filesystem::temp_directory_path() /
      ("FlipFreeTest-" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directory(this->Path);
  }
  ~Folder() { std::filesystem::remove_all(this->Path); }
  Folder(const Folder&) = delete;
  void operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (this->Path / name).string(); }
  std::string Name() const { return this->Path.string(); }
  std::ptrdiff_t NumberOfFiles() const
  {
    return std::distance(std::filesystem::directory_iterator(this->Path),
      std::filesystem::directory_iterator());
  }

private:
  std::filesystem::path Path;
};

/// Counts the errors and warnings of an algorithm, and keeps its executive quiet.
class Errors
{
public:
  explicit Errors(vtkAlgorithm* algorithm)
  {
    algorithm->AddObserver(vtkCommand::ErrorEvent, this, &Errors::Take);
    algorithm->AddObserver(vtkCommand::WarningEvent, this, &Errors::TakeWarning);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Errors::Ignore);
  }
  int Count() const { return this->Number; }
  const std::string& Message() const { return this->Text; }
  const std::string& Warning() const { return this->WarningText; }

private:
  void Take(vtkObject*, unsigned long, void* text)
  {
    this->Text = static_cast<const char*>(text);
    ++this->Number;
  }
  void TakeWarning(vtkObject*, unsigned long, void* text)
  {
    this->WarningText = static_cast<const char*>(text);
  }
  void Ignore(vtkObject*, unsigned long, void*) {}

  int Number = 0;
  std::string Text;
  std::string WarningText;
};

/// The algorithm refuses what `run` asks of it, with one error that holds all of the words.
inline void ExpectRefusal(vtkAlgorithm* algorithm, const std::vector<std::string>& words,
  const std::function<void()>& run)
{
  Errors errors(algorithm);
  run();
  EXPECT_EQ(errors.Count(), 1);
  for (const std::string& word : words)
  {
    EXPECT_NE(errors.Message().find(word), std::string::npos)
      << "'" << word << "' is not in: " << errors.Message();
  }
  algorithm->RemoveAllObservers();
}

/// A cube of voxels that hardly compress.
inline vtkSmartPointer<vtkImageData> Noise(int size, unsigned int values)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, size);
  image->AllocateScalars(VTK_SHORT, 1);
  std::mt19937 random(5);
  std::generate_n(static_cast<short*>(image->GetScalarPointer()), image->GetNumberOfPoints(),
    [&]() { return static_cast<short>(random() % values); });
  return image;
}

inline std::string ReadBytes(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

inline void WriteBytes(const std::string& name, const std::string& bytes)
{
  std::ofstream(name, std::ios::binary) << bytes;
}

} // namespace ExampleImages

#endif
