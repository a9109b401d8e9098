/**
 * @class   vtkFlipFreeOrganGroup
 * @brief   several organs of a volume, segmented together
 *
 * Segments organs as vtkFlipFreeSegmentation does, each from a seed sphere, but all of them
 * together: each organ is background for the others, and all surfaces grow under one guard, so that
 * they never meet, and no voxel is in two of them. Seeds and inside points of an organ are outside
 * points of all others. The result does not depend on the order of the organs.
 *
 * Points are obeyed as by vtkFlipFreeSegmentation, but nothing is kept between runs: with other
 * points, all organs are segmented anew, and surfaces may move slightly everywhere.
 *
 * First, the foreground of each organ is found separately; voxels that several organs claim are
 * divided by a minimum cut along the edges of the image; then all surfaces start again and deform
 * together.
 *
 * Input port 0: vtkImageData, as for vtkFlipFreeSegmentation.
 * Input port 1, optional, repeatable: vtkPointSet, points and further seeds of the organs, with the
 * point arrays `Constraint` and `Radius` of vtkFlipFreeSegmentation and `Organ`: the names of
 * organs (vtkStringArray), or their numbers, counted from 1 in the order of AddOrgan(), and then of
 * the names. A point with a new name, or with the next number, adds an organ, which needs a seed;
 * one without a name is called `organ 2` or the like. vtkConstraintPointSource makes a data set of
 * a single point.
 * Input port 2, optional, repeatable: vtkPolyData, a surface that stays as it is and that no organ
 * touches, such as an earlier result or a mesh in STL: closed and embedded.
 *
 * Output port 0: vtkMultiBlockDataSet, a vtkPolyData per organ, under its name, with the arrays of
 * vtkFlipFreeSegmentation, and the field data `Organ` (text), the name; its `Provenance` is that of
 * all organs together.
 * Output port 1: vtkImageData, unsigned char `Labels` of the input's geometry: LabelValue inside
 * the first organ, and one more inside each further one. Its field data `SegmentLabels` (double),
 * `SegmentNames` and `SegmentColors` (texts such as \#ffd24a) say which organ has which label;
 * vtkMedicalImageWriter writes them into files of 3D Slicer (.seg.nrrd).
 * Output port 2: vtkTable, a row per organ: Organ (its name), Label, Milliliters (of its voxels),
 * Iterations, StopReason (in words), Confidence (0 to 1), SelfIntersections.
 *
 * Errors, with a code of FlipFreeErrorCode.h: those of vtkFlipFreeSegmentation, naming the organ;
 * no organ, or one without a seed; two organs whose seeds overlap; a point of one organ in a seed
 * of another; a seed or start sphere that meets a fixed surface; Guard or Carving switched off; a
 * seed, an input or points of GetParameters(). The outputs are then empty. Warnings: those of
 * vtkFlipFreeSegmentation, with the organ's name.
 */
#ifndef vtkFlipFreeOrganGroup_h
#define vtkFlipFreeOrganGroup_h

#include "FlipFreeSegmentationModule.h"
#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h" // for the parameters

#include <memory> // for std::unique_ptr
#include <string> // for names

class vtkFlipFreeSegmentation;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPointSet;
class vtkPolyData;
class vtkTable;

class FLIPFREESEGMENTATION_EXPORT vtkFlipFreeOrganGroup : public vtkAlgorithm
{
public:
  static vtkFlipFreeOrganGroup* New();
  vtkTypeMacro(vtkFlipFreeOrganGroup, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the image (input port 0); SetInputConnection() connects a reader in its place.
   */
  void SetInputData(vtkImageData* image);

  ///@{
  /**
   * Connects or sets the points of the organs (input port 1), replacing earlier ones; adds more;
   * disconnects all.
   */
  void SetConstraintConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetConstraintData(vtkPointSet* points);
  void AddConstraintConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void AddConstraintData(vtkPointSet* points);
  void RemoveAllConstraintConnections() { this->RemoveAllInputConnections(1); }
  ///@}

  ///@{
  /**
   * Connects or adds a surface that stays as it is (input port 2); removes all such surfaces.
   */
  void AddFixedConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(2, output); }
  void AddFixedData(vtkPolyData* surface);
  void RemoveAllFixed() { this->RemoveAllInputConnections(2); }
  ///@}

