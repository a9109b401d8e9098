/**
 * Meshes and motions that the tests of the surface's validity share.
 */
#ifndef FlipFreeRandomMotions_h
#define FlipFreeRandomMotions_h

#include "Mesh/QuadSphere.h"

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
  const FaceList& Faces() const { return this->Mesh.Faces; }

  QuadSphere Sphere;
  ContourMesh Mesh;
  double EdgeLength;
};

/// A torus of quads: `around` rings of `across` vertices.
struct TestTorus
{
  TestTorus(int around, int across)
    : Points(around * across, 3)
  {
    FaceList faces;
    for (int i = 0; i < around; ++i)
    {
      for (int j = 0; j < across; ++j)
      {
        const double turn = 2 * 3.141592653589793 * i / around;
        const double roll = 2 * 3.141592653589793 * j / across;
        const double radius = 30 + 10 * std::cos(roll);
        this->Points.row(across * i + j) << radius * std::cos(turn), radius * std::sin(turn),
          10 * std::sin(roll);
        const int nextI = (i + 1) % around;
        const int nextJ = (j + 1) % across;
        faces.Append(
          { across * i + j, across * nextI + j, across * nextI + nextJ, across * i + nextJ });
      }
    }
    this->Mesh = BuildContourMesh(around * across, faces);
  }

  PointList Points;
  ContourMesh Mesh;
};

/// Independent normal deviates of the given root mean square length.
inline PointList WhiteNoise(Eigen::Index count, double length, std::mt19937& random)
{
  std::normal_distribution<double> normal(0.0, 1.0);
  PointList noise(count, 3);
  for (Eigen::Index i = 0; i < noise.size(); ++i)
  {
    noise.data()[i] = length / std::sqrt(3.0) * normal(random);
  }
  return noise;
}

} // namespace FlipFree

#endif
