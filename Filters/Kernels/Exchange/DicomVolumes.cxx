#include "Exchange/DicomVolumes.h"

#include "Exchange/DicomCopies.h"
#include "Exchange/DicomGrid.h"
#include "Exchange/FileNames.h"

#include <algorithm>
#include <map>

namespace FlipFree
{
namespace
{

using Frames = std::vector<DicomFrame>;
using Reason = DicomLeftOut::Reason;

const char* const DicomDirectory = "1.2.840.10008.1.3.10";

/// Whether an object of this SOP class has pixels, so that without them it is cut off.
bool IsImageClass(const std::string& uid)
{
  const std::string storage = "1.2.840.10008.5.1.4.1.1.";
  const char* const images[] = { "1", "1.1", "2", "2.1", "2.2", "3.1", "4", "4.1", "4.3", "4.4",
    "6.1", "6.2", "7", "7.1", "7.2", "7.3", "7.4", "12.1", "12.1.1", "12.2", "12.2.1", "13.1.1",
    "13.1.2", "20", "128", "128.1", "130", "481.2" };
  return uid.compare(0, storage.size(), storage) == 0 &&
    std::find(std::begin(images), std::end(images), uid.substr(storage.size())) != std::end(images);
}

/// Everything of one series, file by file.
struct SeriesFiles
{
  std::vector<std::size_t> Gray;
  std::vector<std::size_t> NotGray;
  std::vector<std::size_t> Damaged;
};

/// The greatest first.
std::vector<Frames> GroupsByGrid(const Frames& frames)
{
  std::vector<Frames> groups;
  for (const DicomFrame& frame : frames)
  {
    auto group = std::find_if(groups.begin(), groups.end(),
      [&frame](const Frames& other) { return AreOnOneGrid(other.front(), frame); });
    if (group == groups.end())
    {
      group = groups.insert(group, Frames());
    }
    group->push_back(frame);
  }
  std::stable_sort(groups.begin(), groups.end(),
    [](const Frames& a, const Frames& b) { return a.size() > b.size(); });
  return groups;
}

/// Numbers by their size, other texts by their letters.
struct KeyOrder
{
  bool operator()(const std::string& a, const std::string& b) const
  {
    DicomAttributes numbers;
    numbers.Add(0, a);
    numbers.Add(1, b);
    const std::vector<double> first = numbers.Numbers(0);
    const std::vector<double> second = numbers.Numbers(1);
    if (first.empty() != second.empty())
    {
      return second.empty();
    }
    return first != second ? first < second : a < b;
  }
};

class FolderSearch
{
public:
  FolderSearch(const std::string& name, std::vector<DicomFile> files,
    const DicomFrameBytes& bytesOf)
    : BytesOf(bytesOf)
  {
    this->Folder.Name = name;
    this->Folder.Files = std::move(files);
  }

  DicomFolder Run()
  {
    for (std::size_t file = 0; file < this->Folder.Files.size(); ++file)
    {
      this->Sort(file);
    }
    for (auto& series : this->Series)
    {
      this->LeaveOutHalfCopies(series.second);
      this->AddVolumes(series.first, series.second);
    }
    this->Order();
    return std::move(this->Folder);
  }

private:
  void LeaveOut(Reason why, std::size_t file, const std::string& uid,
    const std::string& difference = {})
  {
    this->Folder.LeftOut.push_back({ why, file, uid, difference });
  }

  const DicomAttributes& AttributesOf(std::size_t file) const
  {
    return this->Folder.Files[file].Data.Attributes;
  }

  /// By what a file is.
  void Sort(std::size_t number)
  {
    DicomFile& file = this->Folder.Files[number];
    DicomDataSet& data = file.Data;
    const std::string uid = data.Attributes.Text(DicomTag::SeriesInstanceUID);
    if (IsDicomDirectory(file.Name))
    {
      return; // damaged or not, it is no slice, and nothing is left out with it
    }
    if (!file.Unreadable.empty())
    {
      this->LeaveOut(Reason::Damaged, number, uid);
      return;
    }
    if (!data.IsDicom)
    {
      if (ExtensionOf(file.Name) == ".dcm")
      {
        this->LeaveOut(Reason::NoDicom, number, uid);
      }
      return;
    }
    // A directory, or what is too damaged to tell more than that it is no image.
    const std::string kind = ClassOf(data);
    if (kind == DicomDirectory ||
      (!data.Damage.empty() && uid.empty() && !kind.empty() && !IsImageClass(kind)))
    {
      this->LeaveOut(Reason::NoPixels, number, uid);
      return;
    }
    if (data.Damage.empty() && data.HasPixels)
    {
      const bool isGray = WhyNotGray(data).empty();
      data.Damage = isGray ? WhyPixelsAreIncomplete(data) : std::string();
      if (data.Damage.empty())
      {
        SeriesFiles& series = this->Series[uid];
        (isGray ? series.Gray : series.NotGray).push_back(number);
        return;
      }
    }
    if (data.Damage.empty() && !data.HasFloatPixels && (kind.empty() || IsImageClass(kind)))
    {
      data.Damage = "it ends before its pixels";
    }
    if (!data.Damage.empty())
    {
      this->LeaveOut(Reason::Damaged, number, uid);
      if (!uid.empty())
      {
        this->Series[uid].Damaged.push_back(number);
      }
      return;
    }
    this->LeaveOut(Reason::NoPixels, number, uid);
  }

