#include "Phantom/AbdomenParts.h"

#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

constexpr double VisceralFat = -95;
constexpr double Vein = 146;
constexpr double Artery = 166;

// Bowel: wall and content, and gas where it rises to, the front.
void AddBowel(TissueLayers& layers, const std::vector<Vector3d>& centerline, double radius,
  double content, double unevenness)
{
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (std::size_t i = 0; i < centerline.size(); ++i)
  {
    points.push_back(centerline[i]);
    radii.push_back(radius);
    if (i + 1 < centerline.size())
    {
      points.emplace_back(0.5 * (centerline[i] + centerline[i + 1]));
      radii.push_back(0.86 * radius);
    }
  }
  const ImplicitShape bowel = MakeSplineTube(points, radii);
  AddLayer(layers, bowel, 88, 5);
  AddLayer(layers, Grow(bowel, -2.2), content, unevenness);
}

void AddStomach(TissueLayers& layers, const AbdomenSpaces& spaces)
{
  const ImplicitShape stomach =
    SmoothIntersect({ spaces.Abdomen,
                      MakeSplineTube({ { 54, 12, 56 }, { 64, -12, 34 }, { 62, -42, 6 },
                                       { 36, -58, -16 }, { 4, -54, -22 }, { -20, -38, -14 } },
                        { 28, 29, 26, 21, 16, 10 }) },
      6);
  const ImplicitShape inside = Grow(stomach, -3.8);
  AddOrgan(layers, AbdomenLabel::Stomach, stomach, 86, 5);
  AddOrgan(layers, AbdomenLabel::Stomach, inside, 40, 9);
  AddOrgan(layers, AbdomenLabel::Stomach,
    Intersect({ inside, MakeHalfSpace({ 0, -56, 0 }, { 0, 1, 0 }) }), -960);
}

void AddColon(TissueLayers& layers)
{
  AddBowel(layers,
    { { -86, 24, -150 }, { -87, 22, -126 }, { -90, 16, -104 }, { -88, 4, -82 }, { -80, -18, -64 } },
    20, 45, 45);
  AddBowel(layers,
    { { -66, -50, -66 }, { -46, -66, -72 }, { -22, -72, -80 }, { 2, -73, -84 }, { 26, -70, -80 },
      { 48, -62, -70 } },
    16, 30, 30);
  AddLayer(layers,
    MakeSplineTube({ { -50, -74, -70 }, { -20, -80, -80 }, { 10, -80, -82 }, { 40, -73, -74 } },
      { 4, 6.5, 6, 4 }),
    -940);
  AddBowel(layers,
    { { 66, -46, -56 }, { 82, -22, -36 }, { 88, 6, -34 }, { 90, 24, -56 }, { 88, 30, -80 },
      { 86, 32, -104 }, { 85, 30, -128 }, { 84, 28, -150 } },
    15, 40, 50);
  // A loop with unopacified content: next to the liver, a little darker, nothing between.
  AddLayer(layers,
    MakeSplineTube({ { -84, -14, -62 }, { -76, -34, -52 }, { -62, -50, -54 }, { -52, -56, -66 } },
      { 16, 17, 16, 12 }),
    86, 4);
}

void AddSmallBowel(TissueLayers& layers)
{
  const double contents[4] = { 70, 48, 92, 60 };
  for (int level = 0; level < 4; ++level)
  {
    const double z = -58 - 25 * level;
    for (int row = 0; row < 4; ++row)
    {
      const double y = -44 + 24 * row;
      const double shift = 9 * std::sin(2.3 * level + 1.7 * row);
      const double half = row == 3 ? 30 : 54;
      std::vector<Vector3d> loop;
      for (int i = 0; i <= 6; ++i)
      {
        const double t = i / 3.0 - 1;
        loop.emplace_back(10 + shift + half * t, y + 7 * std::sin(2.6 * i + level + 0.9 * row),
          z + 8 * std::cos(1.9 * i + 2 * row + level));
      }
      AddBowel(layers, loop, 11.5, contents[(level + 2 * row + row / 2) % 4], 6);
    }
  }
}

void AddKidney(TissueLayers& layers, AbdomenLabel label, const Vector3d& center, int side)
{
  // Upper poles lean to the spine and back, hila look to the front and the middle.
  const Eigen::Matrix3d axes = (Eigen::AngleAxisd(side * 0.45, Vector3d::UnitZ()) *
    Eigen::AngleAxisd(-side * 0.22, Vector3d::UnitY()) *
    Eigen::AngleAxisd(-0.15, Vector3d::UnitX()))
                                 .toRotationMatrix();
  const auto at = [&](double outward, double back, double up)
  { return Vector3d(center + axes * Vector3d(side * outward, back, up)); };

  const ImplicitShape sinus = SmoothUnite({ MakeEllipsoid(at(-9, 0, 0), { 11, 7, 19 }, axes),
                                            MakeEllipsoid(at(-24, -2, 0), { 10, 8, 12 }, axes) },
    6);
  const ImplicitShape hull = MakeEllipsoid(center, { 27, 22, 52 }, axes);
  const ImplicitShape kidney = SmoothIntersect({ hull, Complement(sinus) }, 7);
  AddLayer(layers, hull, VisceralFat, 5);
  AddOrgan(layers, label, kidney, 162, 4);
  // Medullary pyramids around the sinus, their tips at it.
  for (int ring = -2; ring <= 2; ++ring)
  {
    for (int spoke = 0; spoke < 4; ++spoke)
    {
      const double angle = -1.65 + 1.1 * spoke + 0.3 * (ring & 1);
      const double width = std::sqrt(1 - ring * ring / 6.5);
      const Vector3d middle =
        at(15.5 * width * std::cos(angle) - 2, 12.5 * width * std::sin(angle), 16.5 * ring);
      AddOrgan(layers, label,
        Intersect({ MakeEllipsoid(middle, { 5.8, 5.2, 6.6 }, axes), Grow(kidney, -2) }), 130, 4);
    }
  }
  // The pelvis in the sinus's fat.
  AddLayer(layers,
    Intersect({ MakeSplineTube({ at(-6, 0, 10), at(-13, 0, 0), at(-26, -2, -8), at(-32, 2, -30) },
                  { 3, 5, 4, 2.5 }),
      Complement(kidney) }),
    22);
}

