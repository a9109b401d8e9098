// Folders of DICOM files: what they hold, and the voxels of a volume.
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"

#include "Exchange/DicomChoice.h"
#include "Exchange/DicomReading.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <memory>
#include <optional>

namespace FlipFree
{
namespace
{

/// A function of Python from bytes, and what else it takes, to bytes. It is called without Python's
/// lock.
template <typename... Arguments>
std::function<std::string(const std::string&, Arguments...)> ByPython(const nb::handle& function)
{
  return [function](const std::string& bytes, Arguments... arguments)
  {
    const nb::gil_scoped_acquire locked;
    const auto answer =
      nb::cast<nb::bytes>(function(nb::bytes(bytes.data(), bytes.size()), arguments...));
    return std::string(answer.c_str(), answer.size());
  };
}

/// A folder that has been read.
class ReadFolder
{
public:
  ReadFolder(const std::string& name, nb::callable inflate, nb::callable decode,
    const nb::callable& report)
    : Inflate(std::move(inflate))
    , Decode(std::move(decode))
  {
    const DicomAccess access = this->Access();
    const nb::gil_scoped_release unlocked;
    this->Folder = ReadDicomFolder(name, DicomFilesOf(name), access, MonitorOf(report, 0, 0.5));
  }

  /// By the report, while it was read: it is empty then.
  bool WasStopped() const { return this->Folder.Name.empty(); }

  /// The fields of each Series.
  std::vector<nb::tuple> List() const
  {
    std::vector<nb::tuple> rows;
    for (const DicomVolume& volume : this->Folder.Volumes)
    {
      std::optional<Triple> spacing;
      if (volume.Problem.empty())
      {
        spacing = SpacingOf(volume);
      }
      rows.push_back(nb::make_tuple(volume.Identifier(), volume.SeriesNumber, volume.Description,
        volume.Modality, volume.Frames.size(), spacing, volume.Problem));
    }
    return rows;
  }

  void RequireVolumes() const { RequireDicomVolumes(this->Folder); }

  /// A volume with what is to be said of it.
  nb::dict Read(const std::string& wanted, const nb::callable& report) const
  {
    const DicomVolume& volume = ChooseDicomVolume(this->Folder, wanted);
    const auto& size = volume.Geometry.Dimensions;
    const std::size_t count = volume.Geometry.NumberOfVoxels();
    std::vector<std::uint64_t> voxels((count * SizeOf(volume.Type) + 7) / 8); // of any type
    {
      const DicomAccess access = this->Access();
      const nb::gil_scoped_release unlocked;
      ReadDicomVoxels(this->Folder, volume, access, voxels.data(), MonitorOf(report, 0.5, 1));
    }
    nb::dict answer;
    const std::size_t words = voxels.size();
    answer["words"] = ArrayOf<std::uint64_t>(std::move(voxels), { words });
    answer["type"] = NameOf(volume.Type);
    answer["shape"] = nb::make_tuple(size[2], size[1], size[0]);
    answer["spacing"] = SpacingOf(volume);
    const Eigen::Vector3d& origin = volume.Geometry.Origin;
    answer["origin"] = Triple{ { origin[0], origin[1], origin[2] } };
    Nine direction;
    Eigen::Map<RowMajorMatrix>(direction.data()) = volume.Geometry.Direction;
    answer["direction"] = direction;
    answer["series"] = volume.Identifier();
    answer["warnings"] =
      std::vector<std::string>{ volume.Warning, WarningOfLeftOut(this->Folder, volume) };
    return answer;
  }

private:
  DicomAccess Access() const
  {
    return { OpenDicomFile, ByPython<std::size_t>(this->Inflate), ByPython<>(this->Decode) };
  }

  static Triple SpacingOf(const DicomVolume& volume)
  {
    const Eigen::Vector3d& spacing = volume.Geometry.Spacing;
    return { { spacing[0], spacing[1], spacing[2] } };
  }

  nb::callable Inflate;
  nb::callable Decode;
  DicomFolder Folder;
};

} // namespace

void BindDicom(nb::module_& module)
{
  module.def("dicom_files", &DicomFilesOf, nb::call_guard<nb::gil_scoped_release>());
  nb::class_<ReadFolder>(module, "DicomFolder")
    .def(nb::init<const std::string&, nb::callable, nb::callable, const nb::callable&>())
    .def("was_stopped", &ReadFolder::WasStopped)
    .def("list", &ReadFolder::List)
    .def("require_volumes", &ReadFolder::RequireVolumes)
    .def("read", &ReadFolder::Read);
}

} // namespace FlipFree