  std::string NameOf(const DicomFrame& frame) const
  {
    const DicomFile& file = this->Folder.Files[frame.File];
    return (NumberOfDicomFrames(file.Data) > 1
               ? "frame " + std::to_string(frame.Number + 1) + " of "
               : "") +
      InQuotes(FileNameOf(file.Name));
  }

  /// What broken downloads leave of slices that are there as a whole. An instance that several
  /// whole files claim tells nothing.
  void LeaveOutHalfCopies(SeriesFiles& files)
  {
    if (files.Damaged.empty())
    {
      return;
    }
    const auto instanceOf = [this](std::size_t file)
    { return this->AttributesOf(file).Text(DicomTag::SOPInstanceUID); };
    std::map<std::string, int> whole;
    for (const std::size_t file : files.Gray)
    {
      ++whole[instanceOf(file)];
    }
    const auto isCopy = [&](std::size_t file)
    {
      const auto found = whole.find(instanceOf(file));
      return found != whole.end() && !found->first.empty() && found->second == 1;
    };
    for (DicomLeftOut& left : this->Folder.LeftOut)
    {
      const auto at = std::find(files.Damaged.begin(), files.Damaged.end(), left.File);
      if (at != files.Damaged.end() && isCopy(left.File))
      {
        left.Why = Reason::TheSame;
        files.Damaged.erase(at);
      }
    }
  }

  /// An empty volume with the names of its series.
  DicomVolume NewVolume(const std::string& uid, std::size_t file) const
  {
    DicomVolume volume;
    volume.SeriesUID = uid;
    const DicomAttributes& known = this->AttributesOf(file);
    volume.SeriesNumber = DicomTextForPeople(known, DicomTag::SeriesNumber);
    volume.Description = DicomTextForPeople(known, DicomTag::SeriesDescription);
    volume.Modality = DicomTextForPeople(known, DicomTag::Modality);
    return volume;
  }

  void AddVolumes(const std::string& uid, const SeriesFiles& files)
  {
    if (files.Gray.empty() && files.NotGray.empty())
    {
      return; // damaged ones alone have been counted
    }
    std::vector<DicomVolume> volumes;
    if (files.Gray.empty())
    {
      DicomVolume volume = this->NewVolume(uid, files.NotGray.front());
      volume.Problem = this->ProblemOf(volume, files.NotGray.front(),
        WhyNotGray(this->Folder.Files[files.NotGray.front()].Data) +
          ". Choose another series, or convert it to gray values.");
      volumes.push_back(volume);
    }
    else
    {
      for (const std::size_t file : files.NotGray)
      {
        this->LeaveOut(Reason::NoGrayValues, file, uid);
      }
      std::vector<Frames> parts = this->PartsOf(uid, files.Gray);
      std::vector<std::string> strangers;
      strangers.reserve(parts.size());
      for (const Frames& frames : parts)
      {
        strangers.push_back(this->StrangerTo(frames, parts, uid));
      }
      for (std::size_t part = 0; part < parts.size(); ++part)
      {
        volumes.push_back(this->NewVolume(uid, parts[part].front().File));
        volumes.back().Frames = std::move(parts[part]);
        this->Finish(volumes.back(), strangers[part]);
      }
    }
    for (std::size_t index = 0; index < volumes.size(); ++index)
    {
      volumes[index].Number = index + 1;
      volumes[index].Count = volumes.size();
      volumes[index].DamagedFiles = files.Damaged.size();
      if (!files.Damaged.empty())
      {
        volumes[index].Problem = this->DamageOf(files.Damaged.front(), uid);
      }
      this->Folder.Volumes.push_back(std::move(volumes[index]));
    }
  }

