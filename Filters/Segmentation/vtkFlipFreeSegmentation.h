/**
 * @class   vtkFlipFreeSegmentation
 * @brief   from a seed sphere in an organ to the organ's surface
 *
 * Segments one soft organ in a CT or MR volume by the whole method of the paper (Algorithm 1). It
 * smooths the image in the region that the surface can reach, models the intensities of the seed
 * sphere by a mixture of Gaussians, and deforms a quadrilateral sphere onto the organ, from coarse
 * to fine. Each iteration searches for correspondences, detects and avoids flips, propagates
 * displacements, and solves a Laplacian deformation. A guard limits every motion, so the surface
 * stays embedded, however its faces are cut into triangles, and no face flips. Vertices that have
 * moved lie at single-precision numbers, where these are fine enough, so that every file format
 * contains exactly the surface that was certified.
 *
 * The stages own most parameters; see GetDiffusion(), GetFeature(), GetSearch(), and GetDeform().
 * Chained one by one (vtkSeedRegionDiffusion, vtkGMMFeatureFilter, vtkCorrespondenceSearch,
 * vtkFlipFreeDeform, vtkFlipFreeRefinement), they give the same surface.
 *
 * Input port 0: vtkImageData with one scalar component of any type; coordinates are the image's
 * physical millimeters, and the direction matrix is honored.
 * Voxels that are not finite (NaN, infinity, beyond the range of float) have no data, such as
 * padding, or what lies outside the field of view. They are as what lies beyond the image's end:
 * nothing is learned from them, and the surface goes no further than their border, to within a
 * voxel. What the organ encloses is inside the surface, as any hole is.
 *
 * Input port 1, optional: vtkPolyData, the surface to start from in place of the sphere: closed,
 * embedded. Unless every vertex has four neighbors, the start is the mesh of the midpoints of its
 * edges, whose vertices all have them; it cuts corners off, less so where the surface is fine. It
 * is refined like the sphere, to about as many vertices (see SetLevels()). Less is
 * promised for some of its faces: one of more than eight corners counts only as a fan of triangles,
 * and a degenerate corner may flip.
 *
 * Input port 2, optional, repeatable: vtkPointSet, points that correct the result, with the point
 * array `Constraint` (any number type): 0 for a point outside the organ, 1 inside, 2 on its
 * boundary, 3 for a further seed sphere within the organ, whose radius (mm) is in the point array
 * `Radius`. All data sets together are one set of points; vtkConstraintPointSource makes a data set
 * of a single point. AddInsidePoint() and similar methods add to them. The surface obeys every
 * point: outside and inside points end on their side of it exactly, being obstacles of the guard
 * once they are there, and a boundary point lies within half the smallest spacing of it. The
 * surface starts from the largest seed. The result depends only on the set of points, not on their
 * order or on earlier runs.
 *
 * Input port 3, optional: vtkImageData, a label map with the voxels of the image (up to a tenth of
 * the least spacing), cropped or not and with its axes in any order, from a network, an atlas, or
 * an earlier result. The surface is then that of its voxels of the value StartLabel, of any number
 * of pieces, tunnels and cavities, as vtkFlipFreeLabelSurfaces makes it where it is exact: of
 * triangles, with the center of each voxel on its side. Nothing is searched for in the image. The
 * largest ball in the voxels takes the place of the seed, so SeedCenter and SeedRadius are not
 * used, nor are resolution and levels. Points on port 2 correct the voxels, as they do a foreground
 * found in the image, and the surface obeys them; where they change no voxel, none changes sides.
 *
 * Output port 0: vtkPolyData, the surface, with the point arrays `Displacement` (3 doubles, mm; the
 * last one wanted), `Correspondence` (unsigned char; 0 solitary, 1 matched, 2 flipping) and
 * `Confidence` (float, 0 to 1: how well the image supports the surface there), and the field data
 * `Certified` (double: 1 if the guard was on, 0 otherwise), `Confidence` (double, 0 to 1), and
 * `Provenance` (text: where the surface comes from, with version, image grid, seed, points and all
 * parameters, as the JSON that `flipfree segment --session` repeats).
 * Output port 1: vtkImageData, unsigned char `Labels` of the input's geometry: LabelValue inside.
 * Output port 2: vtkTable `Convergence`, a row per iteration: Iteration, Level, Vertices,
 * MeanDistance (mm), Matched, Solitary, Flipping, Guarded (vertices that the guard limited), and
 * the seconds of its stages, SearchSeconds, FlipSeconds, SolveSeconds, GuardSeconds.
 * Output port 3: vtkTable `Questions`, a row per part of which Carving was not sure, at most five,
 * those first where an answer is worth most: x, y, z (double, mm; where it is deepest), volume_ml
 * (double), included (int; 1 in the surface, 0 left out), margin (double; by how much the contrary
 * costs more, per mm3: the smaller, the more doubtful). The answer yes is an inside point there, no
 * an outside point. Parts in whose neighborhood such a point or a further seed lies, within the
 * radius of a ball of the part's volume, are answered, and no longer in the table.
 *
 * Errors, with a code of FlipFreeErrorCode.h. Each is reported once, and the outputs are then
 * empty.
 * - Image: no scalars, several components, or no voxels.
 * - Seed: its center outside the image; smaller than a voxel, or wider than the image's longest
 *   side; a Reach that ends within it; a voxel without data in it; no contrast to its surroundings.
 * - Start surface: open, not a consistently oriented 2-manifold, or self-intersecting.
 * - Correction, which the error names: outside the image, where there is no data (unless it is an
 *   outside point), contradicting another one or the seed,
 *   not to be obeyed by a surface of one piece, or given without the guard.
 * - Start labels: with other voxels than the image's, without voxels of StartLabel, or given
 *   together with a start surface.
 * - A property that is NaN.
 * - A connection, seed or threshold of a stage, which would have no effect (see GetDiffusion()).
 *
 * Warnings, which still give a result:
 * - The seed sphere reaches beyond the image.
 * - Its gray values scatter more than 4.5 times as much as those in its inner half. With Carving,
 *   the warning says which sphere was used in its place.
 * - The surface touches the end of Reach.
 * - More than a fiftieth of the surface lies beside voxels without data.
 * - No vertex found a boundary, or the surface could not be refined.
 * - A surface grown from the seed under the guard may be air's: more than a tenth of it found no
 *   boundary (unless search lines are shorter than by default), or more than a quarter of it lies
 *   at the image's border along two axes.
 * - Start labels: some of them lie outside the image.
 * - If none of these applies: the confidence is below 0.85, or a question has a margin below 2.1
 *   and is about more than 8 % of the organ's volume. The warning asks the first such question.
 *   Without one, look at the contour where its confidence is low, and correct it there by points.
 *   There is no such warning with corrections, of which the confidence's threshold knows nothing,
 *   nor without carving, as in the presets Published and Naive.
 *
 * Source: the paper, Algorithm 1 and sections 3.1 to 3.6. Extensions can be switched off; the rules
 * of Carving share a switch.
 */
