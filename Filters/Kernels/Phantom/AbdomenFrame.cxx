#include "Phantom/AbdomenParts.h"

#include "Phantom/VoxelNoise.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double Air = -1000;
constexpr double Lung = -860;
constexpr double Fat = -102;
constexpr double Muscle = 60;

// The cavity's cross-section, which wall and ribs follow.
const Vector2d CavityCenter(0, -9);
const Vector2d CavityEdges(119, 83);
constexpr double CavityRounding = 81;

ImplicitShape Slab(double low, double high)
{
  return Intersect(
    { MakeHalfSpace({ 0, 0, low }, { 0, 0, -1 }), MakeHalfSpace({ 0, 0, high }, { 0, 0, 1 }) });
}

ImplicitShape Wall(double beyondCavity)
{
  return MakeColumn(CavityCenter, CavityEdges + Vector2d::Constant(beyondCavity),
    CavityRounding + beyondCavity);
}

Vector3d OnWall(double beyondCavity, double angle, double z)
{
  const Vector3d center(CavityCenter.x(), CavityCenter.y(), z);
  const Vector3d outward(std::sin(angle), std::cos(angle), 0);
  const ImplicitShape wall = Wall(beyondCavity);
  double radius = 0;
  // From inside, a step by the distance never leaves; each comes nearer.
  for (int step = 0; step < 60; ++step)
  {
    radius -= wall(center + radius * outward);
  }
  return center + radius * outward;
}

// Angles are measured from the back, where the rib leaves the spine, around the side.
void AddRib(TissueLayers& layers, int side, double height, double end)
{
  std::vector<Vector3d> centerline{ { side * 21.0, 66, height } };
  for (double angle = 0.36; angle < end + 0.05; angle += 0.13)
  {
    const double down = 46 * (1 - std::cos(1.15 * (angle - 0.36)));
    centerline.push_back(OnWall(6, side * angle, height - down));
  }
  const std::vector<double> cortex(centerline.size(), 5.2);
  const std::vector<double> marrow(centerline.size(), 3.2);
  AddLayer(layers, MakeSplineTube(centerline, cortex), 420);
  AddLayer(layers, MakeSplineTube(centerline, marrow), 220, 25);
}

// From the anterior end of a rib, cartilage climbs to the breastbone.
void AddCartilage(TissueLayers& layers, int side, double height, double end, double top)
{
  const double z = height - 46 * (1 - std::cos(1.15 * (end - 0.36)));
  AddLayer(layers,
    MakeSplineTube({ OnWall(6, side * end, z), OnWall(6, side * (end + 0.25), z - 4),
                     OnWall(5, side * (0.5 * (end + 0.25) + 1.42), 0.5 * (z + top)),
                     OnWall(5, side * 3.02, top) },
      { 5, 5.5, 5, 4.5 }),
    125, 15);
}

void AddVertebra(TissueLayers& layers, double z)
{
  const ImplicitShape body =
    SmoothIntersect({ MakeEllipticCylinder({ 0, 50 }, { 22, 17 }), Slab(z - 13.5, z + 13.5) }, 4);
  AddLayer(layers, body, 380);
  AddLayer(layers, Grow(body, -1.7), 158, 26);
  for (int side : { -1, 1 })
  {
    // Pedicle and lamina around the canal, the articular mass, the transverse process.
    AddLayer(layers,
      MakeSplineTube({ { side * 13.0, 62, z + 4 }, { side * 14.0, 72, z + 2 },
                       { side * 10.0, 82, z - 3 }, { 0, 88, z - 6 } },
        { 4.5, 4, 3.6, 3.6 }),
      390);
    AddLayer(layers, MakeEllipsoid({ side * 15.0, 77, z - 12 }, { 6, 6, 12 }), 360, 20);
    AddLayer(layers, MakeTube({ { side * 14.0, 73, z + 2 }, { side * 34.0, 77, z + 4 } }, { 4, 3 }),
      330);
  }
  const ImplicitShape spinous = MakeEllipsoid({ 0, 90, z - 11 }, { 3.5, 9, 10 });
  AddLayer(layers, spinous, 380);
  AddLayer(layers, Grow(spinous, -1.3), 220, 20);
}

