#include "Phantom/Phantom.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

constexpr double SeedShare = 0.7;
constexpr double EnclosingShare = 1.05;

// An object, a point deep inside it, and the radius of its bounding ball around the origin.
struct PlainObject
{
  ImplicitShape Shape;
  Vector3d Inside;
  double Radius;
  std::optional<std::array<Vector3d, 2>> Ends = std::nullopt;
};

PlainObject MakePlainSphere(double unit)
{
  return { MakeSphere(Vector3d::Zero(), 30 * unit), Vector3d::Zero(), 30 * unit };
}

PlainObject MakePlainCube(double unit)
{
  return { MakeBox(Vector3d::Zero(), Vector3d::Constant(26 * unit)), Vector3d::Zero(),
    26 * unit * std::sqrt(3.0) };
}

// The bounding ball touches the bottom and the rim, whose distances from its center, `up` above
// that of the half sphere, are up + radius + halfWall and hypot(radius, height - up) + halfWall.
PlainObject MakePlainCup(double unit)
{
  const double radius = 24 * unit;
  const double height = 24 * unit;
  const double halfWall = 8 * unit;
  const double up = 0.5 * height * height / (radius + height);
  return { MakeCup(Vector3d(0, 0, -up), radius, halfWall, height), Vector3d(0, 0, -up - radius),
    up + radius + halfWall };
}

// Likewise, in the plane of the tube.
PlainObject MakePlainUTube(double unit)
{
  const double bend = 18 * unit;
  const double leg = 30 * unit;
  const double tube = 9 * unit;
  const double up = 0.5 * leg * leg / (bend + leg);
  return { MakeUTube(Vector3d(0, 0, -up), bend, tube, leg), Vector3d(0, 0, -up - bend),
    up + bend + tube };
}

PlainObject MakePlainVessel(double unit)
{
  const int pieces = 64;
  const double pi = 3.14159265358979324;
  const double radius = 4 * unit;
  std::vector<Vector3d> centerline;
  double farthest = 0;
  for (int i = 0; i <= pieces; ++i)
  {
    const double t = 2.0 * i / pieces - 1;
    centerline.emplace_back(36 * unit * t, 16 * unit * std::sin(pi * t),
      10 * unit * std::cos(0.8 * pi * t + 0.5));
    farthest = std::max(farthest, centerline.back().norm());
  }
  // A little inward, as one would click.
  return { MakeTube(centerline, std::vector<double>(centerline.size(), radius)),
    centerline[pieces / 2], farthest + radius,
    std::array<Vector3d, 2>{ { centerline[2], centerline[pieces - 2] } } };
}

PlainObject MakePlainObject(PlainShape shape, double unit)
{
  switch (shape)
  {
    case PlainShape::Sphere:
      return MakePlainSphere(unit);
    case PlainShape::Cube:
      return MakePlainCube(unit);
    case PlainShape::Cup:
      return MakePlainCup(unit);
    case PlainShape::UTube:
      return MakePlainUTube(unit);
    default:
      return MakePlainVessel(unit);
  }
}

} // namespace

Phantom MakePlainPhantom(PlainShape shape, const Vector3d& extent, double foreground,
  double background)
{
  const PlainObject object = MakePlainObject(shape, extent.minCoeff() / 96);
  Phantom phantom;
  phantom.Tissues.Background = { background, 0, 0 };
  phantom.Tissues.Layers.push_back({ object.Shape, { foreground, 0, 1 } });
  phantom.Seeds.push_back({ 1, { object.Inside, -SeedShare * object.Shape(object.Inside) } });
  phantom.Surface = object.Shape;
  phantom.Enclosing = Ball{ Vector3d::Zero(), EnclosingShare * object.Radius };
  phantom.Ends = object.Ends;
  return phantom;
}

} // namespace FlipFree
