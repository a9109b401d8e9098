/**
 * @class   vtkBaselineSegmentation
 * @brief   base class of the methods that vtkFlipFreeSegmentation is compared with
 *
 * Every method starts from the same seed sphere as vtkFlipFreeSegmentation, works on the same part
 * of the image after the same anisotropic diffusion (vtkSeedRegionDiffusion), and gives the same
 * two outputs. Each method is a subclass: vtkRegionGrowing, vtkLevelSetSegmentation,
 * vtkGraphCutSegmentation, vtkSimplexMeshSegmentation and vtkGVFSnake.
 *
 * Input port 0: vtkImageData with one scalar component of any type; coordinates are the image's
 * physical millimeters, and the direction matrix is honored.
 *
 * Input port 1, optional: vtkPolyData, the poly lines of a vessel's path, as vtkVesselPath gives
 * them. The method then sees nothing beyond the planes across the path at its ends, and the result
 * ends there: voxels whose nearest point on the path is one of its ends, on the far side of the
 * plane there, are background. This allows methods that have no notion of ends to be compared on
 * vessels.
 *
 * Output port 0: vtkPolyData, the surface: closed, of triangles, even where the organ is cut off by
 * the border of the image. Unlike that of vtkFlipFreeSegmentation, it may have any topology.
 * Output port 1: vtkImageData, unsigned char `Labels` of the input's geometry: LabelValue inside.
 *
 * Errors, with a code of FlipFreeErrorCode.h: no scalars, several components, an empty image,
 * voxels that are not finite within Reach, a seed outside the image, smaller than a voxel or wider
 * than the image, a Reach that ends within a seed, seeds beyond the ends of the path, lines without
 * two points that differ, a property that is not a number, nothing found at the seed, several seeds
 * for a method that starts from one. Each is reported once and leaves the outputs empty. After an
 * abort the outputs are empty without an error.
 */
#ifndef vtkBaselineSegmentation_h
#define vtkBaselineSegmentation_h

#include "vtkPolyDataAlgorithm.h"

#include <array>      // for std::array
#include <functional> // for std::function
#include <vector>     // for std::vector

class vtkImageData;
class vtkPolyData;

namespace FlipFree
{
struct BaselineResult;
struct BaselineTask;
struct SeedSphere;
}

class vtkBaselineSegmentation : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkBaselineSegmentation, vtkPolyDataAlgorithm);

  /**
   * The outputs, after Update(); GetOutput() is the surface, too.
   */
  vtkPolyData* GetSurface();
  vtkImageData* GetLabelMap();

  /**
   * Center of the seed sphere, in millimeters. Default (0, 0, 0). The sphere should lie within the
   * organ: its voxels model the organ's intensities, and the segmentation starts from it.
   */
  vtkSetVector3Macro(SeedCenter, double);
  vtkGetVector3Macro(SeedCenter, double);

  /**
   * Radius of the seed sphere, in millimeters. Default 10; a voxel or more.
   */
  void SetSeedRadius(double value);

  /**
   * Adds a further seed sphere, in millimeters, to that of SeedCenter and SeedRadius; returns the
   * number of further seeds; removes them. The voxels of all seeds model the intensities, and the
   * method starts from all of them, except for vtkSimplexMeshSegmentation and vtkGVFSnake, which
   * take only one.
   */
  void AddFurtherSeed(double x, double y, double z, double radius);
  int GetNumberOfFurtherSeeds() const { return static_cast<int>(this->FurtherSeeds.size()); }
  void RemoveAllFurtherSeeds();

  /**
   * Connects or sets the path of input port 1; nullptr removes it.
   */
  void SetPathConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetPathData(vtkPolyData* path);

  /**
   * Value of the organ's voxels in the label map. Default 1; 1 to 255.
   */
  vtkSetClampMacro(LabelValue, int, 1, 255);

  /**
   * Half the edge length, in millimeters, of the box around each seed's center that is searched.
   * Default 0: ten seed radii, at least 100 and at most 250 mm, as in vtkFlipFreeSegmentation. 0 to
   * 1e6.
   */
  vtkSetClampMacro(Reach, double, 0, 1e6);

  /**
   * Time steps of the anisotropic diffusion before the method. Default 5, as in
   * vtkFlipFreeSegmentation; 0 (none) to 1000.
   */
  vtkSetClampMacro(DiffusionIterations, int, 0, 1000);

  /**
   * Iterations of the last update; 0 for methods that do not iterate, and after a failure.
   */
  vtkGetMacro(NumberOfIterations, int);

protected:
  vtkBaselineSegmentation();
  ~vtkBaselineSegmentation() override = default;

  /**
   * The method itself. Returns false if the monitor stopped it; throws if it fails.
   */
  virtual bool Segment(const FlipFree::BaselineTask& task,
    const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result) = 0;

  /**
   * Throws if a property of the method is not a number.
   */
  virtual void RequireProperties();

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;
  int LabelValue = 1;
  double Reach = 0;
  int DiffusionIterations = 5;
  int NumberOfIterations = 0;

private:
  void Segment(vtkImageData* image, vtkPolyData* path, vtkPolyData* surface, vtkImageData* labels);
  std::vector<FlipFree::SeedSphere> Seeds() const;

  std::vector<std::array<double, 4>> FurtherSeeds; // centers and radii
};

#endif
