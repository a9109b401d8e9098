// The command line, which is that of the toolkit's command: options, checks, sessions, files of
// points, and what is printed.
#include "Bindings.h"

#include "AtomicFile.h"
#include "CommandLine.h"
#include "Failure.h"
#include "FileFormats.h"
#include "SegmentPlan.h"
#include "Summary.h"
#include "Warning.h"

#include "Vessel/VesselParameters.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/variant.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

namespace nb = nanobind;
using namespace Command;
using Place = std::array<double, 3>;

// As Python has constraints: kind, place, radius.
using PointRow = std::tuple<int, Place, double>;

std::vector<PointRow> RowsOf(const std::vector<CorrectionPoint>& points)
{
  std::vector<PointRow> rows;
  for (const CorrectionPoint& point : points)
  {
    rows.emplace_back(static_cast<int>(point.Kind), point.Place, point.Radius);
  }
  return rows;
}

std::string TextOfRows(const std::string& name, const std::vector<PointRow>& rows)
{
  std::vector<CorrectionPoint> points;
  for (const auto& [kind, place, radius] : rows)
  {
    points.push_back({ static_cast<ConstraintKind>(kind), place, radius });
  }
  return TextOfPoints(name, points);
}

/// MaximumIterations as maximum_iterations.
std::string KeywordOf(const std::string& property)
{
  std::string keyword = OptionsOf(property).back().substr(2);
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

template <typename Settings>
nb::object ValueOf(const Parameter<Settings>& parameter, const std::vector<double>& numbers)
{
  if (numbers.size() > 1)
  {
    return nb::tuple(nb::cast(numbers));
  }
  switch (parameter.Type)
  {
    case ParameterType::Boolean:
      return nb::bool_(numbers.front() != 0);
    case ParameterType::Integer:
      return nb::int_(static_cast<int>(numbers.front()));
    default:
      return nb::float_(numbers.front());
  }
}

template <typename Settings>
nb::dict KeywordsOf(const GivenParameters<Settings>& given)
{
  nb::dict keywords;
  for (const auto& [parameter, numbers] : given.Values())
  {
    keywords[KeywordOf(parameter->Name).c_str()] = ValueOf(*parameter, numbers);
  }
  return keywords;
}

/// Of an organ, or of a vessel of a session.
nb::dict KeywordsOf(const SegmentRequest& request)
{
  if (!request.IsVessel())
  {
    return KeywordsOf(request.Parameters.GetGiven());
  }
  nb::dict keywords;
  for (const auto& [property, numbers] : request.Repeated.Parameters)
  {
    keywords[KeywordOf(property).c_str()] =
      ValueOf(*FindParameter(VesselParameters(), property), numbers);
  }
  return keywords;
}

/// Those that are wanted, by their options.
template <typename Request>
std::map<std::string, std::string> FilesOf(const Request& request)
{
  std::map<std::string, std::string> files;
  for (const RequestedFile& file : OutputsOf(request))
  {
    files.emplace(file.Option, file.Name);
  }
  files.emplace("--save-points", request.Corrections.Output());
  for (auto file = files.begin(); file != files.end();)
  {
    file = file->second.empty() ? files.erase(file) : std::next(file);
  }
  return files;
}

/// Throws unless the file can be written there.
Announce Announcing(OutputNames& names)
{
  return [&names](const std::string& option, const std::string& name,
           const std::vector<std::string>& inputs)
  {
    names.Add(option, name, inputs);
    const AtomicFile probe(name);
  };
}

void RequirePlace(const std::string& option, const std::string& name,
  const std::vector<std::string>& inputs)
{
  OutputNames names;
  Announcing(names)(option, name, inputs);
}

void RequireTable(const std::string& name, const std::vector<std::string>& inputs)
{
  if (!name.empty())
  {
    RequireEnding("--csv", name, { ".csv" });
    RequirePlace("--csv", name, inputs);
  }
}

SegmentPlan Checked(const SegmentRequest& request)
{
  SegmentPlan plan = PlanOf(request);
  OutputNames names;
  AnnounceOutputs(plan, Announcing(names));
  for (const SegmentRequest& organ : plan.Organs)
  {
    organ.IsVessel() ? static_cast<void>(VesselSettingsOf(organ))
                     : static_cast<void>(organ.Parameters.Settings());
  }
  static_cast<void>(plan.Given.Parameters.Settings());
  RequireVolume(plan.Given.Input, plan.Given.SeriesUID);
  return plan;
}

void Check(const TraceRequest& request)
{
  ValidateRequest(request);
  OutputNames names;
  AnnounceOutputs(request, Announcing(names));
  static_cast<void>(request.Settings());
  RequireVolume(request.Input, request.SeriesUID);
}

void Check(const SurfacesRequest& request)
{
  LabelSurfaceSettings settings;
  request.Parameters.Apply(settings);
}

void Check(const EvaluateRequest& request)
{
  RequireTable(request.Csv, { request.Segmentation, request.Reference });
}

void Check(const SeriesRequest& request)
{
  RequireTable(request.Csv, {});
}

void Check(const PhantomRequest& request)
{
  static_cast<void>(SettingsOf(request));
}

void Check(const CohortRequest& request)
{
  OutputNames names;
  names.Add("--output", request.Folder + "/cohort.csv", { request.Table });
}

/// What is to be printed, or else the subcommand's name and what it is asked for, as far as it
/// can be checked without reading images.
nb::tuple Parse(const std::vector<std::string>& words, const std::string& version)
{
  std::string name;
  nb::object wanted = nb::none();
  const auto take = [&](const char* subcommand)
  {
    return [&, subcommand](const auto& request)
    {
      Check(request);
      name = subcommand;
      wanted = nb::cast(request);
    };
  };
  const auto plan = [&](const SegmentRequest& request)
  {
    wanted = nb::cast(Checked(request));
    name = "segment";
  };
  CommandLine line({ plan, take("trace"), take("surfaces"), take("evaluate"), take("series"),
                     take("phantom"), take("cohort") },
    version);
  std::vector<const char*> given{ "flipfree" };
  for (const std::string& word : words)
  {
    given.push_back(word.c_str());
  }
  const std::string text = line.Run(static_cast<int>(given.size()), given.data());
  return nb::make_tuple(text, name, wanted);
}

/// The option of each keyword.
std::map<std::string, std::string> SpellingOf(const std::string& command)
{
  std::map<std::string, std::string> spelling;
  for (const OptionEntry& entry : EntryOf(command).Options)
  {
    std::string keyword = entry.Names.back().substr(2);
    if (keyword.rfind("no-", 0) == 0)
    {
      keyword = keyword.substr(3);
    }
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    spelling[keyword] = *std::find_if(entry.Names.begin(), entry.Names.end(),
      [](const std::string& name) { return name.rfind("--", 0) == 0; });
  }
  return spelling;
}

// Name, center, radius, points, color and files of each organ of a group.
nb::list GroupOf(const SegmentPlan& plan)
{
  nb::list organs;
  for (const GivenOrgan& organ : plan.Group)
  {
    std::map<std::string, std::string> files = FilesOf(WithFilesOf(organ.FileName(), plan.Given));
    files.erase("--labels");
    files.erase("--save-session");
    organs.append(nb::make_tuple(organ.Name, organ.Seed, organ.Radius, RowsOf(organ.Points),
      organ.Color, files));
  }
  return organs;
}

void RequireImage(const SegmentPlan& plan, const std::array<int, 3>& size, const Place& spacing,
  const Place& origin, const std::array<double, 9>& direction)
{
  if (plan.From)
  {
    ImageGeometry geometry;
    geometry.Dimensions = size;
    geometry.Spacing = Eigen::Vector3d(spacing.data());
    geometry.Origin = Eigen::Vector3d(origin.data());
    geometry.Direction = Eigen::Map<const RowMajorMatrix>(direction.data());
    RequireImageOf(*plan.From, plan.Given.Input, geometry);
  }
}

void BindSegmentRequests(nb::module_& module)
{
  nb::class_<OriginNames>(module, "OriginNames")
    .def(nb::init<>())
    .def_rw("image", &OriginNames::Image)
    .def_rw("series", &OriginNames::Series)
    .def_rw("fixed", &OriginNames::Fixed)
    .def_rw("organs", &OriginNames::Organs)
    .def_rw("colors", &OriginNames::Colors);
  nb::class_<SegmentRequest>(module, "SegmentRequest")
    .def_ro("input", &SegmentRequest::Input)
    .def_rw("series", &SegmentRequest::SeriesUID)
    .def_ro("start_labels", &SegmentRequest::StartLabels)
    .def_ro("start_label", &SegmentRequest::StartLabel)
    .def_ro("label_value", &SegmentRequest::Label)
    .def_ro("threads", &SegmentRequest::Threads)
    .def_ro("quiet", &SegmentRequest::Quiet)
    .def_ro("asks", &SegmentRequest::Asks)
    .def_prop_ro("is_ras",
      [](const SegmentRequest& request) { return request.Corrections.AreRas(); })
    .def_prop_ro("preset",
      [](const SegmentRequest& request) { return request.Parameters.GetPreset(); })
    .def_prop_ro("parameters", [](const SegmentRequest& request) { return KeywordsOf(request); })
    .def_prop_ro("vessel_points",
      [](const SegmentRequest& request) { return request.Repeated.Points; })
    .def_prop_ro("points", [](const SegmentRequest& request) { return RowsOf(request.Points()); })
    .def_prop_ro("files", &FilesOf<SegmentRequest>)
    .def_prop_ro("names", nb::overload_cast<const SegmentRequest&>(&NamesOf))
    .def("seeds",
      [](const SegmentRequest& request, const std::array<int, 3>& size,
        const std::function<Place(const std::array<int, 3>&)>& placeOf)
      { return RowsOf(request.Seeds(size, placeOf)); })
    .def("title",
      [](const SegmentRequest& request, const std::string& quote)
      { return TitleOf(request, quote.c_str()); });
  nb::class_<SegmentPlan>(module, "SegmentPlan")
    .def_ro("given", &SegmentPlan::Given)
    .def_ro("organs", &SegmentPlan::Organs)
    .def_prop_ro("group", &GroupOf)
    .def_ro("fixed", &SegmentPlan::Fixed)
    .def("require_image", &RequireImage);
}

void BindOtherRequests(nb::module_& module)
{
  nb::class_<TraceRequest>(module, "TraceRequest")
    .def_ro("input", &TraceRequest::Input)
    .def_rw("series", &TraceRequest::SeriesUID)
    .def_ro("threads", &TraceRequest::Threads)
    .def_ro("quiet", &TraceRequest::Quiet)
    .def_prop_ro("is_ras", [](const TraceRequest& request) { return request.Corrections.AreRas(); })
    .def_prop_ro("places", &TraceRequest::Places)
    .def_prop_ro("points",
      [](const TraceRequest& request)
      {
        const std::vector<CorrectionPoint> points = request.Corrections.Points();
        RequireNoSeeds(points);
        return RowsOf(points);
      })
    .def_prop_ro("parameters",
      [](const TraceRequest& request) { return KeywordsOf(request.Parameters); })
    .def_prop_ro("files", &FilesOf<TraceRequest>)
    .def_prop_ro("names", nb::overload_cast<const TraceRequest&>(&NamesOf));
  nb::class_<SurfacesRequest>(module, "SurfacesRequest")
    .def_ro("labels", &SurfacesRequest::LabelMap)
    .def_ro("folder", &SurfacesRequest::Folder)
    .def_ro("format", &SurfacesRequest::Format)
    .def_ro("names", &SurfacesRequest::Names)
    .def_ro("only", &SurfacesRequest::Labels)
    .def_prop_ro("parameters",
      [](const SurfacesRequest& request) { return KeywordsOf(request.Parameters); })
    .def_ro("threads", &SurfacesRequest::Threads)
    .def_ro("quiet", &SurfacesRequest::Quiet);
  nb::class_<EvaluateRequest>(module, "EvaluateRequest")
    .def_ro("segmentation", &EvaluateRequest::Segmentation)
    .def_ro("reference", &EvaluateRequest::Reference)
    .def_prop_ro("segmentation_label", &EvaluateRequest::LabelOfSegmentation)
    .def_prop_ro("reference_label", &EvaluateRequest::LabelOfReference)
    .def_ro("csv", &EvaluateRequest::Csv)
    .def_ro("voxelize", &EvaluateRequest::Voxelize)
    .def_ro("quiet", &EvaluateRequest::Quiet);
  nb::class_<SeriesRequest>(module, "SeriesRequest")
    .def_ro("folder", &SeriesRequest::Folder)
    .def_ro("csv", &SeriesRequest::Csv)
    .def_ro("quiet", &SeriesRequest::Quiet);
  nb::class_<PhantomRequest>(module, "PhantomRequest")
    .def_ro("name", &PhantomRequest::Name)
    .def_ro("folder", &PhantomRequest::Folder)
    .def_ro("size", &PhantomRequest::Dimensions)
    .def_ro("spacing", &PhantomRequest::Spacing)
    .def_ro("noise", &PhantomRequest::Noise)
    .def_ro("random_seed", &PhantomRequest::RandomSeed)
    .def_ro("lesions", &PhantomRequest::Lesions)
    .def_ro("quiet", &PhantomRequest::Quiet);
  nb::class_<CohortRequest>(module, "CohortRequest")
    .def_ro("table", &CohortRequest::Table)
    .def_ro("folder", &CohortRequest::Folder)
    .def_ro("scheduler", &CohortRequest::Scheduler)
    .def_ro("workers", &CohortRequest::Workers)
    .def_ro("threads", &CohortRequest::Threads)
    .def_ro("quiet", &CohortRequest::Quiet);
}

void BindSummaries(nb::module_& module)
{
  nb::class_<OrganSummary>(module, "OrganSummary")
    .def("__init__",
      [](OrganSummary* summary, const std::string& title, double milliliters, int iterations,
        const std::string& stopReason, int selfIntersections) {
        new (summary) OrganSummary{ title, milliliters, iterations, stopReason, selfIntersections };
      });
  module.def("organ_text", &OrganText);
  module.def("vessel_text", &VesselText);
  module.def("group_text", &GroupText);
  module.def("group_end_text", &GroupEndText);
  module.def("trace_text",
    [](const std::string& title, int branches, int vertices, const std::string& stopReason,
      int selfIntersections, double support, const StageSeconds& seconds)
    {
      return TraceText({ title, branches, vertices, stopReason, selfIntersections, support },
        seconds);
    });
  module.def("surfaces_text",
    [](const std::vector<std::tuple<int, std::string, double, int, int, long long>>& rows,
      long long wrongVoxels, double greatestDistance,
      const std::optional<std::pair<long long, double>>& collapse)
    {
      SurfacesSummary surfaces{ {}, wrongVoxels, greatestDistance, {} };
      for (const auto& [label, name, milliliters, euler, triangles, wrong] : rows)
      {
        surfaces.Labels.push_back({ label, name, milliliters, euler, triangles, wrong });
      }
      if (collapse)
      {
        surfaces.Collapse = { collapse->first, collapse->second };
      }
      return SurfacesText(surfaces);
    });
  module.def("series_text",
    [](
      const std::vector<std::tuple<std::string, std::string, std::string, int, Place, std::string>>&
        rows)
    {
      std::vector<SeriesSummary> list;
      for (const auto& [number, uid, modality, slices, spacing, description] : rows)
      {
        list.push_back({ number, uid, modality, slices, spacing, description });
      }
      return SeriesText(list);
    });
  module.def("phantom_text", &PhantomText);
  module.def("nothing_to_ask_text", &NothingToAskText);
  module.def("input_title", &InputTitle);
  module.attr("NOT_CERTIFIED") = NotCertifiedText;
}

} // namespace

