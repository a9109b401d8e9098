#include "Phantom/ShapeCube.h"

#include "Phantom/ShapeVolume.h"

namespace FlipFree
{

ShapeCube CubeAround(const Ball& ball)
{
  return { ball.Center - Eigen::Vector3d::Constant(ball.Radius),
    2 * ball.Radius / (ShapeCube::Size - 1) };
}

void SampleInCube(const ImplicitShape& shape, const ShapeCube& cube, const ParallelFor& parallelFor,
  float* values)
{
  constexpr std::ptrdiff_t size = ShapeCube::Size;
  parallelFor(0, size,
    [&](std::ptrdiff_t from, std::ptrdiff_t to)
    {
      float* value = values + from * size * size;
      for (std::ptrdiff_t k = from; k < to; ++k)
      {
        for (std::ptrdiff_t j = 0; j < size; ++j)
        {
          for (std::ptrdiff_t i = 0; i < size; ++i)
          {
            *value++ =
              static_cast<float>(-shape(cube.First + cube.Step * Eigen::Vector3d(i, j, k)));
          }
        }
      }
    });
}

PointList OntoSurface(const ImplicitShape& shape, const ShapeCube& cube, const PointList& points,
  const ImageGeometry& geometry)
{
  PointList moved(points.rows(), 3);
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    const Eigen::Vector3d at = points.row(point);
    const Eigen::Vector3d onSurface =
      ProjectOntoSurface(shape, cube.First + cube.Step * at, 1e-4 * cube.Step);
    moved.row(point) = GridToPhysical(geometry, onSurface);
  }
  return moved;
}

} // namespace FlipFree
