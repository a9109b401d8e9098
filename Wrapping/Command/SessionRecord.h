/**
 * What results say of their origin: the field data `Provenance` of surfaces, which is a session. It
 * knows no names of files, and of one organ no name; they are added here. `--save-session` writes
 * the sessions of all surfaces of a run as one, which `segment --session` repeats.
 */
#ifndef FlipFreeCommandSessionRecord_h
#define FlipFreeCommandSessionRecord_h

#include "vtkSmartPointer.h"

#include <string>
#include <utility>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace Command
{

/// Names that a surface's own text leaves open; an empty one stays open.
struct OriginNames
{
  std::string Image;       ///< a file or folder
  std::string Series;      ///< of a folder of DICOM files
  std::string StartLabels; ///< a file
  std::string StartLabel;  ///< in it, if it was chosen: a segment's name or a value
  std::vector<std::string> Fixed;
  std::vector<std::string> Organs; ///< in their order
  std::vector<std::string> Colors; ///< likewise, as #ffd24a
};

/// The field data `Provenance`; empty where there is none.
std::string ProvenanceOf(vtkPolyData* surface);

/// With the names, of files without their folders.
std::string NamedProvenance(const std::string& provenance, const OriginNames& names);

/// The same surface, of which the field data have the names.
vtkSmartPointer<vtkPolyData> WithNames(vtkPolyData* surface, const OriginNames& names);

/// Says in the field data of a label map which organ has which label, from `first` on: for files
/// that hold it (.seg.nrrd).
void NameSegments(vtkImageData* labels, int first, const OriginNames& names);

/// The name of an organ that has none, after a file: `liver` for `out/liver.vtp`.
std::string OrganOfFile(const std::string& file);

/// Writes the sessions, one for each organ or one for all, as one.
void WriteSession(const std::string& name, const std::vector<std::string>& sessions);

} // namespace Command

#endif
