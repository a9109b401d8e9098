/**
 * What results say of their origin: the field data `Provenance` of surfaces, which is a session. It
 * knows no names of files, and of one organ no name; they are added here. `--save-session` writes
 * the sessions of all surfaces of a run as one, which `segment --session` repeats.
 */
#ifndef FlipFreeCommandSessionRecord_h
#define FlipFreeCommandSessionRecord_h

#include <string>
#include <vector>

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

/// With the names, of files without their folders.
std::string NamedProvenance(const std::string& provenance, const OriginNames& names);

/// The name of an organ that has none, after the first file that has a name: `liver` for
/// `out/liver.vtp`.
std::string OrganOfFiles(const std::vector<std::string>& files);

/// An organ's name as it can stand in names of files: letters, digits and dashes.
std::string FileNameOf(const std::string& organ);

/// The sessions, one for each organ or one for all, as one: what a file of that name holds.
std::string SessionText(const std::string& name, const std::vector<std::string>& sessions);

} // namespace Command

#endif