  ///@{
  /**
   * Adds an organ by its name and a seed sphere that lies within it, in millimeters; removes all
   * organs; returns their number.
   */
  void AddOrgan(const char* name, double x, double y, double z, double radius);
  void RemoveAllOrgans();
  int GetNumberOfOrgans() const;
  ///@}

  ///@{
  /**
   * Adds a point that corrects an organ that has been added, or a further seed sphere within it, in
   * millimeters, as in vtkFlipFreeSegmentation. RemoveAllOrgans() removes them, too.
   */
  void AddInsidePoint(const char* organ, double x, double y, double z);
  void AddOutsidePoint(const char* organ, double x, double y, double z);
  void AddBoundaryPoint(const char* organ, double x, double y, double z);
  void AddSeed(const char* organ, double x, double y, double z, double radius);
  ///@}

  ///@{
  /**
   * The filter whose parameters all organs and stages use. A seed, an input or points of it, which
   * would have no effect, are an error of Update(), as are those of its stages
   * (vtkFlipFreeSegmentation::GetDiffusion()). Its LabelValue, StartLabel, KeepHistory and
   * KeepForCorrections are not used. Changing a parameter makes the group execute again. Setting
   * null sets the defaults.
   */
  vtkFlipFreeSegmentation* GetParameters() const;
  void SetParameters(vtkFlipFreeSegmentation* parameters);
  ///@}

  ///@{
  /**
   * Value of the first organ's voxels in the label map. Default 1; 1 to 255.
   */
  vtkSetClampMacro(LabelValue, int, 1, 255);
  vtkGetMacro(LabelValue, int);
  ///@}

  ///@{
  /**
   * The outputs, after Update().
   */
  vtkMultiBlockDataSet* GetOutput();
  vtkImageData* GetLabelMap();
  vtkTable* GetTable();
  ///@}

  ///@{
  /**
   * For the organ with that index, counted from 0, after Update(): its surface; the tables
   * `Convergence` and `Questions` of vtkFlipFreeSegmentation, null if there is no such organ; why
   * its last level ended, one of vtkFlipFreeSegmentation::StopReasons, or the same in words.
   */
  vtkPolyData* GetSurface(int organ);
  vtkTable* GetConvergence(int organ);
  vtkTable* GetQuestions(int organ);
  int GetStopReason(int organ) const;
  const char* GetStopReasonAsString(int organ) const;
  ///@}

  ///@{
  /**
   * For the organ with that index, after Update(): how far its surface can be trusted, 0 to 1, and
   * the number of pairs of its faces that intersect, counted exactly; -1 if there is no such organ.
   */
  double GetConfidence(int organ) const;
  int GetNumberOfSelfIntersections(int organ) const;
  ///@}

  ///@{
  /**
   * Seconds of the last Update(), over all organs, by stage: smoothing, feature, deformation,
   * label map.
   */
  vtkGetVector4Macro(StageSeconds, double);
  ///@}

  /**
   * Includes the modification time of the parameters.
   */
  vtkMTimeType GetMTime() override;

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**,
    vtkInformationVector*) override;

protected:
  vtkFlipFreeOrganGroup();
  ~vtkFlipFreeOrganGroup() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs);

  int LabelValue = 1;
  double StageSeconds[4] = { 0, 0, 0, 0 };

private:
  void Segment(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void FillOutputs(int organ, const std::string& name, vtkImageData* image,
    vtkInformationVector* outputs);
  void AddPoint(const char* organ, int kind, const double (&point)[3], double radius);

  struct Internals;
  const std::unique_ptr<Internals> Kept;
  vtkSmartPointer<vtkFlipFreeSegmentation> Parameters;

  vtkFlipFreeOrganGroup(const vtkFlipFreeOrganGroup&) = delete;
  void operator=(const vtkFlipFreeOrganGroup&) = delete;
};

#endif
