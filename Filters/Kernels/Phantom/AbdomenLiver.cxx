#include "Phantom/AbdomenParts.h"

#include "Phantom/VoxelNoise.h"

#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

constexpr double Parenchyma = 110;
constexpr double PortalBlood = 168;
constexpr double HepaticBlood = 158;

ImplicitShape MakeLiver(const AbdomenSpaces& spaces)
{
  const ImplicitShape lobes = SmoothUnite({ MakeEllipsoid({ -64, -4, 20 }, { 64, 86, 90 }),
                                            MakeEllipsoid({ -11, -42, 40 }, { 41, 46, 32 }),
                                            MakeEllipsoid({ 64, -37, 51 }, { 35, 31, 17 }) },
    15);
  // The visceral side: one wide hollow, the bed of the fat around the right kidney, the porta,
  // the fissure of the round ligament.
  const ImplicitShape hollow = MakeEllipsoid({ 24, 2, -76 }, { 104, 72, 94 });
  const ImplicitShape bed = SmoothUnite({ MakeEllipsoid({ -36, 42, -34 }, { 40, 28, 58 }),
                                          MakeEllipsoid({ -66, 68, -46 }, { 36, 18, 46 }) },
    8);
  const ImplicitShape porta =
    MakeSplineTube({ { 0, -8, 2 }, { -22, -8, 14 }, { -42, -4, 16 } }, { 11, 9, 5 });
  const ImplicitShape fissure = MakeSplineTube(
    { { 4, -92, 8 }, { 3, -70, 18 }, { 0, -46, 26 }, { -4, -24, 24 } }, { 5, 4, 3, 2 });
  return SmoothIntersect({ spaces.Abdomen, lobes, Complement(hollow), Complement(bed),
                           Complement(porta), Complement(fissure) },
    6);
}

// A vessel and its branches: each splits into two thinner ones, until they are too thin to be seen.
void AddBranches(TissueLayers& layers, const ImplicitShape& liver, double blood,
  const Vector3d& from, const Vector3d& direction, double length, double radius, int key)
{
  if (radius < 0.9)
  {
    return;
  }
  const auto random = [&](int which) { return PositionUniform(5, key, which, 0) - 0.5; };
  const Vector3d bent = (direction + 0.5 * Vector3d(random(0), random(1), random(2))).normalized();
  const Vector3d middle = from + 0.5 * length * direction;
  const Vector3d to = middle + 0.5 * length * bent;
  AddOrgan(layers, AbdomenLabel::Liver,
    Intersect(
      { MakeSplineTube({ from, middle, to }, { radius, 0.93 * radius, 0.85 * radius }), liver }),
    blood);
  const Vector3d aside =
    bent.cross(Vector3d(random(3), random(4), random(5)).normalized()).normalized();
  AddBranches(layers, liver, blood, to, (bent + 0.75 * aside).normalized(), 0.82 * length,
    0.72 * radius, 2 * key + 1);
  AddBranches(layers, liver, blood, to, (bent - 0.6 * aside).normalized(), 0.88 * length,
    0.76 * radius, 2 * key + 2);
}

void AddTrunk(TissueLayers& layers, const ImplicitShape& liver, double blood,
  const std::vector<Vector3d>& points, const std::vector<double>& radii, int key)
{
  AddOrgan(layers, AbdomenLabel::Liver, Intersect({ MakeSplineTube(points, radii), liver }), blood);
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Vector3d along = (points[i] - points[i - 1]).normalized();
    const Vector3d up = along.cross(Vector3d(0.3, 1, i % 2 ? 0.8 : -0.8)).normalized();
    const bool last = i + 1 == points.size();
    const int branchKey = 1000 * key + 100 * static_cast<int>(i);
    AddBranches(layers, liver, blood, points[i], (along + up).normalized(), 20,
      (last ? 0.85 : 0.6) * radii[i], branchKey);
    AddBranches(layers, liver, blood, points[i], (along - up).normalized(), 20,
      (last ? 0.8 : 0.55) * radii[i], branchKey + 50);
  }
}

void AddLesions(TissueLayers& layers, const ImplicitShape& liver, const AbdomenOptions& options)
{
  int placed = 0;
  for (int trial = 0; placed < options.Lesions && trial < 1000 * options.Lesions; ++trial)
  {
    const auto random = [&](int which)
    { return PositionUniform(options.Seed + 77, trial, which, 0); };
    const Vector3d center(-110 + 190 * random(0), -70 + 130 * random(1), -40 + 120 * random(2));
    const double radius = 4 + 8 * random(3);
    // Wholly inside, so that the liver's outline stays what it is.
    if (liver(center) < -radius - 1)
    {
      AddOrgan(layers, AbdomenLabel::Liver, MakeSphere(center, radius), 68, 5);
      ++placed;
    }
  }
}

} // namespace

void AddLiver(TissueLayers& layers, const AbdomenSpaces& spaces, const AbdomenOptions& options)
{
  AddOrgan(layers, AbdomenLabel::PortalVein,
    MakeSplineTube({ { 76, 26, 28 }, { 56, 20, 20 }, { 26, 4, 10 }, { -2, -7, 1 } },
      { 3.5, 4.2, 4.6, 6 }),
    PortalBlood);
  AddOrgan(layers, AbdomenLabel::PortalVein,
    MakeSplineTube({ { -4, -8, 0 }, { -18, -8, 9 }, { -32, -6, 16 } }, { 7, 7, 6.5 }), PortalBlood);

  const ImplicitShape liver = MakeLiver(spaces);
  AddOrgan(layers, AbdomenLabel::Liver, liver, Parenchyma, 6);
  AddTrunk(layers, liver, PortalBlood,
    { { -32, -6, 16 }, { -50, -2, 22 }, { -66, 2, 26 }, { -84, 4, 22 } }, { 6.3, 5.6, 5, 3.6 }, 1);
  AddTrunk(layers, liver, PortalBlood,
    { { -30, -6, 18 }, { -16, -20, 30 }, { -6, -36, 38 }, { 16, -42, 46 }, { 48, -38, 53 } },
    { 5, 4.6, 4, 2.8, 2 }, 2);
  AddTrunk(layers, liver, HepaticBlood, { { -25, 16, 66 }, { -54, 24, 58 }, { -84, 22, 38 } },
    { 6, 4.8, 3.2 }, 3);
  AddTrunk(layers, liver, HepaticBlood, { { -26, 12, 66 }, { -38, -14, 56 }, { -50, -44, 34 } },
    { 5.5, 4.4, 3 }, 4);
  AddTrunk(layers, liver, HepaticBlood, { { -22, 10, 66 }, { -6, -16, 58 }, { 14, -40, 52 } },
    { 5, 4, 2.8 }, 5);
  AddLesions(layers, liver, options);
  AddOrgan(layers, AbdomenLabel::Gallbladder,
    MakeSplineTube({ { -38, -56, -34 }, { -38, -42, -22 }, { -34, -28, -8 } }, { 14, 12, 6 }), 12,
    2);
}

} // namespace FlipFree
