// Real volumes: what the reader says against what the bytes of the NIfTI header say.
#include "vtkMedicalImageReader.h"

#include "ExampleImages.h"
#include "RealVolume.h"

#include "itk_zlib.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace
{

template <typename T>
T Field(const std::vector<char>& header, int offset)
{
  T value;
  std::memcpy(&value, header.data() + offset, sizeof(T));
  return value;
}

/// From voxel indices to RAS by the sform, or by the qform's quaternion where there is no sform; as
/// nifti1.h defines them.
std::array<std::array<double, 4>, 3> Affine(const std::vector<char>& header)
{
  std::array<std::array<double, 4>, 3> affine{};
  if (Field<std::int16_t>(header, 254) > 0)
  {
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        affine[row][column] = Field<float>(header, 280 + 16 * row + 4 * column);
      }
    }
    return affine;
  }
  const double b = Field<float>(header, 256);
  const double c = Field<float>(header, 260);
  const double d = Field<float>(header, 264);
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  const double rotation[3][3] = { { a * a + b * b - c * c - d * d, 2 * (b * c - a * d),
                                    2 * (b * d + a * c) },
    { 2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b) },
    { 2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c } };
  const double qfac = Field<float>(header, 76) < 0 ? -1 : 1;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      affine[row][column] =
        rotation[row][column] * Field<float>(header, 80 + 4 * column) * (column == 2 ? qfac : 1);
    }
    affine[row][3] = Field<float>(header, 268 + 4 * row);
  }
  return affine;
}

class TestRealVolumes : public testing::TestWithParam<const char*>
{
};

TEST_P(TestRealVolumes, GeometryIsTheHeaders)
{
  const std::string name = RealVolume(GetParam());
  if (!std::filesystem::exists(name))
  {
    GTEST_SKIP() << NoRealVolume(name);
  }
  std::vector<char> header(348);
  gzFile file = gzopen(name.c_str(), "rb");
  ASSERT_EQ(gzread(file, header.data(), 348), 348);
  gzclose(file);
  const auto affine = Affine(header);

  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  int dimensions[3];
  image->GetDimensions(dimensions);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(dimensions[axis], Field<std::int16_t>(header, 42 + 2 * axis));
    EXPECT_NEAR(image->GetSpacing()[axis], std::abs(Field<float>(header, 80 + 4 * axis)), 1e-6);
  }
  const double signs[3] = { -1, -1, 1 }; // RAS to LPS
  for (int corner = 0; corner < 8; ++corner)
  {
    const double index[3] = { double((corner & 1) * (dimensions[0] - 1)),
      double((corner >> 1 & 1) * (dimensions[1] - 1)),
      double((corner >> 2 & 1) * (dimensions[2] - 1)) };
    double point[3];
    image->TransformContinuousIndexToPhysicalPoint(index, point);
    for (int row = 0; row < 3; ++row)
    {
      const double ras = affine[row][0] * index[0] + affine[row][1] * index[1] +
        affine[row][2] * index[2] + affine[row][3];
      EXPECT_NEAR(point[row], signs[row] * ras, 1e-2) << "corner " << corner << ", axis " << row;
    }
  }
  EXPECT_GT(image->GetScalarRange()[1], image->GetScalarRange()[0]);
}

INSTANTIATE_TEST_SUITE_P(Files, TestRealVolumes,
  testing::Values("abdomen01_ct.nii.gz", "cord_mr.nii.gz", "abdomen3mm_ct.nii.gz",
    "liver512_ct.nii.gz", "mass005_mr.nii.gz"),
  [](const auto& parameter)
  {
    const std::string name = parameter.param;
    std::string clean = name.substr(0, name.find('.'));
    clean.erase(std::remove(clean.begin(), clean.end(), '_'), clean.end());
    return clean;
  });

} // namespace
