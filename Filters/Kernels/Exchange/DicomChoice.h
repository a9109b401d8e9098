/**
 * Which volume of a folder of DICOM files is read, why none is, and what is said of the files that
 * are left out.
 */
#ifndef FlipFreeDicomChoice_h
#define FlipFreeDicomChoice_h

#include "Exchange/DicomVolumes.h"

#include <string>
#include <string_view>

namespace FlipFree
{

/// Throws a FileProblem where a folder has none.
void RequireDicomVolumes(const DicomFolder& folder);

/// The volume that `wanted` names: a Series Instance UID, or one followed by #n; if it is empty,
/// the greatest. A FileProblem where there is no such volume, where it is not the only one, or
/// where it cannot be read.
const DicomVolume& ChooseDicomVolume(const DicomFolder& folder, std::string_view wanted);

/// How many files of the folder are left out if a volume is read, and why; empty where none is.
std::string WarningOfLeftOut(const DicomFolder& folder, const DicomVolume& volume);

} // namespace FlipFree

#endif
