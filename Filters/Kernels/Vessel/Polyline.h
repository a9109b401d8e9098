/**
 * Lines of points in space, such as the centerline of a vessel: their length, smoothing, and even
 * spacing.
 */
#ifndef FlipFreePolyline_h
#define FlipFreePolyline_h

#include "KernelTypes.h"

namespace FlipFree
{

/// For each point, the length of the line up to it, in millimeters; the first is 0.
Eigen::VectorXd ArcLengths(const PointList& line);

/// Points at equal distances of about `step` millimeters along the line, at least two; the ends
/// stay where they are.
PointList ResampleLine(const PointList& line, double step);

/// Averages each point with those around it, weighted by a Gaussian of their places along the line.
/// The standard deviation, in points, shrinks toward the ends, which stay where they are.
PointList SmoothLine(const PointList& line, double deviation);

/// Averages values along a line in the same way, but at the ends over what is there.
Eigen::VectorXd SmoothAlong(const Eigen::VectorXd& values, double deviation);

/// Per place the mean over those within half of `length` millimeters to either side; `step`:
/// millimeters from one place to the next.
Eigen::VectorXd MeanAlong(const Eigen::VectorXd& values, double step, double length);

/// The median of each value and those up to `reach` places before and after it.
Eigen::VectorXd MedianAlong(const Eigen::VectorXd& values, int reach);

} // namespace FlipFree

#endif
