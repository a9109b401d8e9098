/**
 * @class   vtkPhantomSource
 * @brief   synthetic volumes whose segmentation is known exactly
 *
 * Makes a gray volume and the label map that is its ground truth. The plain shapes are one object
 * of intensity Foreground in a Background: a sphere and a cube, the concave cup and the U-shaped
 * tube of Fig. 1 of the paper, and a thin curved vessel. ABDOMEN is a schematic CT of the upper
 * abdomen in the portal phase, in Hounsfield units: body wall with ribs and spine, lungs, heart,
 * liver with its vessels, spleen, kidneys, stomach, bowel and great vessels, with uneven tissue,
 * partial volume and noise. As in patients, organs touch neighbors of similar intensity.
 *
 * Shapes are sized in proportion to the grid, lie at its center, and are aligned with its axes: a
 * Direction turns the phantom with the grid without changing any voxel's value. For the abdomen the
 * first axis points to the patient's left, the second to the back, the third to the head; with the
 * identity as Direction that is the LPS frame of DICOM and ITK.
 *
 * The volume depends on the properties alone, bit for bit, not on the number of threads.
 *
 * Output port 0: vtkImageData with the point scalars
 *  - `Intensity`, short: HU for the abdomen.
 *
 * Output port 1: vtkImageData of the same geometry with the point scalars
 *  - `Labels`, unsigned char: what lies at the voxel's center; 0 nothing in particular, 1 the
 *    object of a plain shape, for the abdomen one of OrganLabel.
 *
 * Output port 2: vtkPolyData, the surface of a plain shape as triangles whose points lie exactly on
 * it, if GenerateSurface is on; empty otherwise, and for the abdomen.
 *
 * Errors, with a code of FlipFreeErrorCode.h: a dimension below 1, more than 2^31 - 1 voxels, a
 * spacing that is not positive, a Direction that cannot be inverted, intensities outside the range
 * of short, a negative NoiseStandardDeviation, a NoiseCorrelation outside 0 to 0.7. They are
 * reported once and leave the outputs empty.
 */
#ifndef vtkPhantomSource_h
#define vtkPhantomSource_h

#include "FlipFreePhantomsModule.h"
#include "vtkImageAlgorithm.h"

class vtkPolyData;

