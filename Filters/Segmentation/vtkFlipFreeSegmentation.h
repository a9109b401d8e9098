/**
 * @class   vtkFlipFreeSegmentation
 * @brief   from a seed sphere in an organ to the organ's surface
 *
 * Segments one soft organ of a CT or MR volume: the whole method of the paper (Algorithm 1) in one
 * filter. Inside the region that the surface can reach it smooths the image, models the intensities
 * of the seed sphere by a mixture of Gaussians, and deforms a quadrilateral sphere onto the organ,
 * from coarse to fine, iteration by iteration: correspondence search, flip detection and avoidance,
 * propagation, Laplacian deformation. Every iterate passes a guard, so that the surface stays
 * embedded: no two of its triangles intersect, and no face flips.
 *
 * The same result comes from the stages chained by hand: vtkSeedRegionDiffusion,
 * vtkGMMFeatureFilter, vtkCorrespondenceSearch, vtkFlipFreeDeform, vtkFlipFreeRefinement.
 *
 * Input port 0: vtkImageData with one scalar component of any type; coordinates are the image's
 * physical millimeters, the direction matrix is honored.
 * Input port 1, optional: vtkPolyData, the surface to start from in place of the sphere: closed,
 * four neighbors at every vertex, embedded. It is refined like the sphere.
 *
 * Output port 0: vtkPolyData, the surface, with the point arrays `Displacement` (3 doubles, mm; the
 * last one wanted) and `Correspondence` (unsigned char; 0 solitary, 1 matched, 2 flipping).
 * Output port 1: vtkImageData, unsigned char `Labels` of the input's geometry: LabelValue inside.
 * Output port 2: vtkTable `Convergence`, a row per iteration: Iteration, Level, Vertices,
 * MeanDistance (mm), Matched, Solitary, Flipping, Guarded (vertices that the guard held back), and
 * the seconds of its stages SearchSeconds, FlipSeconds, SolveSeconds, GuardSeconds.
 *
 * Errors: no scalars, several components, an empty image, voxels that are not finite near the seed,
 * a seed outside the image, a radius below a voxel, a seed without contrast to its surroundings, a
 * start surface that is open, not four-valent or self-intersecting. Each is reported once; the
 * outputs are then empty. Warnings, with a result all the same: a seed sphere that reaches beyond
 * the image, no boundary found, a surface that could not be refined or has got to the end of Reach;
 * and, of one grown from the seed with the guard, no boundary for more than a tenth of it (unless
 * search lines are shorter than by default), or more than a quarter of it at the image's ends along
 * two axes: the seed may lie in air.
 *
 * Source: the paper, Algorithm 1 and sections 3.1 to 3.6; remedies beyond it carry their own
 * switch.
 */
#ifndef vtkFlipFreeSegmentation_h
#define vtkFlipFreeSegmentation_h

