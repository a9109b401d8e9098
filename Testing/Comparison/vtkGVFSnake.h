/**
 * @class   vtkGVFSnake
 * @brief   outlines an organ in one slice by a snake in a gradient vector flow
 *
 * In the slice (a plane of the image's first two axes) through the center of the seed sphere, a
 * closed curve moves from the sphere's cross-section to the organ's edge. The force on it is the
 * gradient vector flow of an edge map (itk::GradientVectorFlowImageFilter), normalized to unit
 * length: the gradients of the edges, diffused far into regions without edges. Tension keeps the
 * curve smooth. An edge is where the image's gradient is well above the seed's mean gradient. The
 * motion stops when the area has settled, or after MaximumIterations.
 *
 * Errors and the common properties are those of vtkBaselineSegmentation; a slice of fewer than four
 * voxels along an axis is refused. The outputs cover one slice: output port 0 is the curve, one
 * closed polyline (lines, no polygons); all other slices of the label map are empty.
 *
 * Source: C. Xu and J. Prince, Snakes, shapes, and gradient vector flow (1998).
 */
#ifndef vtkGVFSnake_h
#define vtkGVFSnake_h

#include "vtkBaselineSegmentation.h"

class vtkGVFSnake : public vtkBaselineSegmentation
{
public:
  static vtkGVFSnake* New();
  vtkTypeMacro(vtkGVFSnake, vtkBaselineSegmentation);

  /**
   * Standard deviation of the Gaussian with which the gradient is measured, in millimeters. Default
   * 1.5; 0.01 to 100.
   */
  vtkSetClampMacro(EdgeSigma, double, 0.01, 100);

  /**
   * The gradient at which the edge map is one half, in multiples of the seed's mean gradient.
   * Default 4; 0.01 to 1000.
   */
  vtkSetClampMacro(EdgeContrast, double, 0.01, 1000);

  /**
   * Weight of the flow's smoothness against its fidelity to the edges' gradients (mu in the
   * source). Default 0.2; 0.001 to 1000.
   */
  vtkSetClampMacro(FlowSmoothness, double, 0.001, 1000);

  /**
   * Iterations of the flow: the distance in pixels at which an edge can be felt. Default 1000; 1 to
   * 100000.
   */
  vtkSetClampMacro(FlowIterations, int, 1, 100000);

  /**
   * Weight of the curve's tension. Default 0.05; 0 to 1000.
   */
  vtkSetClampMacro(Elasticity, double, 0, 1000);

  /**
   * Weight of the curve's bending. Default 0; 0 to 1000.
   */
  vtkSetClampMacro(Rigidity, double, 0, 1000);

  /**
   * Weight of the flow, which is the maximum step in pixels. Default 0.6; 0 to 10.
   */
  vtkSetClampMacro(FlowWeight, double, 0, 10);

  /**
   * An additional outward force, in pixels per iteration. Default 0: none, as in the paper; 0
   * to 10.
   */
  vtkSetClampMacro(Pressure, double, 0, 10);

  /**
   * Maximum number of iterations of the curve. Default 1000; 1 to 1e6.
   */
  vtkSetClampMacro(MaximumIterations, int, 1, 1000000);

  /**
   * The motion stops when the area has changed by less than this fraction over 25 iterations.
   * Default 0.0005; 0 (never) to 1.
   */
  vtkSetClampMacro(AreaTolerance, double, 0, 1);

protected:
  vtkGVFSnake() = default;
  ~vtkGVFSnake() override = default;

  bool Segment(const FlipFree::BaselineTask& task, const std::function<bool(double)>& monitor,
    FlipFree::BaselineResult& result) override;
  void RequireProperties() override;

  double EdgeSigma = 1.5;
  double EdgeContrast = 4;
  double FlowSmoothness = 0.2;
  int FlowIterations = 1000;
  double Elasticity = 0.05;
  double Rigidity = 0;
  double FlowWeight = 0.6;
  double Pressure = 0;
  int MaximumIterations = 1000;
  double AreaTolerance = 0.0005;
};

#endif
