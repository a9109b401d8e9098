/**
 * Meshes and motions that the tests of the surface's validity share.
 */
#ifndef FlipFreeRandomMotions_h
#define FlipFreeRandomMotions_h

#include "QuadSphere.h"

#include <cmath>
#include <random>

namespace FlipFree
{

struct TestSphere
{
  explicit TestSphere(int n, QuadSphereSpacing spacing = QuadSphereSpacing::Equiangular)
    : Sphere(MakeQuadSphere(n, Eigen::Vector3d(10.0, -20.0, 30.0), 25.0, spacing))
    , Mesh(BuildContourMesh(static_cast<int>(this->Sphere.Points.rows()), this->Sphere.Faces))
    , EdgeLength(25.0 * 1.5707963267948966 / n)
  {
  }
  const PointList& Points() const { return this->Sphere.Points; }
  const TriangleList& Triangles() const { return this->Mesh.Triangles; }

  QuadSphere Sphere;
  ContourMesh Mesh;
  double EdgeLength;
};

/// Independent normal deviates of the given root mean square length.
inline PointList WhiteNoise(Eigen::Index count, double length, std::mt19937& random)
{
  std::normal_distribution<double> normal(0.0, length / std::sqrt(3.0));
  PointList noise(count, 3);
  for (Eigen::Index i = 0; i < noise.size(); ++i)
  {
    noise.data()[i] = normal(random);
  }
  return noise;
}

} // namespace FlipFree

#endif