void AddSpleen(TissueLayers& layers, const AbdomenSpaces& spaces)
{
  const Eigen::Matrix3d axes =
    (Eigen::AngleAxisd(0.5, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.25, Vector3d::UnitX()))
      .toRotationMatrix();
  AddOrgan(layers, AbdomenLabel::Spleen,
    SmoothIntersect({ spaces.Abdomen, MakeEllipsoid({ 88, 28, 32 }, { 38, 52, 56 }, axes),
                      Complement(MakeEllipsoid({ 38, -4, 28 }, { 38, 52, 90 })) },
      8),
    116, 4);
}

} // namespace

void AddDigestiveTract(TissueLayers& layers, const AbdomenSpaces& spaces)
{
  AddSpleen(layers, spaces);
  // Vessels of the mesentery first, so that loops hide what runs behind them.
  AddLayer(layers,
    MakeSplineTube({ { 3, 22, 0 }, { 1, 4, -18 }, { 4, -10, -50 }, { 6, -14, -120 } },
      { 4, 4, 3.5, 3 }),
    Artery);
  AddLayer(layers,
    MakeSplineTube({ { -6, -6, -2 }, { -8, -6, -24 }, { -6, -12, -56 }, { -4, -16, -120 } },
      { 6, 5.5, 5, 4 }),
    168);
  AddSmallBowel(layers);
  AddColon(layers);
  // Duodenum.
  AddBowel(layers,
    { { -20, -38, -16 }, { -38, -30, -16 }, { -46, -12, -28 }, { -45, -2, -50 }, { -30, 6, -64 },
      { 0, 8, -62 }, { 24, 4, -46 } },
    11, 62, 8);
  AddOrgan(layers, AbdomenLabel::Pancreas,
    MakeSplineTube({ { -24, -8, -34 }, { -24, -12, -16 }, { -4, -14, 0 }, { 24, -4, 10 },
                     { 50, 14, 18 }, { 72, 24, 26 } },
      { 9, 13, 9, 9, 9.5, 7 }),
    96, 9);
  AddStomach(layers, spaces);
  AddOrgan(layers, AbdomenLabel::Esophagus,
    MakeSplineTube({ { 5, 5, 150 }, { 6, 5, 90 }, { 14, 3, 66 }, { 34, 6, 52 } }, { 8, 8, 8, 9 }),
    52, 5);
}

void AddRetroperitoneum(TissueLayers& layers)
{
  AddKidney(layers, AbdomenLabel::RightKidney, { -60, 38, -30 }, -1);
  AddKidney(layers, AbdomenLabel::LeftKidney, { 54, 38, -16 }, 1);
  // Adrenal glands.
  AddLayer(layers,
    MakeSplineTube({ { -36, 40, 12 }, { -36, 34, 24 }, { -31, 28, 34 } }, { 2.6, 3, 2.4 }), 82);
  AddLayer(layers,
    MakeSplineTube({ { 36, 36, 8 }, { 33, 28, 20 }, { 27, 24, 30 } }, { 2.6, 3, 2.4 }), 82);
  // Renal veins.
  AddLayer(layers,
    MakeSplineTube({ { -20, 24, -20 }, { -34, 28, -26 }, { -48, 34, -30 } }, { 4.5, 4.5, 3.5 }),
    152);
  AddLayer(layers,
    MakeSplineTube({ { -18, 18, -10 }, { 4, 9, -9 }, { 26, 22, -12 }, { 42, 32, -15 } },
      { 4.5, 3.8, 4.5, 3.5 }),
    152);
  AddOrgan(layers, AbdomenLabel::Aorta,
    MakeSplineTube(
      { { 15, 26, 160 }, { 10, 25, 90 }, { 5, 23, 30 }, { 3, 23, -60 }, { 2, 25, -104 } },
      { 11.5, 11.5, 10.5, 9, 8.5 }),
    Artery, 2);
  for (int side : { -1, 1 })
  {
    AddOrgan(layers, AbdomenLabel::Aorta,
      MakeSplineTube({ { 2, 25, -102 }, { 2 + side * 10.0, 24, -122 }, { side * 24.0, 23, -160 } },
        { 7, 6.2, 6 }),
      Artery, 2);
  }
  AddOrgan(layers, AbdomenLabel::VenaCava,
    MakeSplineTube({ { -20, 30, -160 }, { -20, 26, -100 }, { -20, 24, -40 }, { -23, 23, 10 },
                     { -25, 18, 50 }, { -23, 10, 80 }, { -20, 2, 94 } },
      { 10, 10.5, 11, 11.5, 12, 12.5, 12.5 }),
    Vein, 3);
}

} // namespace FlipFree
