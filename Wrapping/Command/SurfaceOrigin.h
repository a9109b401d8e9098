/**
 * Where VTK's objects keep what they say of their origin (SessionRecord.h), and the names of
 * labels.
 */
#ifndef FlipFreeCommandSurfaceOrigin_h
#define FlipFreeCommandSurfaceOrigin_h

#include "SessionRecord.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkPolyData;

namespace Command
{

/// The field data `Provenance`; empty where there is none.
std::string ProvenanceOf(vtkPolyData* surface);

/// The same surface, of which the field data have the names.
vtkSmartPointer<vtkPolyData> WithNames(vtkPolyData* surface, const OriginNames& names);

/// Says in the field data of a label map which organ has which label, from `first` on: for files
/// that hold it (.seg.nrrd).
void NameSegments(vtkImageData* labels, int first, const OriginNames& names);

} // namespace Command

#endif
