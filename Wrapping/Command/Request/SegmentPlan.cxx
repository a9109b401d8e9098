#include "SegmentPlan.h"

#include "Failure.h"
#include "FileFormats.h"

#include "Vessel/VesselParameters.h"

#include <algorithm>

namespace Command
{
namespace
{

std::string NameFor(const std::string& organ, const std::string& name)
{
  if (name.empty())
  {
    return name;
  }
  const std::size_t folder = name.find_last_of('/') + 1; // 0 if there is none
  return std::string(name).insert(std::min(name.find('.', folder + 1), name.size()), "-" + organ);
}

/// One for each organ of the session.
std::vector<SegmentRequest> OrgansOf(const Session& session, const SegmentRequest& given)
{
  std::vector<SegmentRequest> organs;
  for (const SessionOrgan& organ : session.Organs)
  {
    SegmentRequest request = given;
    request.Repeated = organ;
    if (!organ.StartLabel.empty())
    {
      request.StartLabels =
        FileBeside(session, organ.StartLabels, organ.Title + ": the label map of its start");
      request.StartLabel = organ.StartLabel;
    }
    else if (!request.IsVessel())
    {
      request.Seed.assign(organ.Seed.begin(), organ.Seed.end());
      request.Radius = { organ.Radius };
    }
    request.Label = given.Label + static_cast<int>(organs.size());
    if (request.Label > 255)
    {
      throw Failure(
        "'" + given.Session + "': labels go up to 255. Remove organs, or leave out --label-value.");
    }
    try
    {
      if (!request.IsVessel())
      {
        request.Parameters = given.Parameters.With(organ.Preset, organ.Parameters);
      }
    }
    catch (const Failure& failure)
    {
      throw Failure("'" + given.Session + "': " + organ.Name + ": " + failure.what() + ".");
    }
    if (session.Organs.size() > 1)
    {
      request = WithFilesOf(organ.Name, request);
      request.Organ = organ.Name;
    }
    organs.push_back(request);
  }
  return organs;
}

/// The organs that were segmented together; `given` gets their parameters.
std::vector<GivenOrgan> GroupOf(const Session& session, SegmentRequest& given)
{
  std::vector<GivenOrgan> organs;
  for (const SessionOrgan& organ : session.Organs)
  {
    organs.push_back({ organ.Title, organ.Seed, organ.Radius, organ.Corrections, organ.Color });
  }
  const SessionOrgan& first = session.Organs.front();
  try
  {
    given.Parameters = given.Parameters.With(first.Preset, first.Parameters);
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + given.Session + "': " + failure.what() + ".");
  }
  return organs;
}

/// The files of the surfaces that they kept off.
std::vector<std::string> FixedOf(const Session& session)
{
  std::vector<std::string> files;
  for (const std::string& name : session.Fixed)
  {
    files.push_back(FileBeside(session, name, "The fixed surface"));
  }
  return files;
}

void AddSession(SegmentPlan& plan)
{
  const Session& session = plan.From.emplace(ReadSession(plan.Given.Session));
  if (plan.Given.Input.empty())
  {
    plan.Given.Input = ImageBeside(session);
  }
  if (plan.Given.SeriesUID.empty() && MayHoldSeries(plan.Given.Input))
  {
    plan.Given.SeriesUID = session.SeriesUID;
  }
  if (session.Together)
  {
    plan.Group = GroupOf(session, plan.Given);
    plan.Fixed = FixedOf(session);
  }
  else
  {
    plan.Organs = OrgansOf(session, plan.Given);
  }
}

void AnnounceOrgan(const SegmentRequest& request, const Announce& announce)
{
  std::vector<std::string> kept = request.Corrections.StrokeFiles();
  kept.insert(kept.end(), { request.Input, request.StartLabels, request.Session });
  std::vector<std::string> inputs = kept;
  inputs.push_back(request.Corrections.Input());
  AnnounceFiles(OutputsOf(request), inputs, announce);
  // All points may take the place of those that were given.
  AnnounceFiles({ { "--save-points", request.Corrections.Output(), {} } }, kept, announce);
}

void AnnounceGroup(const SegmentPlan& plan, const Announce& announce)
{
  const SegmentRequest& given = plan.Given;
  std::vector<std::string> inputs = given.Corrections.StrokeFiles();
  inputs.insert(inputs.end(), { given.Input, given.Session });
  inputs.insert(inputs.end(), plan.Fixed.begin(), plan.Fixed.end());
  AnnounceFiles({ { "--labels", given.Labels, {} }, { "--save-session", given.SessionOut, {} } },
    inputs, announce);
  for (const GivenOrgan& organ : plan.Group)
  {
    SegmentRequest own = WithFilesOf(organ.FileName(), given);
    own.Labels.clear();
    own.SessionOut.clear();
    AnnounceFiles(OutputsOf(own), inputs, announce);
  }
}

[[noreturn]] void RefuseVessel(const SegmentRequest& request, const std::string& fault)
{
  throw Failure("'" + request.Session + "': " + request.Repeated.Name + ": " + fault +
    ". Correct it, or remove it.");
}

} // namespace

SegmentRequest WithFilesOf(const std::string& organ, const SegmentRequest& given)
{
  SegmentRequest own = given;
  for (std::string* name : { &own.Surface, &own.Convergence, &own.Questions, &own.Snapshot })
  {
    *name = NameFor(organ, *name);
  }
  return own;
}

SegmentPlan PlanOf(const SegmentRequest& request)
{
  ValidateRequest(request);
  SegmentPlan plan;
  plan.Given = request;
  if (request.Several.HasOrgans())
  {
    plan.Group = request.Several.Organs(request.Corrections);
    plan.Fixed = request.Several.FixedSurfaces();
  }
  else if (request.Session.empty())
  {
    plan.Organs = { request };
  }
  else
  {
    AddSession(plan);
  }
  return plan;
}

void AnnounceOutputs(const SegmentPlan& plan, const Announce& announce)
{
  for (const SegmentRequest& organ : plan.Organs)
  {
    AnnounceOrgan(organ, announce);
  }
  if (!plan.Group.empty())
  {
    AnnounceGroup(plan, announce);
  }
}

FlipFree::VesselSegmentationSettings VesselSettingsOf(const SegmentRequest& request)
{
  std::vector<std::string> names;
  for (const auto& parameter : FlipFree::VesselParameters())
  {
    if (parameter.Name != "LabelValue") // which changes no surface
    {
      names.push_back(parameter.Name);
    }
  }
  FlipFree::VesselSegmentationSettings settings;
  for (const auto& [property, values] : request.Repeated.Parameters)
  {
    if (std::find(names.begin(), names.end(), property) == names.end())
    {
      names.back().insert(0, "and ");
      RefuseVessel(request,
        "there is no parameter '" + property + "' of a vessel; there are " + Joined(names, ", "));
    }
    if (values.size() != 1 ||
      !FlipFree::FindParameter(FlipFree::VesselParameters(), property)->Take(settings, values))
    {
      RefuseVessel(request, "the parameter '" + property + "' is out of its range");
    }
  }
  return settings;
}

} // namespace Command
