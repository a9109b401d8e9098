#include "OptionTable.h"

#include "Deformation/SegmentationParameters.h"
#include "JsonText.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "Phantom/PhantomVolume.h"
#include "QuantityNames.h"
#include "Vessel/VesselParameters.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>

namespace Command
{
namespace
{

const char* const ProgramFooter =
  "Examples:\n"
  "  flipfree phantom abdomen -o try                  # a volume to try, and its seeds\n"
  "  flipfree segment try/abdomen.nii.gz --seed 99.75 83.75 167 --radius 28 -o liver.ply\n"
  "  flipfree evaluate liver.ply try/abdomen-truth.nii.gz --reference-label 6\n"
  "\n"
  "Each subcommand has its own --help, with units, defaults and examples. Coordinates are LPS\n"
  "millimeters: x to the patient's left, y to the back, z to the head. Viewers that use RAS, such\n"
  "as 3D Slicer, show x and y with opposite signs.\n"
  "Exit status: 0 success, 1 failure, 2 wrong usage, 130 interrupted.\n";

const char* const SegmentFooter =
  "Either all output files are written or none. The picture of --snapshot shows the contour on\n"
  "axial, sagittal and coronal slices through the surface's center, and the surface; it needs"
#ifdef FLIPFREE_COMMAND_OF_PIP
  "\n"
  "matplotlib, which the extra plot installs, and no display.\n"
#else
  " a\n"
  "display (or xvfb-run -a).\n"
#endif
  "\n"
  "Examples:\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --seed-voxel 120 140 60 --radius 15 -o spleen.stl \\\n"
  "      --labels spleen.nii.gz --convergence spleen.csv --snapshot spleen.png\n"
  "  flipfree segment dicom/ --series 1.2.840.1 --seed 90 20 -640 --radius 12 -o kidney.vtp\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --preset naive -o flips.ply\n"
  "  flipfree segment ct.nii.gz --start-labels network.nii.gz --start-label 6 -o liver.stl\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --ask -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --session session.json -o organ.stl --labels organs.nii.gz\n"
  "  flipfree segment ct.nii.gz --organ liver 83 -154 321 26 --organ spleen 250 -110 360 14 \\\n"
  "      --outside 240 -80 350 -o organ.vtp --labels organs.nii.gz\n"
  "\n"
  "The seed sphere should lie within the organ and have at least half the radius of the largest\n"
  "sphere that fits there: the organ's intensities are learned from its voxels, and the surface\n"
  "starts from it.\n";

const char* const TraceFooter =
  "Either all output files are written or none. Points lie in the vessel: one at each end, more\n"
  "along it or at the ends of its branches, in any order. Points 5 mm off do little harm.\n"
  "\n"
  "Examples:\n"
  "  flipfree trace ct.nii.gz --point 212 -143 480 --point 171 -168 228 -o aorta.vtp\n"
  "  flipfree trace ct.nii.gz --point 274 -141 318 --point 145 -212 315 --point 105 -113 345 \\\n"
  "      -o portal.stl --labels portal.nii.gz --centerline portal-line.vtp\n"
  "  flipfree trace ct.nii.gz --point 212 -143 480 --point 171 -168 228 --outside 190 -150 350 \\\n"
  "      -o aorta.vtp\n"
  "\n"
  "The poly lines of --centerline have the radius at each point, and the length up to it.\n";

const char* const SurfacesFooter =
  "Writes a surface for each label, LABEL.stl, or LABEL-NAME.stl where labels have names, and\n"
  "the table surfaces.csv: volumes, areas, Euler numbers, triangles, and voxels on the wrong "
  "side.\n"
  "Each surface is closed, a 2-manifold, and does not intersect itself, and where two labels "
  "touch,\n"
  "both have the same triangles there. Names are those of the label map (a segmentation of 3D\n"
  "Slicer, .seg.nrrd, or a NIfTI file with a label table, as TotalSegmentator writes it), or "
  "those\n"
  "of a table: lines such as '5,liver', columns that its first line calls label and name, or\n"
  "the tables of colors of 3D Slicer, FreeSurfer and ITK-SNAP.\n"
  "\n"
  "Examples:\n"
  "  flipfree surfaces labels.nii.gz -o surfaces\n"
  "  flipfree surfaces labels.nii.gz -o surfaces --exact       # voxelized again: the same labels\n"
  "  flipfree surfaces labels.nii.gz -o surfaces --label 5 --label 6 --names names.csv\n";

const char* const EvaluateFooter =
  "The segmentation is a label map (.nii .nii.gz .nrrd .nhdr .mha .mhd) with the reference's\n"
  "voxels, cropped or not, or a closed surface (.vtp .stl .ply .obj) in LPS millimeters. A "
  "surface\n"
  "is voxelized to measure the overlap; distances are measured from the surface itself.\n"
  "\n"
  "Examples:\n"
  "  flipfree evaluate liver.nii.gz truth.nii.gz --reference-label 6\n"
  "  flipfree evaluate liver.ply truth.nii.gz --reference-label 6 --csv scores.csv\n";

const char* const SeriesFooter =
  "Lists each volume: Series Number, UID, Modality, number of slices, distances of voxel centers\n"
  "along the axes, and Series Description. 'flipfree segment' and 'flipfree trace' read the first\n"
  "series, the one with the most slices, or the one whose UID they are given as --series. A "
  "series\n"
  "of several volumes (times, echoes, stacks) has a line for each, UID#1, UID#2, and one of them\n"
  "must be chosen. Objects without pixels, scouts and other files that are no slices are not\n"
  "listed.\n"
  "\n"
  "A volume that cannot be read has '-' in place of its spacing, 0 in the CSV file, and a warning\n"
  "says why; this is no failure. The CSV file has the columns number, uid, description, modality,\n"
  "slices, spacing_x, spacing_y, spacing_z (mm) and problem.\n"
  "\n"
  "Examples:\n"
  "  flipfree series dicom/\n"
  "  flipfree series dicom/ --quiet --csv series.csv\n"
  "  flipfree series enhanced.dcm\n";

const char* const PhantomFooter =
  "Writes the volume NAME.nii.gz and its true label map NAME-truth.nii.gz, and prints a seed for\n"
  "each object, to be pasted after 'flipfree segment'; of the vessel also two points, for "
  "'flipfree\n"
  "trace'.\n"
  "\n"
  "Examples:\n"
  "  flipfree phantom abdomen -o try         # a CT of the upper abdomen, in Hounsfield units\n"
  "  flipfree phantom cup -o try --noise 20  # the cup of the paper, noisier\n"
  "  flipfree phantom sphere -o try --size 64 64 40 --spacing 1 1 2\n";

std::vector<std::string> SplitAt(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    parts.push_back(part);
  }
  return parts;
}

OptionEntry Option(const char* names, const char* values, const std::string& description,
  const std::string& value = "")
{
  return { SplitAt(names, ','), SplitAt(values, ' '), {}, description, value, "Options" };
}

OptionEntry Repeated(OptionEntry option)
{
  option.Repeats = true;
  return option;
}

OptionEntry Required(OptionEntry option)
{
  option.Required = true;
  return option;
}

OptionEntry Among(const std::vector<std::string>& choices, OptionEntry option)
{
  option.Choices = choices;
  return option;
}

OptionEntry InGroup(const std::string& group, OptionEntry option)
{
  option.Group = group;
  return option;
}

/// As the options read them back.
std::string DefaultOf(int value)
{
  return std::to_string(value);
}

std::string DefaultOf(double value)
{
  return FlipFree::JsonOf(value);
}

/// Those of the parameters with a group, or without one; a switch that is on has another to turn it
/// off.
template <typename Settings>
std::vector<OptionEntry> ParameterEntries(const FlipFree::ParameterTable<Settings>& table,
  const std::string& group = "", const std::string& title = "Options")
{
  const FlipFree::QuantityNames names = OptionNames(table);
  std::vector<OptionEntry> options;
  for (const FlipFree::Parameter<Settings>& parameter : table)
  {
    if (parameter.Words.Group != group)
    {
      continue;
    }
    OptionEntry option{ OptionsOf(parameter.Name), SplitAt(parameter.Words.Unit, ' '), {},
      FlipFree::WithNames(parameter.Words.Help, names), "", title };
    const std::vector<double> values = parameter.Get(Settings());
    if (parameter.Type != FlipFree::ParameterType::Boolean)
    {
      for (const double value : values)
      {
        option.Default += (option.Default.empty() ? "" : " ") +
          (parameter.Type == FlipFree::ParameterType::Integer ? DefaultOf(static_cast<int>(value))
                                                              : DefaultOf(value));
      }
    }
    else
    {
      const bool isOn = values.front() != 0;
      option.Values.clear();
      option.Default = isOn ? "on" : "";
      if (isOn)
      {
        option.Names.push_back("--no-" + option.Names.back().substr(2));
      }
    }
    options.push_back(option);
  }
  return options;
}

const char* const SeriesHelp =
  "Series Instance UID, if the folder holds several series; by default, the one with the most "
  "slices; of one with several volumes, UID#1, UID#2 and so on ('flipfree series' lists them)";

OptionEntry HelpFlag()
{
  return Option("-h,--help", "", "Print this help message and exit");
}

OptionEntry QuietFlag()
{
  return Option("-q,--quiet", "", "Print nothing but errors and warnings");
}

OptionEntry ThreadsOption()
{
  return Option("--threads", "N", "Number of threads; 0: all available", "0");
}

OptionEntry OutputOption()
{
  return Option("-o,--output", "FILE", "Surface (.vtp .stl .ply .obj)");
}

OptionEntry LabelsOption(const std::string& names)
{
  return Option("--labels", "FILE",
    "Label map (.nii.gz .nii .nrrd .mha; .seg.nrrd: a segmentation of 3D Slicer, with the " +
      names + ")");
}

OptionEntry ConvergenceOption()
{
  return Option("--convergence", "FILE", "Table of the iterations (.csv)");
}

OptionEntry SnapshotOption()
{
  return Option("--snapshot", "FILE", "Picture of the result (.png)");
}

OptionEntry SaveSessionOption()
{
  return Option("--save-session", "FILE",
    "Where the result comes from (.json): version, image, seeds, points and parameters. "
    "'flipfree segment --session' repeats it");
}

/// Points that correct an organ or a vessel.
std::vector<OptionEntry> CorrectionOptions(const std::string& what)
{
  const char* const points = what == "organ"
    ? "Points and further seeds from a file: a table (.csv: kind, x, y, z, radius) or markups of "
      "3D Slicer (.mrk.json), whose labels are outside, inside, boundary, or seed and its radius"
    : "Such points from a file: a table (.csv: kind, x, y, z, radius) or markups of 3D Slicer "
      "(.mrk.json), whose labels are outside, inside or boundary";
  std::vector<OptionEntry> options{ Repeated(Option("--inside", "X Y Z",
                                      "A point inside the " + what +
                                        " that was missed, in LPS millimeters; can be repeated")),
    Repeated(Option("--outside", "X Y Z",
      "A point outside the " + what + " that was taken for it, likewise")),
    Repeated(Option("--boundary", "X Y Z", "A point on the " + what + "'s boundary, likewise")),
    Repeated(Option("--inside-stroke", "FILE",
      "A stroke of points inside: a table (.csv: x, y, z) or a curve of 3D Slicer (.mrk.json); "
      "can be repeated")),
    Repeated(Option("--outside-stroke", "FILE", "A stroke of points outside, likewise")),
    Option("--points", "FILE", points),
    Option("--save-points", "FILE", "File for all these points (.csv .mrk.json)"),
    Option("--ras", "",
      "Coordinates of the command line are RAS, as 3D Slicer and ITK-SNAP show them, not LPS") };
  for (OptionEntry& option : options)
  {
    option.Group = "Corrections";
  }
  return options;
}

void AddEntries(CommandEntry& command, const std::vector<OptionEntry>& options)
{
  command.Options.insert(command.Options.end(), options.begin(), options.end());
}

CommandEntry ProgramEntry()
{
  CommandEntry command{ "flipfree",
    "Segments soft organs (liver, spleen, kidney) in CT and MR volumes. A sphere inside the "
    "organ grows into the organ's surface, which is closed and does not intersect itself.",
    ProgramFooter, {}, {} };
  AddEntries(command, { HelpFlag(), Option("--version", "", "Print the version and exit") });
  return command;
}

CommandEntry SegmentEntry()
{
  CommandEntry command{ "segment", "Segment an organ, starting from a sphere inside it",
    SegmentFooter,
    { Option("", "INPUT",
      "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), folder of a DICOM series, or DICOM file of "
      "several frames; with --session, by default, the session's image beside it") },
    {} };
  AddEntries(command,
    { HelpFlag(),
      Option("--session", "FILE",
        "Session that the page in the browser or --save-session has saved (.json): image, seeds, "
        "parameters, and corrections of organs, and the points of vessels. Of several organs, each "
        "has its name in the names of its files, as in out-liver.vtp, and a label of its own"),
      Option("--series", "UID", SeriesHelp),
      Repeated(Option("--seed", "X Y Z",
        "Center of the seed sphere, in LPS millimeters; can be repeated for further spheres within "
        "the organ, each with a --radius")),
      Repeated(
        Option("--seed-voxel", "I J K", "The same as the indices of a voxel, which count from 0")),
      Repeated(Option("--radius", "MM",
        "Radius of the seed sphere, in millimeters; can be repeated, in the order of the seeds")),
      Option("--start-labels", "FILE",
        "Label map with the image's voxels, cropped or not (of a network, an atlas, an earlier "
        "result), that the surface fills, in place of a seed; points correct it (.nii .nii.gz "
        ".nrrd .nhdr .mha .mhd)"),
      Option("--start-label", "LABEL",
        "The organ in --start-labels: its value, by default 1, or 0 for all nonzero voxels; or the "
        "name of a segment of 3D Slicer (.seg.nrrd)"),
      OutputOption(), LabelsOption("organs' names and colors"), ConvergenceOption(),
      Option("--questions", "FILE",
        "Table of the parts of which the result is not sure, at most five, those first where an "
        "answer is worth most (.csv): place, volume, whether it is included, and the margin. Yes "
        "is --inside X Y Z, no --outside X Y Z. Of several organs, each has a table with its name, "
        "as in out-liver.csv; vessels of a session have none"),
      Option("--ask", "",
        "Ask these questions at the terminal, and segment again by the answers, which are points "
        "inside and outside; --save-points writes them"),
      SnapshotOption(), SaveSessionOption() });
  const auto& table = FlipFree::SegmentationParameters();
  AddEntries(command, ParameterEntries(table, "Result"));
  AddEntries(command, { ThreadsOption(), QuietFlag() });
  AddEntries(command, CorrectionOptions("organ"));
  AddEntries(command,
    { InGroup("Several organs",
        Repeated(Option("--organ", "NAME X Y Z MM",
          "An organ by its name, the center of its seed sphere in LPS millimeters, and the radius; "
          "can be repeated: organs are segmented together, their surfaces never meet, and the "
          "points after an organ are its own. Each has its name in the names of its files, as in "
          "out-liver.vtp, and a label of its own, from --label-value on"))),
      InGroup("Several organs",
        Repeated(Option("--fixed", "FILE",
          "A closed surface that stays as it is, such as an earlier result, and that no organ "
          "meets; "
          "can be repeated (.vtp .stl .ply .obj)"))) });
  AddEntries(command,
    { InGroup("Parameters",
      Among({ "default", "published", "naive" },
        Option("--preset", "NAME",
          "Values that the parameters start from: 'default', 'published' (the paper's own method: "
          "one level, no leak control, no guard) or 'naive' (also without flip avoidance). With "
          "the last two, the surface may intersect itself. The options below override the preset",
          "default"))) });
  AddEntries(command, ParameterEntries(table, "", "Parameters"));
  for (const std::string group : { "Feature", "Search", "Deformation" })
  {
    AddEntries(command, ParameterEntries(table, group, group + " parameters"));
  }
  AddEntries(command, ParameterEntries(table, "Start", "Start and convergence"));
  return command;
}

CommandEntry TraceEntry()
{
  CommandEntry command{ "trace", "Segment a vessel, or a tree of vessels, between points",
    TraceFooter,
    { Required(Option("", "INPUT",
      "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), folder of a DICOM series, or DICOM file of "
      "several frames")) },
    {} };
  AddEntries(command,
    { HelpFlag(), Option("--series", "UID", SeriesHelp),
      Repeated(Option("--point", "X Y Z",
        "A point in the vessel, in LPS millimeters; two or more are needed")),
      OutputOption(), LabelsOption("vessel's name"),
      Option("--centerline", "FILE", "Poly lines with radii (.vtp)"), ConvergenceOption(),
      SnapshotOption(), SaveSessionOption() });
  AddEntries(command, ParameterEntries(FlipFree::VesselParameters()));
  AddEntries(command, { ThreadsOption(), QuietFlag() });
  AddEntries(command, CorrectionOptions("vessel"));
  return command;
}

CommandEntry SurfacesEntry()
{
  CommandEntry command{ "surfaces", "Make surfaces of the labels of a label map", SurfacesFooter,
    { Required(Option("", "LABELS", "Label map: whole numbers, 0 is background")) }, {} };
  AddEntries(command,
    { HelpFlag(), Required(Option("-o,--output", "DIR", "Folder for the files; created if absent")),
      Among({ "stl", "ply", "obj", "vtp" },
        Option("--format", "FORMAT", "Of the surfaces: stl, ply, obj or vtp", "stl")),
      Repeated(Option("--label", "N",
        "A label that gets a surface, all others being background; repeat it for several. Default: "
        "all")),
      Option("--names", "FILE", "Table of the labels' names: lines such as '5,liver'") });
  AddEntries(command, ParameterEntries(FlipFree::LabelSurfaceParameters()));
  AddEntries(command, { ThreadsOption(), QuietFlag() });
  return command;
}

CommandEntry EvaluateEntry()
{
  CommandEntry command{ "evaluate", "Compare a segmentation with a reference", EvaluateFooter,
    { Required(Option("", "SEGMENTATION", "Label map or surface")),
      Required(Option("", "REFERENCE", "Label map that counts as the truth")) },
    {} };
  AddEntries(command,
    { HelpFlag(),
      Option("--label", "LABEL",
        "Inside in both label maps: a value, or the name of a segment of 3D Slicer (.seg.nrrd); by "
        "default, every nonzero value"),
      Option("--segmentation-label", "LABEL", "The same for the segmentation only"),
      Option("--reference-label", "LABEL", "The same for the reference only"),
      Option("--csv", "FILE", "Also write the measures to this file"),
      Option("--voxelize", "",
        "Measure distances from the surface's voxels, for a fair comparison with label maps"),
      QuietFlag() });
  return command;
}

CommandEntry SeriesEntry()
{
  CommandEntry command{ "series", "List the series in a folder of DICOM files", SeriesFooter,
    { Required(Option("", "FOLDER",
      "Folder that directly holds DICOM files, folder with a DICOMDIR, or DICOM file of several "
      "frames")) },
    {} };
  AddEntries(command,
    { HelpFlag(),
      Option("--csv", "FILE",
        "Also write the list to this file, with the reason where a series cannot be read"),
      QuietFlag() });
  return command;
}

CommandEntry PhantomEntry()
{
  CommandEntry command{ "phantom", "Create a synthetic volume with a known segmentation",
    PhantomFooter,
    { Among({ "sphere", "cube", "cup", "u-tube", "vessel", "abdomen" },
      Required(Option("", "NAME", "sphere, cube, cup, u-tube, vessel or abdomen"))) },
    {} };
  const FlipFree::PhantomSettings defaults;
  AddEntries(command,
    { HelpFlag(), Option("-o,--output", "DIR", "Folder for the two files; created if absent", "."),
      Option("--size", "NX NY NZ", "Number of voxels along each axis", "depends on the phantom"),
      Option("--spacing", "X Y Z", "Voxel spacing along each axis, in mm",
        "depends on the phantom"),
      Option("--noise", "S", "Standard deviation of the noise",
        DefaultOf(defaults.NoiseStandardDeviation)),
      Option("--random-seed", "N", "Seed of the random numbers", DefaultOf(defaults.RandomSeed)),
      Option("--lesions", "N", "Number of lesions in the abdomen's liver, 0 to 20",
        DefaultOf(defaults.NumberOfLesions)),
      QuietFlag() });
  return command;
}

#ifdef FLIPFREE_COMMAND_OF_PIP
const char* const CohortFooter =
  "TABLE is a CSV file with a row per organ or vessel. Its columns: volume (a file or a DICOM\n"
  "folder) and, where the folder holds several, series (as 'flipfree series' lists them); of an "
  "organ\n"
  "seed_x, seed_y, seed_z and radius in LPS millimeters, and if wanted inside, outside and "
  "boundary\n"
  "(points: 1 2 3; 4 5 6) and corrections (a file of points, .csv or .mrk.json); of a vessel "
  "points (a\n"
  "list or a file) in place of these; if wanted, case and organ (names), reference and "
  "reference_label\n"
  "(a label map to compare with), and any parameter of flipfree.segment or flipfree.trace. Files "
  "are\n"
  "found from the table's folder. In DIR there are then cohort.csv, cohort.parquet, report.html "
  "and a\n"
  "folder with files for each row. The same command again does only what is missing or has "
  "changed.\n"
  "\n"
  "Examples:\n"
  "  flipfree cohort livers.csv -o results\n"
  "  flipfree cohort livers.csv -o results --scheduler tcp://10.0.0.5:8786\n";

CommandEntry CohortEntry()
{
  CommandEntry command{ "cohort",
    "Segment the organs and vessels of many volumes, several at a time", CohortFooter,
    { Required(Option("", "TABLE", "Rows to segment (.csv)")) }, {} };
  AddEntries(command,
    { HelpFlag(),
      Required(Option("-o,--output", "DIR", "Folder of the results; created if absent")),
      Option("--scheduler", "ADDRESS",
        "Dask scheduler to use; by default, workers are started here"),
      Option("--workers", "N",
        "Number of workers to start; 0: as many as processors and memory allow", "0"),
      Option("--threads", "N", "Number of threads of each worker", "1"), QuietFlag() });
  return command;
}
#endif

} // namespace