  /// The frames of each volume of a series.
  std::vector<Frames> PartsOf(const std::string& uid, const std::vector<std::size_t>& files)
  {
    Frames placed;
    Frames unplaced;
    for (const std::size_t file : files)
    {
      for (const DicomFrame& frame : DicomFramesOf(this->Folder.Files[file].Data, file))
      {
        (frame.Problem.empty() ? placed : unplaced).push_back(frame);
      }
    }
    if (placed.empty())
    {
      return { unplaced };
    }
    std::vector<Frames> groups = GroupsByGrid(placed);
    const std::size_t greatest = groups.front().size();
    const DicomPixelFormat typical = groups.front().front().Format;
    for (const DicomFrame& frame : unplaced)
    {
      const bool isLikeOthers = frame.Format.Columns == typical.Columns &&
        frame.Format.Rows == typical.Rows && !frame.IsLocalizer;
      if (isLikeOthers)
      {
        groups.front().push_back(frame); // whose problem is that of the volume
      }
      else
      {
        this->LeaveOut(Reason::NoPlace, frame.File, uid);
      }
    }
    std::vector<Frames> parts;
    for (Frames& group : groups)
    {
      const bool isScout = group.size() == 1 || group.front().IsLocalizer;
      if (isScout && group.size() < greatest)
      {
        for (const DicomFrame& frame : group)
        {
          this->LeaveOut(Reason::OtherGrid, frame.File, uid,
            frame.IsLocalizer ? "" : GridDifference(frame, groups.front().front()));
        }
        continue;
      }
      const bool isSound = std::all_of(group.begin(), group.end(),
        [](const DicomFrame& frame) { return frame.Problem.empty(); });
      if (isSound)
      {
        SortAlongNormal(group);
        this->RemoveCopies(group, uid);
        for (Frames& part : this->Divided(group))
        {
          parts.push_back(std::move(part));
        }
      }
      else
      {
        parts.push_back(std::move(group));
      }
    }
    return parts;
  }

  /// What may be a missing slice of a part, but for its grid; empty where nothing is.
  std::string StrangerTo(const Frames& part, const std::vector<Frames>& parts,
    const std::string& uid) const
  {
    const auto describe = [this](const std::string& name, const std::string& difference)
    { return " A missing slice may be " + name + ", which has " + difference + "."; };
    for (const DicomLeftOut& left : this->Folder.LeftOut)
    {
      if (left.SeriesUID == uid && !left.Difference.empty())
      {
        return describe(InQuotes(FileNameOf(this->Folder.Files[left.File].Name)), left.Difference);
      }
    }
    for (const Frames& other : parts)
    {
      const std::string difference = GridDifference(other.front(), part.front());
      const bool areFew = other.size() < part.size() && !other.front().IsLocalizer;
      if (areFew && other.front().Problem.empty() && !difference.empty())
      {
        return describe(this->NameOf(other.front()), difference);
      }
    }
    return {};
  }

  void RemoveCopies(Frames& frames, const std::string& uid)
  {
    const auto bytesOf = [this](const DicomFrame& frame)
    { return this->BytesOf(this->Folder.Files[frame.File], frame.Number); };
    for (const std::size_t file : RemoveDicomCopies(frames, bytesOf))
    {
      this->LeaveOut(Reason::TheSame, file, uid);
    }
  }

  bool IsEvenStack(const Frames& frames) const
  {
    return frames.size() > 1 &&
      StackOf(frames, [](const DicomFrame&) { return std::string(); }).Problem.empty();
  }

  /// Ordered frames of one grid, taken apart into volumes as far as possible.
  std::vector<Frames> Divided(const Frames& frames) const
  {
    if (this->IsEvenStack(frames))
    {
      return { frames };
    }
    const std::size_t repetition = GreatestRepetition(frames);
    const std::size_t keys = frames.front().Keys.size();
    for (std::size_t key = 0; key <= keys; ++key)
    {
      std::map<std::string, Frames, KeyOrder> byKey;
      for (const DicomFrame& frame : frames)
      {
        // The file tells apart what nothing else does.
        byKey[key < keys ? frame.Keys[key] : std::to_string(frame.File)].push_back(frame);
      }
      std::vector<Frames> parts;
      bool helps = byKey.size() > 1 && byKey.size() <= std::max<std::size_t>(2, frames.size() / 2);
      for (auto& part : byKey)
      {
        helps = helps &&
          (repetition > 1 ? GreatestRepetition(part.second) < repetition
                          : this->IsEvenStack(part.second));
      }
      // A value for each slice, such as a time, tells no volumes apart.
      helps = helps && (repetition == 1 || byKey.size() <= repetition);
      if (!helps)
      {
        continue;
      }
      for (auto& part : byKey)
      {
        for (Frames& divided : this->Divided(part.second))
        {
          parts.push_back(std::move(divided));
        }
      }
      return parts;
    }
    return { frames };
  }