#ifndef vtkFlipFreeSegmentation_h
#define vtkFlipFreeSegmentation_h

#include "FlipFreeSegmentationModule.h"
#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h" // for the stages

#include <memory> // for std::unique_ptr
#include <string> // for names
#include <vector> // for the constraints

class vtkCorrespondenceSearch;
class vtkFlipFreeDeform;
class vtkGMMFeatureFilter;
class vtkImageData;
class vtkPointSet;
class vtkPolyData;
class vtkSeedRegionDiffusion;
class vtkTable;

namespace FlipFree
{
class FilterSettings;
struct OrganSegmentationSettings;
struct PointConstraint;
struct SegmentationResult;
struct SegmentationState;
struct VolumeSegmentation;
struct VolumeSegmentationSettings;
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
  vtkTable* GetQuestions();
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
   * The points that correct the result (input port 2): SetConstraintConnection() and
   * SetConstraintData() replace earlier ones, AddConstraintConnection() and AddConstraintData() add
   * more, and RemoveAllConstraintConnections() disconnects all.
   */
  void SetConstraintConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }
  void SetConstraintData(vtkPointSet* points);
  void AddConstraintConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(2, output); }
  void AddConstraintData(vtkPointSet* points);
  void RemoveAllConstraintConnections() { this->RemoveAllInputConnections(2); }
  ///@}

  ///@{
  /**
   * Connects or sets the label map that the surface is to fill (input port 3).
   */
  void SetStartLabelsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(3, output); }
  void SetStartLabelsData(vtkImageData* labels);
  ///@}

  ///@{
  /**
   * Which voxels of input port 3 the surface fills: those of this value, or, if it is 0, all
   * nonzero ones. Default 1; 0 to 2147483647. Without that input, it has no effect.
   */
  void SetStartLabel(int value);
  int GetStartLabel() const;
  ///@}

  ///@{
  /**
   * Adds a point that corrects the result, in millimeters, to those of input port 2: one that lies
   * inside the organ, outside it, or on its boundary; or a further seed sphere within it.
   */
  void AddInsidePoint(double x, double y, double z);
  void AddOutsidePoint(double x, double y, double z);
  void AddBoundaryPoint(double x, double y, double z);
  void AddSeed(double x, double y, double z, double radius);
  ///@}

  ///@{
  /**
   * The number of points added, not counting those of input port 2; removes the last one added, if
   * there is one, or all.
   */
  int GetNumberOfCorrections() const;
  void RemoveLastCorrection();
  void RemoveAllCorrections();
  ///@}

  ///@{
  /**
   * What one more inside or outside point would change in the result, in milliliters: the part of
   * the organ, or of a leak, that the next Update() would add or take. The surface follows it as
   * far as it can. `changed`, unless it is null, becomes an image of the voxels that change sides:
   * scalars `Changed` (unsigned char, 1 where they do), cut out of the input's grid; without voxels
   * if there are none. No surface is deformed, so it takes some hundredths of a second, and longer
   * where more of the image has to be smoothed. Returns -1, with no error, where this is not known:
   * before the first Update(), without KeepForCorrections or Carving, and for a point that lies
   * beyond the region of the last Update() or that Update() would refuse.
   */
  double PreviewInsidePoint(double x, double y, double z, vtkImageData* changed);
  double PreviewOutsidePoint(double x, double y, double z, vtkImageData* changed);
  ///@}

  ///@{
  /**
   * Keep the smoothed image, and other results that corrections do not change, between runs, so
   * that a correction takes about a third of the time. Default off, since it needs memory: the
   * smoothed part of the image as floats. The next Update() after the image, the seed or a
   * parameter has changed frees it; after writing voxels in place, call the image's Modified().
   */
  void SetKeepForCorrections(bool value);
  bool GetKeepForCorrections() const;
  vtkBooleanMacro(KeepForCorrections, bool);
  ///@}

  ///@{
  /**
   * All parameters of the method at once, those of the stages included; seed, start, outputs and
   * Reach stay. Default: the best known parameters. Published: the paper's own method, one level,
   * outward search by voxels, no leak control, no guard. Naive: as published, without flip
   * avoidance (the paper's Fig. 3b).
   */
  void UseDefaultParameters();
  void UsePublishedParameters();
  void UseNaiveParameters();
  ///@}

  ///@{
  /**
   * The stages, which own the parameters of their part of the method; changing one makes this
   * filter execute again. Only their parameters are used here. What would have no effect is an
   * error of Update(): a connection of a stage; SeedCenter and SeedRadius of GetDiffusion() and
   * GetFeature(), for which this filter has its own; and Threshold of GetSearch(), in place of
   * which FeatureThreshold of GetFeature() counts. Setting null sets a new stage with default
   * parameters.
   */
  vtkSeedRegionDiffusion* GetDiffusion() const;
  void SetDiffusion(vtkSeedRegionDiffusion* stage);
  vtkGMMFeatureFilter* GetFeature() const;
  void SetFeature(vtkGMMFeatureFilter* stage);
  vtkCorrespondenceSearch* GetSearch() const;
  void SetSearch(vtkCorrespondenceSearch* stage);
  vtkFlipFreeDeform* GetDeform() const;
  void SetDeform(vtkFlipFreeDeform* stage);
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
   * Radius of the seed sphere, in millimeters. Default 10; 1e-6 to 1e6. At least half the radius of
   * the largest sphere that fits into the organ there is recommended. With Carving, a sphere that
   * reaches out of its tissue is replaced by a smaller one: its radius is reduced by a fifth until
   * its gray values scatter at most 1.5 times as much as those in its inner half. The lengths below
   * that are given in seed radii scale with what is left; Reach does not. Errors, other organs
   * and the confidence know the sphere as it is given, and further seed spheres are never made
   * smaller.
   */
  void SetSeedRadius(double value);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * Radius of the mesh's first sphere in seed radii. Default 1; 1e-3 to 1e3. Together with
   * StartCenterOffset it lets the mesh start elsewhere, e.g. around the object, as in the paper's
   * Fig. 1.
   */
  void SetStartScale(double value);
  double GetStartScale() const;
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
  void SetResolution(int value);
  int GetResolution() const;
  ///@}

  ///@{
  /**
   * Number of levels from coarse to fine. Default 4; 1 to 6. Levels that would begin with fewer
   * than two vertices along an edge are left out. Each level after the first has four times as many
   * vertices. A start surface on port 1 has only as many levels as bring its number of vertices
   * closest to 6 n²: one of 384 has three by default, and an earlier result, of 6,144, just one.
   */
  void SetLevels(int value);
  int GetLevels() const;
  ///@}

  ///@{
  /**
   * Maximum number of iterations at each level. Default 40; 0 to 100000.
   */
  void SetMaximumIterations(int value);
  int GetMaximumIterations() const;
  ///@}

  ///@{
  /**
   * A level ends when the mean distance to the targets falls below this, in voxels of the greatest
   * spacing. Default 0.1; 0 to 1e6.
   */
  void SetDistanceTolerance(double value);
  double GetDistanceTolerance() const;
  ///@}

  ///@{
  /**
   * A level ends when the mean distance has fallen by less than this over five iterations, in
   * voxels of the greatest spacing. Default 0.02; -1e6 to 1e6. A negative value never ends it.
   */
  void SetChangeTolerance(double value);
  double GetChangeTolerance() const;
  ///@}

  ///@{
  /**
   * How far from the seed's center, in millimeters, the surface may get; only this box of the image
   * is read. At least SeedRadius. Default 0: ten seed radii, at least 100 and at most 250 mm. Of
   * GetDiffusion().
   */
  void SetReach(double value);
  double GetReach() const;
  ///@}

  ///@{
  /**
   * Iterations of the anisotropic diffusion that smooths the image first (section 3.2). Default 5,
   * 0 to 1000; 0 for an image that is already smooth. NumberOfIterations of GetDiffusion().
   */
  void SetDiffusionIterations(int value);
  int GetDiffusionIterations() const;
  ///@}

  ///@{
  /**
   * Mass of the mixture above the threshold Gamma of Eq. 2. Default 0.95; 0.01 to 0.99999. Of
   * GetFeature().
   */
  void SetForegroundMass(double value);
  double GetForegroundMass() const;
  ///@}

  ///@{
  /**
   * Close and open the foreground by balls and keep the seed's component, so that thin bridges to
   * neighbors do not leak. Default on. Of GetFeature().
   */
  void SetLeakControl(bool value);
  bool GetLeakControl() const;
  vtkBooleanMacro(LeakControl, bool);
  ///@}

  ///@{
  /**
   * Length of the search lines, in millimeters. Default 0, 0 to 1e6; 0 derives it from the seed's
   * radius. Of GetSearch().
   */
  void SetSearchDistance(double value);
  double GetSearchDistance() const;
  ///@}

  ///@{
  /**
   * Limit each motion so that the surface neither meets itself nor flips. Default on; off gives no
   * guarantee. Of GetDeform().
   */
  void SetGuard(bool value);
  bool GetGuard() const;
  vtkBooleanMacro(Guard, bool);
  ///@}

  ///@{
  /**
   * Value of the organ's voxels in the label map. Default 1; 1 to 255.
   */
  void SetLabelValue(int value);
  int GetLabelValue() const;
  ///@}

  ///@{
  /**
   * Keep the surface of every iteration, and offer them as time steps: time t is the surface after
   * iteration t. How many there are is known after the first Update(). Default off.
   */
  void SetKeepHistory(bool value);
  bool GetKeepHistory() const;
  vtkBooleanMacro(KeepHistory, bool);
  ///@}

  /**
   * Why a segmentation ended.
   */
  enum StopReasons
  {
    NOT_RUN = 0,                  ///< no Update() yet, or the last one failed
    DISTANCE_BELOW_TOLERANCE = 1, ///< of the mean distance to the targets
    CONVERGED = 2,                ///< the mean distance no longer falls
    ITERATION_LIMIT = 3,
    NO_BOUNDARY_FOUND = 4, ///< by any vertex
    NOT_REFINED = 5, ///< the surface is that of a coarser level; its refinement intersects itself
    ABORTED = 6      ///< surface and label map are empty
  };

  ///@{
  /**
   * Why the last level ended, after Update(): one of StopReasons, or the same in words: "distance
   * below tolerance", "converged", "iteration limit", "no boundary found", "the coarse surface
   * could not be refined", "aborted"; empty for NOT_RUN.
   */
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString() const;
  ///@}

  /**
   * Pairs of faces of the result that intersect for some way of cutting them into triangles,
   * counted exactly and independently of the guard; -1 before Update().
   */
  vtkGetMacro(NumberOfSelfIntersections, int);

  /**
   * How far the result can be trusted, 0 to 1; -1 before Update(). It estimates the Dice score:
   * below 0.85 the result is doubtful, and usually a warning says so; see Warnings above. The point
   * array `Confidence` says where to look.
   */
  vtkGetMacro(Confidence, double);

  ///@{
  /**
   * Seconds of the last Update() by stage: smoothing, feature, deformation, label map. Deformation
   * includes the exact count of self-intersections; label map includes confidence and warnings.
   */
  vtkGetVector4Macro(StageSeconds, double);
  ///@}

  /**
   * Includes the modification times of the stages and of the points added.
   */
  vtkMTimeType GetMTime() override;

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
  double StartCenterOffset[3] = { 0, 0, 0 };
  int StartLabel = 1;
  bool KeepForCorrections = false;

  int StopReason = NOT_RUN;
  int NumberOfSelfIntersections = -1;
  double Confidence = -1;
  double StageSeconds[4] = { 0, 0, 0, 0 };