// A vessel of the lung and its branches, from the hilum outwards.
void AddLungVessels(TissueLayers& layers, const ImplicitShape& lung, int side)
{
  for (int i = 0; i < 14; ++i)
  {
    const auto random = [&](int which) { return PositionUniform(17, i, which, side) - 0.5; };
    const Vector3d hilum(side * 42, 12, 140);
    const Vector3d end(side * (72 + 70 * random(0)), 8 + 110 * random(1), 62 + 70 * random(2));
    const Vector3d middle = 0.5 * (hilum + end) + 24 * Vector3d(random(3), random(4), random(5));
    AddLayer(layers, Intersect({ MakeSplineTube({ hilum, middle, end }, { 3.4, 2.4, 1.1 }), lung }),
      45);
  }
}

void AddHeart(TissueLayers& layers)
{
  const Eigen::Matrix3d axes =
    (Eigen::AngleAxisd(0.45, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.35, Vector3d::UnitY()))
      .toRotationMatrix();
  const ImplicitShape heart = SmoothUnite({ MakeEllipsoid({ 24, -40, 100 }, { 56, 40, 45 }, axes),
                                            MakeEllipsoid({ -16, -22, 118 }, { 28, 28, 34 }) },
    12);
  AddLayer(layers, Grow(heart, 4), Fat + 15, 8);
  AddLayer(layers, heart, 112, 5);
  AddLayer(layers, MakeEllipsoid({ 38, -30, 104 }, { 31, 19, 25 }, axes), 152, 4);
  AddLayer(layers, MakeEllipsoid({ 6, -56, 98 }, { 34, 13, 26 }, axes), 150, 4);
  AddLayer(layers, MakeEllipsoid({ -20, -22, 120 }, { 20, 21, 26 }), 148, 4);
}

} // namespace

AbdomenSpaces MakeAbdomenSpaces()
{
  AbdomenSpaces spaces;
  spaces.Cavity = Wall(0);
  spaces.BelowDiaphragm = SmoothUnite({ MakeEllipsoid({ -58, -18, -5 }, { 74, 84, 98 }),
                                        MakeEllipsoid({ 62, -16, -5 }, { 68, 82, 84 }),
                                        MakeEllipsoid({ 0, -26, -20 }, { 84, 80, 76 }),
                                        MakeHalfSpace({ 0, 0, -30 }, { 0, 0, 1 }) },
    16);
  spaces.Abdomen =
    SmoothIntersect({ Grow(spaces.Cavity, -1), Grow(spaces.BelowDiaphragm, -3.5) }, 6);
  return spaces;
}

void AddBodyWall(TissueLayers& layers, const AbdomenSpaces& spaces)
{
  const ImplicitShape couch = MakeEllipticCylinder({ 0, -270 }, { 386, 386 });
  AddLayer(layers, Intersect({ Grow(couch, 5), MakeHalfSpace({ 0, 70, 0 }, { 0, -1, 0 }) }), -20);
  AddLayer(layers, Intersect({ Grow(couch, 2), MakeHalfSpace({ 0, 60, 0 }, { 0, -1, 0 }) }), Air);

  const ImplicitShape body = MakeColumn({ 0, -3 }, { 151, 109 }, 103);
  AddLayer(layers, body, 25);
  AddLayer(layers, Grow(body, -1.9), Fat, 5);
  const ImplicitShape wall = Wall(12);
  AddLayer(layers, wall, Muscle, 7);
  for (int side : { -1, 1 })
  {
    AddLayer(layers,
      Intersect({ MakeEllipticCylinder({ side * 31.0, 78 }, { 34, 20 }), Grow(body, -8) }), -45,
      20);
    AddLayer(layers,
      SmoothIntersect({ SmoothUnite({ MakeEllipticCylinder({ side * 20.0, 79 }, { 17, 16 }),
                                      MakeEllipticCylinder({ side * 42.0, 76 }, { 22, 16 }) },
                          8),
                        Grow(body, -9) },
        4),
      Muscle, 12);
  }
  // The fat planes of the flank's three muscles, and the white line between the two of the front.
  for (double depth : { 4.0, 8.0 })
  {
    AddLayer(layers,
      Intersect({ Grow(Wall(depth), 0.5), Complement(Grow(Wall(depth), -0.5)), Slab(-400, -5),
        MakeBox({ 0, -20, 0 }, { 400, 45, 400 }) }),
      -40);
  }
  AddLayer(layers, Intersect({ wall, MakeBox({ 0, -100, -95 }, { 1.5, 20, 140 }) }), -30);
  AddLayer(layers, spaces.Cavity, Fat, 6);
}

