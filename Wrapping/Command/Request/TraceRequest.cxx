#include "TraceRequest.h"

#include "Coordinates.h"
#include "Failure.h"
#include "FileFormats.h"
#include "MessageText.h"

#include "Vessel/VesselParameters.h"

namespace Command
{
namespace
{

/// Other parameters are refused as everywhere.
void RefuseLength(const FlipFree::Parameter<FlipFree::VesselSegmentationSettings>& parameter,
  double value)
{
  if (parameter.Words.Unit == std::string("MM"))
  {
    throw WrongUsage(OptionsOf(parameter.Name).front() + " must be a number of millimeters, " +
      FlipFree::TextOf(parameter.Minimum) + " to " + FlipFree::TextOf(parameter.Maximum) +
      ", not " + FlipFree::TextOf(value) + "." +
      (parameter.Name == "Radius" ? " 0 finds it." : ""));
  }
}

} // namespace

std::vector<std::array<double, 3>> TraceRequest::Places() const
{
  std::vector<std::array<double, 3>> places;
  for (std::size_t first = 0; first + 2 < this->Points.size(); first += 3)
  {
    places.push_back(this->Corrections.InLps(this->Points.data() + first));
  }
  return places;
}

FlipFree::VesselSegmentationSettings TraceRequest::Settings() const
{
  FlipFree::VesselSegmentationSettings settings;
  this->Parameters.Apply(settings, RefuseLength);
  return settings;
}

std::vector<RequestedFile> OutputsOf(const TraceRequest& request)
{
  return { { "--output", request.Surface, SurfaceEndings() },
    { "--labels", request.Labels, VolumeEndings() },
    { "--centerline", request.Centerline, { ".vtp" } },
    { "--convergence", request.Convergence, { ".csv" } },
    { "--snapshot", request.Snapshot, { ".png" } },
    { "--save-session", request.SessionOut, { ".json" } } };
}

void ValidateRequest(const TraceRequest& request)
{
  RequireCoordinates("--point", request.Points);
  if (request.Points.size() < 6)
  {
    throw WrongUsage("A vessel needs at least two points. Give one at each end: "
                     "--point X Y Z --point X Y Z (LPS mm).");
  }
  request.Corrections.Validate();
  RequireOutputs(OutputsOf(request));
}

void AnnounceOutputs(const TraceRequest& request, const Announce& announce)
{
  std::vector<std::string> kept = request.Corrections.StrokeFiles();
  kept.push_back(request.Input);
  std::vector<std::string> inputs = kept;
  inputs.push_back(request.Corrections.Input());
  AnnounceFiles(OutputsOf(request), inputs, announce);
  AnnounceFiles({ { "--save-points", request.Corrections.Output(), {} } }, kept, announce);
}

OriginNames NamesOf(const TraceRequest& request)
{
  OriginNames names;
  names.Image = request.Input;
  names.Series = request.SeriesUID;
  names.Organs = { OrganOfFiles(
    { request.Surface, request.Labels, request.Centerline, request.SessionOut }) };
  return names;
}

void AddOptions(CLI::App& command, TraceRequest& request)
{
  AddOption(command, "INPUT", request.Input);
  AddOption(command, "--series", request.SeriesUID);
  AddOption(command, "--point", request.Points);
  AddOption(command, "--output", request.Surface);
  AddOption(command, "--labels", request.Labels);
  AddOption(command, "--centerline", request.Centerline);
  AddOption(command, "--convergence", request.Convergence);
  AddOption(command, "--snapshot", request.Snapshot);
  AddOption(command, "--save-session", request.SessionOut);
  request.Parameters.AddOptions(command, FlipFree::VesselParameters());
  AddThreadsOption(command, request.Threads);
  AddOption(command, "--quiet", request.Quiet);
  request.Corrections.AddOptions(command);
}

} // namespace Command
