/**
 * The parts of a phantom, and the plain phantoms of the paper (Fig. 1): a sphere, a cube, a cup, a
 * U-shaped tube and a thin curved vessel. All sizes are proportional to the grid.
 */
#ifndef FlipFreePhantom_h
#define FlipFreePhantom_h

#include "Phantom/ShapeVolume.h"

#include <array>
#include <optional>

namespace FlipFree
{

struct Ball
{
  Eigen::Vector3d Center = Eigen::Vector3d::Zero();
  double Radius = 0;
};

/// A ball inside the organ, of 0.7 times the depth there, from which a segmentation may start.
struct PhantomSeed
{
  std::uint8_t Label;
  Ball Start;
};

/// Positions as in TissueStack: millimeters along the grid's axes around its center.
struct Phantom
{
  TissueStack Tissues;
  std::vector<PhantomSeed> Seeds;
  ImplicitShape Surface; ///< of the one object of a plain phantom; empty otherwise
  /// Of a plain phantom: a ball around the object, with a clearance of 5 %, to start from outside.
  std::optional<Ball> Enclosing;
  /// Of the vessel: points on its axis near its ends, between which it can be traced.
  std::optional<std::array<Eigen::Vector3d, 2>> Ends;
};

enum class PlainShape
{
  Sphere, ///< radius 30 units, where a unit is 1/96 of the grid's shortest extent
  Cube,   ///< edge 52 units
  Cup,    ///< wall 16, cavity 32 wide and 40 deep, 64 high; opens along the third axis
  UTube,  ///< tube radius 9, bend radius 18, legs of 30 along the third axis
  Vessel  ///< tube radius 4, along an S-shaped space curve of about 105 units
};

/// The object has label 1 and intensity `foreground`, the rest 0 and `background`.
Phantom MakePlainPhantom(PlainShape shape, const Eigen::Vector3d& extent, double foreground,
  double background);

} // namespace FlipFree

#endif