void AddChest(TissueLayers& layers, const AbdomenSpaces& spaces)
{
  const ImplicitShape lungs =
    SmoothIntersect({ Grow(spaces.Cavity, -1.5), Complement(spaces.BelowDiaphragm),
                      Complement(MakeEllipticCylinder({ 3, 32 }, { 27, 30 })),
                      Complement(MakeEllipticCylinder({ 0, 66 }, { 26, 26 })),
                      Complement(MakeEllipticCylinder({ 5, -55 }, { 22, 60 })) },
      5);
  AddLayer(layers, lungs, Lung, 12);
  AddLungVessels(layers, lungs, -1);
  AddLungVessels(layers, lungs, 1);
  AddHeart(layers);
  AddLayer(layers, Intersect({ spaces.Cavity, spaces.BelowDiaphragm }), Muscle, 3);
  AddLayer(layers, spaces.Abdomen, Fat, 6);
  // The crura, along which the diaphragm reaches down to the spine.
  for (int side : { -1, 1 })
  {
    AddLayer(layers,
      MakeSplineTube({ { side * 9.0, 34, -44 }, { side * 13.0, 29, 0 }, { side * 14.0, 20, 36 },
                       { side * 9.0, 6, 58 } },
        { 3, 4.5, 4.5, 3 }),
      Muscle, 4);
  }
}

void AddSkeleton(TissueLayers& layers)
{
  // Muscles along the spine, then the column of discs into which the vertebrae are set.
  for (int side : { -1, 1 })
  {
    AddLayer(layers,
      MakeSplineTube({ { side * 23.0, 55, 10 }, { side * 28.0, 51, -40 }, { side * 38.0, 46, -90 },
                       { side * 46.0, 40, -150 } },
        { 5, 13, 18, 20 }),
      Muscle, 8);
    AddLayer(layers, Intersect({ MakeEllipsoid({ side * 56.0, 69, -90 }, { 22, 10, 90 }) }), Muscle,
      8);
  }
  AddLayer(layers, MakeEllipticCylinder({ 0, 72 }, { 32, 18 }), Muscle, 8);
  AddLayer(layers, MakeEllipticCylinder({ 0, 50 }, { 21.5, 16.5 }), 88, 6);
  for (int i = -4; i <= 4; ++i)
  {
    AddVertebra(layers, 34 * i + 6);
  }
  AddLayer(layers, MakeEllipticCylinder({ 0, 75 }, { 10, 8 }), -20, 10);
  AddLayer(layers, MakeEllipticCylinder({ 0, 75 }, { 8, 6.5 }), 35, 3);

  // Breastbone.
  AddLayer(layers, MakeBox({ 0, -94, 150 }, { 17, 5, 62 }, 4), 330);
  AddLayer(layers, MakeBox({ 0, -94, 150 }, { 15, 3.4, 60 }, 3), 170, 20);
  for (int rib = 0; rib < 8; ++rib)
  {
    const double height = 206 - 29.0 * rib;
    const double end = rib < 6 ? 2.45 - 0.06 * rib : rib == 6 ? 1.75 : 1.05;
    for (int side : { -1, 1 })
    {
      AddRib(layers, side, height, end);
      if (rib < 6)
      {
        AddCartilage(layers, side, height, end, std::max(128.0 - 13 * rib, 92.0));
      }
    }
  }
}

} // namespace FlipFree