const std::vector<CommandEntry>& OptionTable()
{
  static const std::vector<CommandEntry> table{
    ProgramEntry(),
    SegmentEntry(),
    TraceEntry(),
    SurfacesEntry(),
    EvaluateEntry(),
    SeriesEntry(),
    PhantomEntry(),
#ifdef FLIPFREE_COMMAND_OF_PIP
    CohortEntry(),
#endif
  };
  return table;
}

const CommandEntry& EntryOf(const std::string& command)
{
  for (const CommandEntry& entry : OptionTable())
  {
    if (entry.Name == command)
    {
      return entry;
    }
  }
  throw std::out_of_range(command);
}

const OptionEntry& EntryOf(const std::string& command, const std::string& option)
{
  const CommandEntry& entry = EntryOf(command);
  for (const std::vector<OptionEntry>* options : { &entry.Positionals, &entry.Options })
  {
    for (const OptionEntry& candidate : *options)
    {
      const std::vector<std::string>& names =
        candidate.Names.empty() ? candidate.Values : candidate.Names;
      if (std::find(names.begin(), names.end(), option) != names.end())
      {
        return candidate;
      }
    }
  }
  throw std::out_of_range(option);
}

std::string Joined(const std::vector<std::string>& words, const char* separator)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : separator) + word;
  }
  return text;
}

std::vector<std::string> OptionsOf(const std::string& parameter)
{
  static const std::map<std::string, std::string> shorter{ { "MaximumIterations", "--iterations" },
    { "FeatureThreshold", "--threshold" }, { "MaximumComponents", "--components" },
    { "MinimumComponentWeight", "--minimum-weight" }, { "ClosingRadius", "--closing" },
    { "OpeningScale", "--opening" }, { "PropagationIterations", "--propagation" },
    { "StartCenterOffset", "--start-offset" } };
  std::string name = "-";
  for (const char letter : parameter)
  {
    const auto code = static_cast<unsigned char>(letter);
    name += std::isupper(code) ? std::string("-") : "";
    name += static_cast<char>(std::tolower(code));
  }
  const auto found = shorter.find(parameter);
  return found == shorter.end() ? std::vector<std::string>{ name }
                                : std::vector<std::string>{ found->second, name };
}

} // namespace Command
