#include "Exchange/DicomChoice.h"

#include "Exchange/DicomGrid.h"
#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"

#include <algorithm>
#include <map>
#include <set>

namespace FlipFree
{
namespace
{

using Reason = DicomLeftOut::Reason;

/// A part of a series this much smaller than the greatest one is beside the point.
constexpr std::size_t FewBesideMany = 4;

/// A folder, or a file by itself.
std::string PlaceOf(const DicomFolder& folder)
{
  const bool isFile = folder.Files.size() == 1 && folder.Files.front().Name == folder.Name;
  return (isFile ? "file " : "folder ") + InQuotes(folder.Name);
}

std::string VolumesText(const std::vector<const DicomVolume*>& volumes)
{
  constexpr std::size_t enough = 12;
  std::string text;
  for (std::size_t index = 0; index < std::min(volumes.size(), enough); ++index)
  {
    const DicomVolume& volume = *volumes[index];
    text += (index ? ", " : "") + volume.Identifier() + " (" +
      std::to_string(volume.Frames.size()) + (volume.Frames.size() == 1 ? " slice" : " slices") +
      (volume.Description.empty() ? "" : ", " + InQuotes(volume.Description)) + ")";
  }
  return text + (volumes.size() > enough ? ", ..." : "");
}

std::vector<const DicomVolume*> VolumesOf(const DicomFolder& folder, const std::string& uid)
{
  std::vector<const DicomVolume*> volumes;
  for (const DicomVolume& volume : folder.Volumes)
  {
    if (volume.SeriesUID == uid)
    {
      volumes.push_back(&volume);
    }
  }
  return volumes;
}

/// A file that may belong to any series.
void RequireNothingLost(const DicomFolder& folder, const DicomVolume& volume)
{
  const std::string extension =
    ExtensionOf(folder.Files[volume.Frames.empty() ? 0 : volume.Frames.front().File].Name);
  for (const DicomLeftOut& left : folder.LeftOut)
  {
    const DicomFile& file = folder.Files[left.File];
    if (left.Why != Reason::Damaged || !left.SeriesUID.empty() ||
      (!file.Unreadable.empty() && ExtensionOf(file.Name) != extension))
    {
      continue;
    }
    throw FileProblem(FileProblem::Kind::Incomplete,
      "The DICOM file " + InQuotes(file.Name) +
        " cannot be read: " + (file.Unreadable.empty() ? file.Data.Damage : file.Unreadable) +
        ". It may be a slice of the series. Download or copy it again, check its permissions, or "
        "remove it.");
  }
}

[[noreturn]] void RefuseFolder(const DicomFolder& folder)
{
  for (const DicomLeftOut& left : folder.LeftOut)
  {
    const DicomFile& file = folder.Files[left.File];
    if (left.Why == Reason::Damaged && (file.Data.IsDicom || ExtensionOf(file.Name) == ".dcm"))
    {
      throw FileProblem(FileProblem::Kind::Incomplete,
        "The DICOM file " + InQuotes(file.Name) +
          " cannot be read: " + (file.Unreadable.empty() ? file.Data.Damage : file.Unreadable) +
          ". It is truncated or damaged. Download or copy its series again.");
    }
  }
  throw FileProblem(FileProblem::Kind::Missing,
    "The folder " + InQuotes(folder.Name) +
      " holds no DICOM image. Give the folder that directly " +
      "holds the files of the series; of a volume in another format, the file itself.");
}

/// The greatest volume, if it is much greater than the others.
const DicomVolume& TheOneOf(const std::vector<const DicomVolume*>& volumes)
{
  const auto order = [](const DicomVolume* a, const DicomVolume* b)
  { return a->Frames.size() < b->Frames.size(); };
  const DicomVolume* const greatest = *std::max_element(volumes.begin(), volumes.end(), order);
  for (const DicomVolume* const other : volumes)
  {
    if (other != greatest && other->Frames.size() * FewBesideMany > greatest->Frames.size())
    {
      throw FileProblem(FileProblem::Kind::Missing,
        "Series " + greatest->SeriesUID + " holds " + std::to_string(volumes.size()) +
          " volumes: " + VolumesText(volumes) +
          ". Choose one of them as the series, for instance " + volumes.front()->Identifier() +
          ".");
    }
  }
  return *greatest;
}

const DicomVolume& NamedVolume(const DicomFolder& folder, std::string_view wanted)
{
  const std::string uid(
    wanted.empty() ? folder.Volumes.front().SeriesUID : wanted.substr(0, wanted.find('#')));
  const std::vector<const DicomVolume*> volumes = VolumesOf(folder, uid);
  if (!volumes.empty() && wanted.find('#') == std::string_view::npos)
  {
    return TheOneOf(volumes);
  }
  for (const DicomVolume* const volume : volumes)
  {
    if (!uid.empty() && wanted == uid + "#" + std::to_string(volume->Number))
    {
      return *volume;
    }
  }
  std::vector<const DicomVolume*> all;
  for (const DicomVolume& volume : folder.Volumes)
  {
    all.push_back(&volume);
  }
  throw FileProblem(FileProblem::Kind::Missing,
    "The " + PlaceOf(folder) + " holds no series " + InQuotes(std::string(wanted)) + ". It holds " +
      VolumesText(all) + ".");
}

} // namespace

void RequireDicomVolumes(const DicomFolder& folder)
{
  if (folder.Volumes.empty())
  {
    RefuseFolder(folder);
  }
}

const DicomVolume& ChooseDicomVolume(const DicomFolder& folder, std::string_view wanted)
{
  RequireDicomVolumes(folder);
  const DicomVolume& volume = NamedVolume(folder, wanted);
  RequireNothingLost(folder, volume);
  if (!volume.Problem.empty())
  {
    throw FileProblem(FileProblem::Kind::Unusable, volume.Problem);
  }
  return volume;
}

std::string WarningOfLeftOut(const DicomFolder& folder, const DicomVolume& volume)
{
  static const std::map<Reason, std::string> reasons{
    { Reason::Damaged, "damaged, unreadable or empty, not of this series" },
    { Reason::NoDicom, "not DICOM" }, { Reason::NoPixels, "without gray values of an image" },
    { Reason::NoGrayValues, "in colors" }, { Reason::NoPlace, "without a place in the patient" },
    { Reason::OtherGrid, "a scout or of another size or orientation" },
    { Reason::TheSame, "the same slice again" }
  };
  std::map<Reason, std::set<std::size_t>> files;
  std::map<std::size_t, std::string> differences;
  std::set<std::size_t> all;
  const auto count = [&](Reason why, std::size_t file)
  {
    if (all.insert(file).second)
    {
      files[why].insert(file);
    }
  };
  for (const DicomLeftOut& left : folder.LeftOut)
  {
    const bool isOfAny =
      left.Why == Reason::Damaged || left.Why == Reason::NoDicom || left.Why == Reason::NoPixels;
    if (isOfAny || left.SeriesUID == volume.SeriesUID)
    {
      count(left.Why, left.File);
      differences.emplace(left.File, left.Difference);
    }
  }
  std::size_t others = 0;
  std::string identifiers;
  for (const DicomVolume& other : folder.Volumes)
  {
    if (other.SeriesUID == volume.SeriesUID && other.Number != volume.Number)
    {
      others += other.Frames.size();
      const std::string difference = volume.Frames.empty() || other.Frames.empty()
        ? std::string()
        : GridDifference(other.Frames.front(), volume.Frames.front());
      identifiers += (identifiers.empty() ? "" : ", ") + other.Identifier() +
        (difference.empty() ? "" : " (" + difference + ")");
    }
  }
  std::string text;
  for (const auto& reason : files)
  {
    const std::size_t first = *reason.second.begin();
    const std::string& difference = differences[first];
    text += (text.empty() ? "" : "; ") + std::to_string(reason.second.size()) + " " +
      reasons.at(reason.first) + " (" + InQuotes(FileNameOf(folder.Files[first].Name)) +
      (difference.empty() ? "" : " has " + difference) + (reason.second.size() > 1 ? ", ..." : "") +
      ")";
  }
  if (!text.empty())
  {
    text = std::to_string(all.size()) + (all.size() == 1 ? " file is" : " files are") +
      " left out: " + text + ".";
  }
  if (others > 0)
  {
    text += (text.empty() ? "" : " ") + std::to_string(others) +
      " slices belong to other volumes of the series: " + identifiers + ".";
  }
  return text.empty() ? text : "In the " + PlaceOf(folder) + ", " + text;
}

} // namespace FlipFree