#include "FlipFreeSegmentationModule.h"
#include "vtkAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace FlipFree
{
struct ImageGeometry;
struct OrganSurface;
}

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeSegmentation : public vtkAlgorithm
{
public:
  static vtkFlipFreeSegmentation* New();
  vtkTypeMacro(vtkFlipFreeSegmentation, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the image (input port 0); SetInputConnection() connects a reader in its place.
   */
  void SetInputData(vtkImageData* image);

  ///@{
  /**
   * The outputs, after Update(); GetOutput() is the surface, too.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetSurface();
  vtkImageData* GetLabelMap();
  vtkTable* GetConvergence();
  ///@}

  ///@{
  /**
   * Connects or sets the start surface (input port 1).
   */
  void SetStartConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetStartData(vtkPolyData* surface);
  ///@}

  ///@{
  /**
   * All parameters of the method at once, those of seed, start, outputs and Reach aside. Default:
   * what segments best. Published: the paper's own method, one level, outward search by voxels, no
   * leak control, no guard. Naive: as published, without flip avoidance (the paper's Fig. 3b).
   */
  void UseDefaultParameters();
  void UsePublishedParameters();
  void UseNaiveParameters();
  ///@}

  ///@{
  /**
   * Center of the seed sphere, in millimeters. Default (0, 0, 0). The sphere should lie within the
   * organ; its voxels model the organ's intensities, and the surface starts from it.
   */
  vtkSetVector3Macro(SeedCenter, double);
  vtkGetVector3Macro(SeedCenter, double);
  ///@}

  ///@{
  /**
   * Radius of the seed sphere, in millimeters. Default 10; at least half the radius of the largest
   * sphere that fits into the organ there is good. The lengths below that are given in seed radii
   * follow it.
   */
  vtkSetClampMacro(SeedRadius, double, 1e-6, 1e6);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * Radius of the mesh's first sphere in seed radii. Default 1. Together with StartCenterOffset
   * other starts than the seed are possible, e.g. one that encloses the object, as in the paper's
   * Fig. 1.
   */
  vtkSetClampMacro(StartScale, double, 1e-3, 1e3);
  vtkGetMacro(StartScale, double);
  ///@}

  ///@{
  /**
   * Center of the mesh's first sphere relative to the seed's center, in millimeters. Default zero.
   */
  vtkSetVector3Macro(StartCenterOffset, double);
  vtkGetVector3Macro(StartCenterOffset, double);
  ///@}

  ///@{
  /**
   * Vertices along the edge of a side of the final mesh (n). Default 32: 6,144 vertices; 2 to 256.
   * As each level doubles them, it is rounded down to a multiple of 2^(Levels - 1).
   */
  vtkSetClampMacro(Resolution, int, 2, 256);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Number of levels from coarse to fine. Default 3; 1 to 6. Levels that would begin with fewer
   * than two vertices along an edge are left out.
   */
  vtkSetClampMacro(Levels, int, 1, 6);
  vtkGetMacro(Levels, int);
  ///@}

  ///@{
  /**
   * Most iterations at each level. Default 40.
   */
  vtkSetClampMacro(MaximumIterations, int, 0, 100000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * A level ends when the mean distance to the targets falls below this, in voxels (of the greatest
   * spacing). Default 0.1.
   */
  vtkSetClampMacro(DistanceTolerance, double, 0, 1e6);
  vtkGetMacro(DistanceTolerance, double);
  ///@}

  ///@{
  /**
   * A level ends when the mean distance fell by less than this over five iterations, in voxels.
   * Default 0.02; a negative value never ends it.
   */
  vtkSetMacro(ChangeTolerance, double);
  vtkGetMacro(ChangeTolerance, double);
  ///@}

  ///@{
  /**
   * How far from the seed's center, in millimeters, the surface may get; only this box of the image
   * is touched. Default 0: ten seed radii, at least 100 and at most 250.
   */
  vtkSetClampMacro(Reach, double, 0, 1e6);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * Iterations of the anisotropic diffusion that smooths the image first (3.2). Default 5; zero for
   * an image that is smooth already.
   */
  vtkSetClampMacro(DiffusionIterations, int, 0, 1000);
  vtkGetMacro(DiffusionIterations, int);
  ///@}

  ///@{
  /**
   * What keeps edges from being smoothed away, as Equation of vtkSeedRegionDiffusion: 0 (default),
   * differences across the faces between voxels; 1 and 2, ITK's gradient and curvature equations.
   */
  vtkSetClampMacro(DiffusionEquation, int, 0, 2);
  vtkGetMacro(DiffusionEquation, int);
  ///@}

  ///@{
  /**
   * Greatest number of Gaussians of the mixture (Eq. 1). Default 3; 1 to 8.
   */
  vtkSetClampMacro(MaximumComponents, int, 1, 8);
  vtkGetMacro(MaximumComponents, int);
  ///@}

  ///@{
  /**
   * Components of a smaller weight are taken out of the mixture: specks in the seed sphere are not
   * the organ. Default 0.15; zero keeps all.
   */
  vtkSetClampMacro(MinimumComponentWeight, double, 0, 1);
  vtkGetMacro(MinimumComponentWeight, double);
  ///@}

  ///@{
  /**
   * Mass of the foreground that its threshold keeps. Default 0.95; the threshold Gamma of Eq. 2
   * follows from it, unless FeatureThreshold is set.
   */
  vtkSetClampMacro(ForegroundMass, double, 0.01, 0.99999);
  vtkGetMacro(ForegroundMass, double);
  ///@}

  ///@{
  /**
   * Gamma of Eq. 2, relative to the mode of g: 0 to 1. Default 0: derived from ForegroundMass, and
   * once intensities are estimated again, even odds of organ and background (0.5).
   */
  vtkSetClampMacro(FeatureThreshold, double, 0, 1);
  vtkGetMacro(FeatureThreshold, double);
  ///@}

  ///@{
  /**
   * By how much of the image's noise the mixture's deviations are widened, since smoothed voxels of
   * a small sphere vary less than those of the whole organ. Default 1 (standard deviations of the
   * noise, added in squares); 0 leaves them.
   */
  vtkSetClampMacro(NoiseWidening, double, 0, 100);
  vtkGetMacro(NoiseWidening, double);
  ///@}

  ///@{
  /**
   * Close and open the foreground by balls and keep the seed's component, so that thin bridges to
   * neighbors do not leak. Default on.
   */
  vtkSetMacro(LeakControl, bool);
  vtkGetMacro(LeakControl, bool);
  vtkBooleanMacro(LeakControl, bool);
  ///@}

  ///@{
  /**
   * Radius of the closing, in millimeters. Default 1.5; at most two voxels are used.
   */
  vtkSetClampMacro(ClosingRadius, double, 0, 1000);
  vtkGetMacro(ClosingRadius, double);
  ///@}

  ///@{
  /**
   * Radius of the opening, in seed radii; used between 2.5 and 6 mm and up to two voxels. Default
   * 0.4.
   */
  vtkSetClampMacro(OpeningScale, double, 0, 1000);
  vtkGetMacro(OpeningScale, double);
  ///@}

  ///@{
  /**
   * Fit the intensities again at each level, now to the inside of the growing surface and against a
   * shell around it; not while no more than 200 voxels lie more than 2 mm inside it. Default on.
   */
  vtkSetMacro(ReestimateIntensities, bool);
  vtkGetMacro(ReestimateIntensities, bool);
  vtkBooleanMacro(ReestimateIntensities, bool);
  ///@}

  ///@{
  /**
   * Greatest length of a search line, in seed radii; between 15 and 60 mm. Default 1.6.
   */
  vtkSetClampMacro(SearchScale, double, 0, 1e6);
  vtkGetMacro(SearchScale, double);
  ///@}

  ///@{
  /**
   * Greatest length of a search line in millimeters; default 0: by SearchScale.
   */
  vtkSetClampMacro(SearchDistance, double, 0, 1e6);
  vtkGetMacro(SearchDistance, double);
  ///@}

  ///@{
  /**
   * Length of the run of voxels beyond the boundary (Eq. 2), in millimeters. Default 2. Zero: the
   * run has RunVoxels voxels.
   */
  vtkSetClampMacro(RunLength, double, 0, 1000);
  vtkGetMacro(RunLength, double);
  ///@}

  ///@{
  /**
   * Length of the run in voxels, the paper's N + 1. Default 4; counts if RunLength is zero.
   */
  vtkSetClampMacro(RunVoxels, int, 1, 1000);
  vtkGetMacro(RunVoxels, int);
  ///@}

  ///@{
  /**
   * Vertices in the background look inward for the foreground. Default on; off reads Eq. 2
   * literally.
   */
  vtkSetMacro(SearchInward, bool);
  vtkGetMacro(SearchInward, bool);
  vtkBooleanMacro(SearchInward, bool);
  ///@}

  ///@{
  /**
   * Standard deviation of the Gaussian window, in millimeters, in which a target moves to the
   * strongest edge; at the finest level, at most 1.5 voxels. Default 3; zero leaves it on the
   * voxel's face.
   */
  vtkSetClampMacro(EdgeWindow, double, 0, 1000);
  vtkGetMacro(EdgeWindow, double);
  ///@}

  ///@{
  /**
   * A vertex this near the image's end, in millimeters, takes the end for its target. Default 12;
   * at zero it is solitary.
   */
  vtkSetClampMacro(ImageBoundaryDistance, double, 0, 1e6);
  vtkGetMacro(ImageBoundaryDistance, double);
  ///@}

  ///@{
  /**
   * Passes of averaging over neighbors that the normals get before the search. Default 2.
   */
  vtkSetClampMacro(NormalSmoothingIterations, int, 0, 1000);
  vtkGetMacro(NormalSmoothingIterations, int);
  ///@}

  ///@{
  /**
   * Targets farther from those of the two-ring than this many deviations (robust, plus a voxel) are
   * dropped. Default 3; zero keeps all.
   */
  vtkSetClampMacro(OutlierStandardDeviations, double, 0, 1e6);
  vtkGetMacro(OutlierStandardDeviations, double);
  ///@}

  ///@{
  /**
   * Greatest displacement wanted in one iteration, in voxels (of the greatest spacing). Default 8;
   * zero does not limit it.
   */
  vtkSetClampMacro(MaximumDisplacement, double, 0, 1e6);
  vtkGetMacro(MaximumDisplacement, double);
  ///@}

  ///@{
  /**
   * Avoid the flips that are detected (3.4, 3.5). Default on; off only counts them.
   */
  vtkSetMacro(AvoidFlips, bool);
  vtkGetMacro(AvoidFlips, bool);
  vtkBooleanMacro(AvoidFlips, bool);
  ///@}

  ///@{
  /**
   * r of Eq. 3. Default 0.3; 0 to 1.
   */
  vtkSetClampMacro(FlipThreshold, double, 0, 1);
  vtkGetMacro(FlipThreshold, double);
  ///@}

  ///@{
  /**
   * Passes of local averaging by which displacements reach solitary vertices (3.6). Default 40.
   */
  vtkSetClampMacro(PropagationIterations, int, 0, 100000);
  vtkGetMacro(PropagationIterations, int);
  ///@}

  ///@{
  /**
   * Weight lambda_p of the positional energy (Eq. 7). Default 0.3.
   */
  vtkSetClampMacro(PositionWeight, double, 0, 1e6);
  vtkGetMacro(PositionWeight, double);
  ///@}

  ///@{
  /**
   * Weight lambda_u of the energy of uniform vertex distribution (Eq. 8). Default 1.
   */
  vtkSetClampMacro(UniformWeight, double, 0, 1e6);
  vtkGetMacro(UniformWeight, double);
  ///@}

  ///@{
  /**
   * How much of the present Laplacian is given up in each iteration: 0 (default) is Eq. 5, which
   * keeps the shape; 1 minimizes the new Laplacian, which smooths and shrinks.
   */
  vtkSetClampMacro(Fairing, double, 0, 1);
  vtkGetMacro(Fairing, double);
  ///@}

  ///@{
  /**
   * Hold back what would make the surface meet itself or flip. Default on. Off, nothing is
   * promised.
   */
  vtkSetMacro(Guard, bool);
  vtkGetMacro(Guard, bool);
  vtkBooleanMacro(Guard, bool);
  ///@}

  ///@{
  /**
   * Value of the organ's voxels in the label map. Default 1; 1 to 255.
   */
  vtkSetClampMacro(LabelValue, int, 1, 255);
  vtkGetMacro(LabelValue, int);
  ///@}

  ///@{
  /**
   * Keep the surface of every iteration, and offer them as time steps: time t is the surface after
   * iteration t. How many there are is known after the first Update(). Default off.
   */
  vtkSetMacro(KeepHistory, bool);
  vtkGetMacro(KeepHistory, bool);
  vtkBooleanMacro(KeepHistory, bool);
  ///@}

  /**
   * Why a segmentation ended.
   */
  enum StopReasons
  {
    NOT_RUN = 0,                  ///< no Update() yet, or the last one failed
    DISTANCE_BELOW_TOLERANCE = 1, ///< of the mean distance to the targets
    AT_REST = 2,                  ///< the mean distance no longer falls
    ITERATION_LIMIT = 3,
    NO_BOUNDARY_FOUND = 4, ///< by any vertex
    NOT_REFINED = 5, ///< the surface is that of a coarser level; its refinement intersects itself
    ABORTED = 6      ///< surface and label map are empty
  };

  ///@{
  /**
   * Why the last level ended, after Update(): one of StopReasons, or the same in words: "distance
   * below tolerance", "at rest", "iteration limit", "no boundary found", "the coarse surface could
   * not be refined", "aborted"; empty for NOT_RUN.
   */
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString() const;
  ///@}

  /**
   * Self-intersecting pairs of triangles of the result, counted exactly and independently of the
   * guard; -1 before Update().
   */
  vtkGetMacro(NumberOfSelfIntersections, int);

  ///@{
  /**
   * Seconds of the last Update() by stage: smoothing, feature, deformation, label map.
   */
  vtkGetVector4Macro(StageSeconds, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**,
    vtkInformationVector*) override;

protected:
  vtkFlipFreeSegmentation();
  ~vtkFlipFreeSegmentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformationVector** inputs, vtkInformationVector* outputs);
  int RequestUpdateExtent(vtkInformationVector** inputs) const;
  int RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs);

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;
  double StartScale = 1;
  double StartCenterOffset[3] = { 0, 0, 0 };
  int Resolution = 32;
  int Levels = 3;
  int MaximumIterations = 40;
  double DistanceTolerance = 0.1;
  double ChangeTolerance = 0.02;
  double Reach = 0;
  int DiffusionIterations = 5;
  int DiffusionEquation = 0;
  int MaximumComponents = 3;
  double MinimumComponentWeight = 0.15;
  double ForegroundMass = 0.95;
  double FeatureThreshold = 0;
  double NoiseWidening = 1;
  bool LeakControl = true;
  double ClosingRadius = 1.5;
  double OpeningScale = 0.4;
  bool ReestimateIntensities = true;
  double SearchScale = 1.6;
  double SearchDistance = 0;
  double RunLength = 2;
  int RunVoxels = 4;
  bool SearchInward = true;
  double EdgeWindow = 3;
  double ImageBoundaryDistance = 12;
  int NormalSmoothingIterations = 2;
  double OutlierStandardDeviations = 3;
  double MaximumDisplacement = 8;
  bool AvoidFlips = true;
  double FlipThreshold = 0.3;
  int PropagationIterations = 40;
  double PositionWeight = 0.3;
  double UniformWeight = 1;
  double Fairing = 0;
  bool Guard = true;
  int LabelValue = 1;
  bool KeepHistory = false;

  int StopReason = NOT_RUN;
  int NumberOfSelfIntersections = -1;
  double StageSeconds[4] = { 0, 0, 0, 0 };

private:
  struct Result;

  bool IsResultValid(vtkInformationVector** inputs) const;
  void Execute(vtkImageData* image, vtkPolyData* start);
  void PublishHistory(vtkInformation* info, bool isKnown) const;
  void WarnOf(const FlipFree::OrganSurface& organ, const FlipFree::ImageGeometry& region,
    const FlipFree::ImageGeometry& image);
  void WarnOfSeed(const FlipFree::OrganSurface& organ, const FlipFree::ImageGeometry& image);
  void Deliver(vtkInformationVector* outputs);

  std::unique_ptr<Result> Cache;

  vtkFlipFreeSegmentation(const vtkFlipFreeSegmentation&) = delete;
  void operator=(const vtkFlipFreeSegmentation&) = delete;
};

#endif
