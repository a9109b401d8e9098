/**
 * @class   vtkMedicalImageReader
 * @brief   reads a medical image with its orientation
 *
 * Reads a volume from a NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd) file,
 * from a folder of DICOM files, or from a DICOM file of several frames. Physical coordinates are
 * LPS (x to the patient's left, y to the back, z to the head) millimeters; those of NIfTI and NRRD
 * are converted. Axes need not be at right angles. The voxels keep the type of the file, or are
 * float or double where the file scales them. Of a NIfTI file with two orientations, the sform is
 * taken, if its code is above 0 and it can be inverted. NaN voxels stay so.
 *
 * A folder may hold several DICOM series, with and without preambles, of slices or of multi-frame
 * images, and much else beside them. A series may hold several volumes (times, echoes, stacks,
 * acquisitions at one place); each is chosen by `UID#1`, `UID#2` and so on, and in the following
 * counts as a series. They are listed by GetNumberOfSeries() and its companions once the
 * information has been updated, or FindSeries() was called; SeriesUID chooses one, and
 * GetChosenSeriesUID() says which one was read. Its slices are ordered by position. A tilted gantry
 * gives a direction matrix that is not orthogonal, so that each voxel stays where it was measured.
 * Voxels are gray values, of the least integer type that holds all that the pixels and the rescale
 * slopes allow, or float where these are not whole. Folders within the folder are searched only
 * beside a DICOMDIR, as on a CD.
 *
 * What is no slice of the series is left out: objects without pixels, scouts, a slice that is there
 * twice, damaged files of other series. One warning says how many files, and why.
 *
 * Output port 0: vtkImageData with one component of scalars, `ImageScalars`. Image field data: for
 * DICOM, `SeriesUID`, one string, which SeriesUID would take to read the same again; for a file
 * that says what its labels are called (a segmentation of 3D Slicer, .seg.nrrd, or a NIfTI file
 * with a label table, as TotalSegmentator writes it), `SegmentLabels` (double), `SegmentNames` and
 * `SegmentColors` (texts, the latter such as \#ffd24a, or empty).
 *
 * RequestInformation gives extent, spacing, origin, direction and scalar type from the header
 * alone.
 *
 * Errors: no file name; a missing, unreadable, truncated or damaged file; a header with an invalid
 * field, such as a spacing of NaN, which the error names; an unknown format; 2D and 4D images;
 * several components per voxel; a folder without DICOM images or without the wanted series; a
 * series of several volumes of which none is chosen; a damaged or unreadable file of the series;
 * missing slices; slices without a pixel spacing, a position or an orientation; slices that are
 * unevenly spaced; pixels in other bits than HighBit and BitsStored name. GetErrorCode() gives the
 * vtkErrorCode. Slices that deviate from an even stack by more than 1 % of the slice spacing give a
 * warning, and by more than half of it an error. What a file does not say, or says twice, such as
 * the voxel size or how its axes lie in the patient, gives a warning of what was taken.
 */
#ifndef vtkMedicalImageReader_h
#define vtkMedicalImageReader_h

#include "FlipFreeImagingModule.h"
#include "vtkImageAlgorithm.h"

#include <exception>
#include <memory>
#include <string>

namespace FlipFree
{
struct DicomVolume;
}

class FLIPFREEIMAGING_EXPORT vtkMedicalImageReader : public vtkImageAlgorithm
{
public:
  static vtkMedicalImageReader* New();
  vtkTypeMacro(vtkMedicalImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file, or the folder of a DICOM series. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Series Instance UID of the DICOM series to read, followed by `#1`, `#2` and so on where it
   * holds several volumes. Empty or unset (the default) means the series with the greatest volume,
   * that of the most slices. Not used for files of other formats.
   */
  vtkSetStringMacro(SeriesUID);
  vtkGetStringMacro(SeriesUID);
  ///@}

  /**
   * Lists the series of the folder FileName without choosing one, so that none needs to be
   * readable. False, with an error, if there is none.
   */
  bool FindSeries();

  ///@{
  /**
   * A label of a label map: of a segmentation of 3D Slicer (.seg.nrrd), or of a NIfTI file with a
   * label table, a segment by its name, in whichever case; of any file, the value of its voxels,
   * "6". Of several layers, which hold segments that overlap, the output is the one that holds it;
   * all labels of that layer are there, and GetSegmentLabel() says which value is meant. Empty or
   * unset (the default), there may be but one layer.
   */
  vtkSetStringMacro(Segment);
  vtkGetStringMacro(Segment);
  ///@}

  /**
   * The value of the voxels of Segment; -1 where none was chosen.
   */
  int GetSegmentLabel();

  ///@{
  /**
   * The DICOM series that the last UpdateInformation() or FindSeries() found in the folder, the one
   * with the greatest volume first: what SeriesUID takes, Series Number, description, modality,
   * number of slices, and why it cannot be read, if so. A single file has none. An index out of
   * range gives empty texts, or no slices.
   */
  int GetNumberOfSeries();
  std::string GetSeriesUID(int index);
  std::string GetSeriesNumber(int index);
  std::string GetSeriesDescription(int index);
  std::string GetSeriesModality(int index);
  int GetSeriesNumberOfSlices(int index);
  std::string GetSeriesProblem(int index);
  ///@}

  /**
   * Voxel spacing of a series in millimeters; zeros if it cannot be read.
   */
  void GetSeriesSpacing(int index, double spacing[3]);

  /**
   * The series that was chosen, as SeriesUID takes it; null if the image is not DICOM.
   */
  const char* GetChosenSeriesUID();

protected:
  vtkMedicalImageReader();
  ~vtkMedicalImageReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;
  char* SeriesUID = nullptr;
  char* Segment = nullptr;

private:
  vtkMedicalImageReader(const vtkMedicalImageReader&) = delete;
  void operator=(const vtkMedicalImageReader&) = delete;

  int Fail(const std::exception& error, vtkInformation* outInfo);
  const FlipFree::DicomVolume* SeriesAt(int index);

  struct Source;
  std::unique_ptr<Source> Found;
};

#endif
