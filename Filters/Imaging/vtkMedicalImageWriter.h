/**
 * @class   vtkMedicalImageWriter
 * @brief   writes a medical image with its orientation
 *
 * Writes a label map or a gray volume in the format given by the file name's extension:
 * NIfTI (.nii, .nii.gz), NRRD (.nrrd) or MetaImage (.mha, .mhd with its voxels beside it). Origin,
 * spacing, direction matrix and the type of the voxels are kept, so that vtkMedicalImageReader
 * gives the same image back; NIfTI holds its geometry in single precision, as an sform, and as a
 * qform, too, where axes are at right angles. Coordinates are taken as LPS millimeters.
 *
 * If the name ends in .seg.nrrd, a label map is written as a segmentation of 3D Slicer: the same
 * NRRD file, in whose fields each label is a segment with a name and a color. These are the image's
 * field data SegmentLabels (the values in the image), SegmentNames and SegmentColors (texts, such
 * as \#ffd24a; may be empty or absent), as vtkFlipFreeOrganGroup gives them. Labels without such
 * field data are named after the file if there is only one in the image, and after their values,
 * such as Segment_2, if there are several.
 *
 * The image is written beside its destination, read back and compared, flushed to the disk, and
 * renamed only then. So the file is complete, or, after an error or an abort, it does not exist,
 * and an earlier file of that name is untouched. The permissions of a file that is replaced are
 * kept, and a symbolic link is followed.
 *
 * Input port 0: vtkImageData with one component of scalars.
 *
 * Errors: no file name; an unknown extension; no image, no scalars, several components; a folder
 * that is missing or not writable; a full disk; a geometry or a type of voxels that the format
 * cannot hold (NIfTI: more than 32767 voxels along an axis; .seg.nrrd: voxels that are not labels);
 * field data of segments that do not fit together. Write() then returns 0 and GetErrorCode() gives
 * the vtkErrorCode.
 */
#ifndef vtkMedicalImageWriter_h
#define vtkMedicalImageWriter_h

#include "FlipFreeImagingModule.h"
#include "vtkWriter.h"

class vtkImageData;

class FLIPFREEIMAGING_EXPORT vtkMedicalImageWriter : public vtkWriter
{
public:
  static vtkMedicalImageWriter* New();
  vtkTypeMacro(vtkMedicalImageWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write. Its extension determines the format. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Whether NRRD and MetaImage files are compressed. Default on. For NIfTI, the extension decides:
   * .nii.gz is compressed, .nii is not.
   */
  vtkSetMacro(UseCompression, bool);
  vtkGetMacro(UseCompression, bool);
  vtkBooleanMacro(UseCompression, bool);
  ///@}

protected:
  vtkMedicalImageWriter();
  ~vtkMedicalImageWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;
  bool UseCompression = true;

private:
  vtkMedicalImageWriter(const vtkMedicalImageWriter&) = delete;
  void operator=(const vtkMedicalImageWriter&) = delete;
};

#endif