  /// `stranger` may be what is missing.
  void Finish(DicomVolume& volume, const std::string& stranger) const
  {
    const Frames& frames = volume.Frames;
    const auto wrong = std::find_if(frames.begin(), frames.end(),
      [](const DicomFrame& frame) { return !frame.Problem.empty(); });
    if (wrong != frames.end())
    {
      volume.Problem = this->ProblemOf(volume, wrong->File, wrong->Problem + ".");
      return;
    }
    const DicomStack stack =
      StackOf(frames, [this](const DicomFrame& frame) { return this->NameOf(frame); });
    volume.Geometry = stack.Geometry;
    const std::string beginning = "Series " + volume.SeriesUID + ": ";
    volume.Problem =
      stack.Problem.empty() ? "" : beginning + stack.Problem + (stack.HasGap ? stranger : "");
    volume.Warning = stack.Warning.empty() ? "" : beginning + stack.Warning;
    DicomValueRange values;
    for (const DicomFrame& frame : frames)
    {
      values.Add(frame.Format, frame.Rescale);
      if (frame.HasRescale != frames.front().HasRescale && volume.Problem.empty())
      {
        const DicomFrame& without = frame.HasRescale ? frames.front() : frame;
        volume.Problem = beginning + this->NameOf(without) +
          " has no RescaleSlope and RescaleIntercept, but other slices have, so its gray values "
          "are "
          "unknown. Export the series again.";
      }
    }
    volume.Type = values.Type();
    if (volume.Modality == "CT" && !frames.front().HasRescale && volume.Warning.empty())
    {
      volume.Warning = beginning +
        "it has no RescaleSlope and RescaleIntercept; its gray values are taken as they are "
        "stored, "
        "which may not be Hounsfield units.";
    }
    const auto assumed = std::find_if(frames.begin(), frames.end(),
      [](const DicomFrame& frame) { return !frame.Assumption.empty(); });
    if (assumed != frames.end())
    {
      volume.Warning += (volume.Warning.empty() ? beginning : " ") + this->NameOf(*assumed) + " " +
        assumed->Assumption + ".";
    }
  }

  std::string ProblemOf(const DicomVolume& volume, std::size_t file, const std::string& what) const
  {
    return "Series " + volume.SeriesUID + ": " + InQuotes(this->Folder.Files[file].Name) + " " +
      what;
  }

  std::string DamageOf(std::size_t file, const std::string& uid) const
  {
    const DicomFile& damaged = this->Folder.Files[file];
    return "The DICOM file " + InQuotes(damaged.Name) + " of series " + uid +
      " cannot be read: " + damaged.Data.Damage +
      ". It is truncated or damaged. Download or copy its series again.";
  }

  /// The series with the greatest volume first; its volumes stay in their order. What is no picture
  /// of the body, or from nowhere in it, comes last.
  void Order()
  {
    std::map<std::string, std::size_t> sizes;
    for (const DicomVolume& volume : this->Folder.Volumes)
    {
      const bool isPicture =
        !volume.Frames.empty() && volume.Frames.front().HasPosition && volume.Modality != "RTDOSE";
      std::size_t& size = sizes[volume.SeriesUID];
      size = std::max(size, isPicture ? volume.Frames.size() + volume.DamagedFiles : 0);
    }
    std::stable_sort(this->Folder.Volumes.begin(), this->Folder.Volumes.end(),
      [&sizes](const DicomVolume& a, const DicomVolume& b)
      { return sizes[a.SeriesUID] > sizes[b.SeriesUID]; });
  }

  const DicomFrameBytes& BytesOf;
  DicomFolder Folder;
  std::map<std::string, SeriesFiles> Series;
};

} // namespace

std::string DicomVolume::Identifier() const
{
  return this->SeriesUID + (this->Count > 1 ? "#" + std::to_string(this->Number) : "");
}

DicomFolder FindDicomVolumes(const std::string& name, std::vector<DicomFile> files,
  const DicomFrameBytes& bytesOf)
{
  return FolderSearch(name, std::move(files), bytesOf).Run();
}

} // namespace FlipFree