class FLIPFREEPHANTOMS_EXPORT vtkPhantomSource : public vtkImageAlgorithm
{
public:
  static vtkPhantomSource* New();
  vtkTypeMacro(vtkPhantomSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Values of Shape.
   */
  enum ShapeType
  {
    SPHERE = 0,
    CUBE = 1,
    CUP = 2,
    U_TUBE = 3,
    VESSEL = 4,
    ABDOMEN = 5
  };

  /**
   * Values of the label map. OBJECT is that of the plain shapes; the others are the abdomen's, as
   * in the BTCV challenge (left and right are the patient's). Vessels and lesions inside the liver
   * are part of it; the renal sinus is not part of the kidney. Bowel, heart and bones are 0.
   */
  enum OrganLabel
  {
    OBJECT = 1,
    SPLEEN = 1,
    RIGHT_KIDNEY = 2,
    LEFT_KIDNEY = 3,
    GALLBLADDER = 4,
    ESOPHAGUS = 5,
    LIVER = 6,
    STOMACH = 7,
    AORTA = 8,
    VENA_CAVA = 9,
    PORTAL_VEIN = 10,
    PANCREAS = 11
  };

  ///@{
  /**
   * What the volume shows. Default SPHERE.
   *
   * The sizes of the plain shapes follow, in units of 1/96 of the grid's shortest extent (so in mm
   * for the default grid). SPHERE: radius 30. CUBE: edge 52. CUP: opens along the third axis;
   * height 64, wall 16, cavity 32 wide and 40 deep. U_TUBE: tube radius 9, half circle of radius
   * 18, legs of 30 along the third axis. VESSEL: tube radius 4 along an S-shaped space curve of
   * length 105.
   *
   * The ABDOMEN's cross-section of 330 x 255 mm is scaled to fit the grid's first two axes; along
   * the third axis, the grid shows as much as fits, at most 270 mm.
   */
  vtkSetClampMacro(Shape, int, SPHERE, ABDOMEN);
  vtkGetMacro(Shape, int);
  void SetShapeToSphere() { this->SetShape(SPHERE); }
  void SetShapeToCube() { this->SetShape(CUBE); }
  void SetShapeToCup() { this->SetShape(CUP); }
  void SetShapeToUTube() { this->SetShape(U_TUBE); }
  void SetShapeToVessel() { this->SetShape(VESSEL); }
  void SetShapeToAbdomen() { this->SetShape(ABDOMEN); }
  ///@}

  ///@{
  /**
   * Number of voxels along each axis. Default (0, 0, 0): as suits the shape, 96 x 96 x 96 or,
   * for the abdomen, 220 x 170 x 90.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * Distance of voxel centers along each axis in millimeters. Default (0, 0, 0): as suits the
   * shape, 1 x 1 x 1 or, for the abdomen, 1.5 x 1.5 x 3.
   */
  vtkSetVector3Macro(Spacing, double);
  vtkGetVector3Macro(Spacing, double);
  ///@}

  ///@{
  /**
   * Center of the first voxel in physical millimeters. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  ///@}

  ///@{
  /**
   * The grid's axes in physical space, as the columns of a 3 x 3 matrix given row by row, like
   * vtkImageData's direction matrix. Permuted, oblique and left-handed axes are fine. Default: the
   * identity.
   */
  vtkSetVectorMacro(Direction, double, 9);
  vtkGetVectorMacro(Direction, double, 9);
  ///@}

  ///@{
  /**
   * Intensities of the object and of what surrounds it, for the plain shapes. Defaults 100 and 0;
   * they have no effect on the abdomen. Intensities are rounded to integers after partial volume
   * and noise: leave them far enough apart.
   */
  vtkSetMacro(Foreground, double);
  vtkGetMacro(Foreground, double);
  vtkSetMacro(Background, double);
  vtkGetMacro(Background, double);
  ///@}

  ///@{
  /**
   * Standard deviation of the Gaussian noise, in units of intensity. Default 12; 0 or more.
   */
  vtkSetMacro(NoiseStandardDeviation, double);
  vtkGetMacro(NoiseStandardDeviation, double);
  ///@}

  ///@{
  /**
   * Correlation of the noise of direct neighbors within a slice, as CT reconstruction leaves it;
   * slices are independent. Default 0.3; 0 (white noise) to 0.7.
   */
  vtkSetMacro(NoiseCorrelation, double);
  vtkGetMacro(NoiseCorrelation, double);
  ///@}

  ///@{
  /**
   * The number from which the random numbers are derived. Default 1; any integer.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  ///@{
  /**
   * Dark round lesions (4 to 12 mm in radius, 68 HU) in the abdomen's liver, their places and sizes
   * drawn at random. Default 0; 0 to 20. If there is no room for that many, there are fewer.
   */
  vtkSetClampMacro(NumberOfLesions, int, 0, 20);
  vtkGetMacro(NumberOfLesions, int);
  ///@}

  ///@{
  /**
   * Whether a voxel on a border gets the mean over its volume (by up to 4 x 4 x 4 samples) or the
   * intensity at its center. The labels are always those at the centers. Default on.
   */
  vtkSetMacro(PartialVolume, bool);
  vtkGetMacro(PartialVolume, bool);
  vtkBooleanMacro(PartialVolume, bool);
  ///@}

  ///@{
  /**
   * Whether to make the surface of a plain shape, output port 2. Default off.
   */
  vtkSetMacro(GenerateSurface, bool);
  vtkGetMacro(GenerateSurface, bool);
  vtkBooleanMacro(GenerateSurface, bool);
  ///@}

  /**
   * A place to start a segmentation from: the center (physical millimeters) and radius (mm) of a
   * ball deep inside the organ of the given label; the radius is at most 0.7 times the distance to
   * the organ's border. True if there is such an organ and the grid holds its seed. Needs no
   * update.
   */
  bool GetSeed(int label, double seed[4]);

  /**
   * Center and radius of a ball that holds the whole object of a plain shape with some clearance,
   * to start from outside. False for the abdomen. Needs no update.
   */
  bool GetEnclosingSphere(double sphere[4]);

  /**
   * Two points on the axis of the vessel near its ends, between which it can be traced. False for
   * other shapes. Needs no update.
   */
  bool GetVesselEnds(double ends[6]);

  /**
   * The label map, output port 1.
   */
  vtkImageData* GetLabelMap();

  /**
   * The surface, output port 2.
   */
  vtkPolyData* GetSurface();

protected:
  vtkPhantomSource();
  ~vtkPhantomSource() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Shape = SPHERE;
  int Dimensions[3] = { 0, 0, 0 };
  double Spacing[3] = { 0, 0, 0 };
  double Origin[3] = { 0, 0, 0 };
  double Direction[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  double Foreground = 100;
  double Background = 0;
  double NoiseStandardDeviation = 12;
  double NoiseCorrelation = 0.3;
  int RandomSeed = 1;
  int NumberOfLesions = 0;
  bool PartialVolume = true;
  bool GenerateSurface = false;

private:
  vtkPhantomSource(const vtkPhantomSource&) = delete;
  void operator=(const vtkPhantomSource&) = delete;
};

#endif