private:
  friend class FlipFree::FilterSettings;
  FlipFree::VolumeSegmentationSettings GetSettings() const;
  /// `owner` is what comes after the name of a stage's getter.
  void RequireNoUnusedStageSettings(const std::string& owner = "") const;
  void UseSettings(const FlipFree::VolumeSegmentationSettings& settings);
  void UseMethod(const FlipFree::OrganSegmentationSettings& method);
  bool IsCacheUpToDate(vtkInformationVector** inputs);
  void UpdateCache(vtkInformationVector** inputs);
  FlipFree::VolumeSegmentation Run(vtkInformationVector** inputs);
  std::vector<FlipFree::PointConstraint> AllConstraints(vtkInformationVector* points) const;
  void AddConstraint(const FlipFree::PointConstraint& constraint);
  double Preview(const FlipFree::PointConstraint& constraint, vtkImageData* changed);

  const std::unique_ptr<FlipFree::VolumeSegmentationSettings> Settings; // stages have theirs
  vtkSmartPointer<vtkSeedRegionDiffusion> Diffusion;
  vtkSmartPointer<vtkGMMFeatureFilter> Feature;
  vtkSmartPointer<vtkCorrespondenceSearch> Search;
  vtkSmartPointer<vtkFlipFreeDeform> Deform;
  std::unique_ptr<FlipFree::SegmentationResult> Cache;
  std::unique_ptr<FlipFree::SegmentationState> State;
  const std::unique_ptr<std::vector<FlipFree::PointConstraint>> Constraints;

  vtkFlipFreeSegmentation(const vtkFlipFreeSegmentation&) = delete;
  void operator=(const vtkFlipFreeSegmentation&) = delete;
};

#endif
