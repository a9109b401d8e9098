// The organs of a session as requests of their own.
#include "SegmentRequest.h"

#include "Failure.h"

#include <algorithm>

namespace Command
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
      request.Organ = organ.Name;
      for (std::string* name :
        { &request.Surface, &request.Convergence, &request.Questions, &request.Snapshot })
      {
        *name = NameFor(organ.Name, *name);
      }
    }
    organs.push_back(request);
  }
  return organs;
}

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

std::vector<std::string> FixedOf(const Session& session)
{
  std::vector<std::string> files;
  for (const std::string& name : session.Fixed)
  {
    files.push_back(FileBeside(session, name, "The fixed surface"));
  }
  return files;
}

} // namespace Command