void BindCommand(nb::module_& module)
{
  static const nb::exception<Failure> failure(module, "Failure");
  static const nb::exception<WrongUsage> wrongUsage(module, "WrongUsage");
  static const nb::exception<FileError> notWritten(module, "NotWritten");
  nb::class_<AtomicFile>(module, "AtomicFile")
    .def(nb::init<const std::string&>())
    .def_prop_ro("temporary_name", &AtomicFile::TemporaryName)
    .def("flush", &AtomicFile::Flush)
    .def("publish", &AtomicFile::Publish)
    .def("discard", &AtomicFile::Discard);
  SendWarningsTo([](const std::string& message)
    { nb::module_::import_("flipfree._messages").attr("warn")(message); });
  BindSegmentRequests(module);
  BindOtherRequests(module);
  BindSummaries(module);
  module.def("parse", &Parse);
  module.def("require_place", &RequirePlace);
  module.def("spelling", &SpellingOf);
  module.def("read_points",
    [](const std::string& name, const std::string& whatTakesPlaces)
    { return RowsOf(ReadPoints(name, whatTakesPlaces)); });
  module.def("points_of_controls",
    [](const std::string& name, const std::vector<std::pair<std::string, Place>>& controls)
    { return RowsOf(PointsOfControls(name, controls)); });
  module.def("read_places", &ReadPlaces);
  module.def("points_text", &TextOfRows);
  module.def("named_provenance", &NamedProvenance);
  module.def("session_text", &SessionText);
  module.def("organ_of_file", [](const std::string& file) { return OrganOfFiles({ file }); });
}

} // namespace FlipFree
