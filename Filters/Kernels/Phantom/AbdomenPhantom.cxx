#include "Phantom/AbdomenPhantom.h"

#include "Phantom/AbdomenParts.h"

#include <cmath>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

const Eigen::Vector2d DrawnExtent(330, 255);

// Smooth waves deform the ellipsoids into less regular shapes, all organs together, so that
// adjacent organs stay adjacent.
struct Wave
{
  Vector3d Direction; // radians per mm
  Vector3d Amplitude; // mm
  double Phase;
};

const Wave Waves[3] = { { { 0.012, -0.020, 0.024 }, { 2.4, 1.6, -1.2 }, 0.6 },
  { { 0.038, 0.026, -0.018 }, { -0.8, 1.3, 1.2 }, 2.1 },
  { { -0.030, 0.034, 0.046 }, { 0.7, -0.6, 0.8 }, 4.0 } };

Vector3d Bend(const Vector3d& point)
{
  Vector3d bent = point;
  for (const Wave& wave : Waves)
  {
    bent += std::sin(wave.Direction.dot(point) + wave.Phase) * wave.Amplitude;
  }
  return bent;
}

double BendStretch()
{
  double stretch = 1;
  for (const Wave& wave : Waves)
  {
    stretch += wave.Direction.norm() * wave.Amplitude.norm();
  }
  return stretch;
}

struct OrganSeed
{
  AbdomenLabel Organ;
  Vector3d Center;
  double Radius;
};

// Points deep inside the deformed organs, measured in the sampled phantom by a distance transform;
// for the long vessels, half way along them.
const OrganSeed OrganSeeds[] = { { AbdomenLabel::Spleen, { 89.5, 15, 2.5 }, 13.8 },
  { AbdomenLabel::RightKidney, { -51.5, 40, -0.5 }, 10.5 },
  { AbdomenLabel::LeftKidney, { 64.5, 39, -47.5 }, 10.8 },
  { AbdomenLabel::Gallbladder, { -39.5, -55, -34.5 }, 8.7 },
  { AbdomenLabel::Esophagus, { 4.5, 4, 88.5 }, 4.6 },
  { AbdomenLabel::Liver, { -64.5, -43, 33.5 }, 28 },
  { AbdomenLabel::Stomach, { 60.5, -40, 8.5 }, 16.4 },
  { AbdomenLabel::Aorta, { 4.5, 22, 5.5 }, 6.2 },
  { AbdomenLabel::VenaCava, { -26.5, 18, 39.5 }, 7.5 },
  { AbdomenLabel::PortalVein, { -6.5, -11, 1.5 }, 4.2 },
  { AbdomenLabel::Pancreas, { -23.5, -14, -15.5 }, 8.1 } };

} // namespace

const char* NameOf(AbdomenLabel organ)
{
  switch (organ)
  {
    case AbdomenLabel::Spleen:
      return "spleen";
    case AbdomenLabel::RightKidney:
      return "right kidney";
    case AbdomenLabel::LeftKidney:
      return "left kidney";
    case AbdomenLabel::Gallbladder:
      return "gallbladder";
    case AbdomenLabel::Esophagus:
      return "esophagus";
    case AbdomenLabel::Liver:
      return "liver";
    case AbdomenLabel::Stomach:
      return "stomach";
    case AbdomenLabel::Aorta:
      return "aorta";
    case AbdomenLabel::VenaCava:
      return "vena cava";
    case AbdomenLabel::PortalVein:
      return "portal vein";
    case AbdomenLabel::Pancreas:
      return "pancreas";
  }
  return "";
}

Phantom MakeAbdomenPhantom(const Vector3d& extent, const AbdomenOptions& options)
{
  Phantom phantom;
  TissueStack& stack = phantom.Tissues;
  stack.Background = { -1000, 0, 0 };
  const double scale = extent.head<2>().cwiseQuotient(DrawnExtent).minCoeff();
  stack.FieldCell = 12 * scale;
  stack.Stretch = BendStretch() / scale;
  stack.ToDrawing = [scale](const Vector3d& point) { return Bend(point / scale); };
  const AbdomenSpaces spaces = MakeAbdomenSpaces();
  AddBodyWall(stack.Layers, spaces);
  AddChest(stack.Layers, spaces);
  AddDigestiveTract(stack.Layers, spaces);
  AddLiver(stack.Layers, spaces, options);
  AddRetroperitoneum(stack.Layers);
  AddSkeleton(stack.Layers);

  for (const OrganSeed& seed : OrganSeeds)
  {
    const Ball start{ scale * seed.Center, scale * seed.Radius };
    if ((start.Center.cwiseAbs().array() + start.Radius < 0.5 * extent.array()).all())
    {
      phantom.Seeds.push_back({ static_cast<std::uint8_t>(seed.Organ), start });
    }
  }
  return phantom;
}

} // namespace FlipFree
