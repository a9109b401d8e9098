/**
 * A closed curve in the plane that is moved by a field of forces, and the pixels inside it.
 */
#ifndef FlipFreePlaneSnake_h
#define FlipFreePlaneSnake_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// One row per corner of a closed polygon: x, y in pixels, whose centers have whole numbers.
using Outline = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A force per pixel, x fastest.
struct PlaneField
{
  int Width = 0;
  int Height = 0;
  std::vector<Eigen::Vector2d> Forces;

  /// Bilinear; beyond the border the nearest pixel counts.
  Eigen::Vector2d operator()(const Eigen::Vector2d& point) const;
};

struct SnakeSettings
{
  double Elasticity = 0.05; ///< weight of the curve's tension
  double Rigidity = 0;      ///< weight of its bending
  double Force = 0.6;       ///< weight of the field
  double Pressure = 0;      ///< weight of a force outward, of length one
  int MaximumIterations = 1000;
  double AreaTolerance = 0; ///< stops when the area has changed by less over 25 iterations
};

/// Moves the outline by semi-implicit steps of time one (M. Kass, A. Witkin and D. Terzopoulos,
/// Snakes: active contour models, 1988), with corners kept about a pixel and a half apart. Returns
/// false if the monitor stopped it, or else the number of iterations in `iterations`.
bool MoveSnake(const PlaneField& field, const SnakeSettings& settings, const Monitor& monitor,
  Outline& outline, int& iterations);

/// Positive when counter-clockwise (x to the right, y up).
double SignedArea(const Outline& outline);

/// A circle, counter-clockwise.
Outline MakeCircle(const Eigen::Vector2d& center, double radius);

/// 1 for the pixels whose centers the outline winds around, 0 for others; x fastest.
std::vector<unsigned char> FillOutline(const Outline& outline, int width, int height);

} // namespace FlipFree

#endif
