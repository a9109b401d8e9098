// The kernels' fast marching against ITK's: the same differences of the first order, so the same
// times up to rounding.
#include "Vessel/FastMarching.h"

#include <gtest/gtest.h>

#include <itkFastMarchingImageFilter.h>
#include <itkImage.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

constexpr double Spacing[3] = { 1, 1.5, 0.7 };
constexpr int Size[3] = { 40, 30, 25 };

FloatImage RandomSpeed()
{
  FloatImage speed;
  speed.Geometry.Dimensions = { { Size[0], Size[1], Size[2] } };
  speed.Geometry.Spacing = Eigen::Vector3d(Spacing);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.05F, 1.0F);
  speed.Voxels.resize(speed.Geometry.NumberOfVoxels());
  std::generate(speed.Voxels.begin(), speed.Voxels.end(), [&] { return uniform(random); });
  return speed;
}

std::vector<float> TimesByItk(const FloatImage& speed, const std::array<int, 3>& source)
{
  using Image = itk::Image<float, 3>;
  using Marching = itk::FastMarchingImageFilter<Image, Image>;
  const auto image = Image::New();
  image->SetRegions(Image::SizeType{ { Size[0], Size[1], Size[2] } });
  image->SetSpacing(Spacing);
  image->Allocate();
  std::copy(speed.Voxels.begin(), speed.Voxels.end(), image->GetBufferPointer());
  const auto marching = Marching::New();
  marching->SetInput(image);
  Marching::NodeType node;
  node.SetValue(0);
  node.SetIndex({ { source[0], source[1], source[2] } });
  const auto nodes = Marching::NodeContainer::New();
  nodes->InsertElement(0, node);
  marching->SetTrialPoints(nodes);
  marching->Update();
  const float* const times = marching->GetOutput()->GetBufferPointer();
  return { times, times + speed.Voxels.size() };
}

} // namespace

TEST(FastMarchingByItk, ArrivesAtTheSameTimes)
{
  const FloatImage speed = RandomSpeed();
  const std::array<int, 3> source{ { 11, 20, 7 } };
  const std::vector<float> expected = TimesByItk(speed, source);
  const Arrivals arrivals =
    MarchFront(speed.View(), { speed.Geometry.Offset(source[0], source[1], source[2]) }, {},
      speed.Voxels.size(), std::numeric_limits<float>::infinity(), NeverStop);
  const float latest = *std::max_element(expected.begin(), expected.end());
  EXPECT_GT(latest, 10);
  for (std::size_t voxel = 0; voxel < expected.size(); ++voxel)
  {
    ASSERT_NEAR(arrivals.Times[voxel], expected[voxel], 1e-4 * latest) << voxel;
  }
}
