/**
 * Reads the sessions that the page in the browser and `--save-session` save: JSON that says which
 * organs and vessels were segmented in which image, from which seeds and points, with which
 * parameters, and how they were corrected. `segment --session` repeats them.
 */
#ifndef FlipFreeCommandSessionFile_h
#define FlipFreeCommandSessionFile_h

#include "PointFile.h"

#include "KernelTypes.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Command
{

struct SessionOrgan
{
  std::string Name;  // as it can stand in names of files
  std::string Title; // as it was given
  std::string Color;
  std::array<double, 3> Seed{ { 0, 0, 0 } }; // LPS millimeters
  double Radius = 0;
  std::string StartLabels; // a file in place of the seed, without a folder
  std::string StartLabel;  // in it, a segment's name or a value; empty if there is none
  std::string Preset;
  std::vector<CorrectionPoint> Corrections;
  std::vector<std::array<double, 3>> Points;             // of a vessel
  std::map<std::string, std::vector<double>> Parameters; // by the names of properties
};

struct Session
{
  std::string File;
  std::string ImageName; // without a folder, which a browser does not tell
  std::string SeriesUID; // of an image that is a folder of DICOM files; may be empty
  std::array<int, 3> Size;
  std::array<double, 3> Spacing;
  std::array<double, 3> Origin;
  std::array<double, 9> Direction;
  std::vector<SessionOrgan> Organs;
  bool Together = false;          // the organs were segmented so
  std::vector<std::string> Fixed; // surfaces that they keep off, without their folders
};

/// Throws a Failure that says what is wrong in the file. There is at least one organ, and their
/// names can stand in names of files and differ.
Session ReadSession(const std::string& name);

/// Where the session's image should be: beside the session. Throws a Failure if it is not there.
std::string ImageBeside(const Session& session);

/// The same of another file of the session; `what` is it.
std::string FileBeside(const Session& session, const std::string& name, const std::string& what);

/// Throws a Failure unless the image has the voxels that the session was made with.
void RequireImageOf(const Session& session, const std::string& name,
  const FlipFree::ImageGeometry& image);

} // namespace Command

#endif
