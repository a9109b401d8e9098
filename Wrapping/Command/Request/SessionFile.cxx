#include "SessionFile.h"

#include "Failure.h"
#include "FileFormats.h"
#include "SeedRadius.h"
#include "SessionRecord.h"
#include "UnreadableFile.h"

#include "Image/LatticePlacement.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

namespace Command
{
namespace
{

using Json = nlohmann::json;

/// Of one to three coordinates, or of a matrix; all finite.
template <std::size_t Count>
std::array<double, Count> Numbers(const Json& object, const char* key)
{
  const auto numbers = object.at(key).get<std::array<double, Count>>();
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
  {
    throw Failure(std::string(key) + " is not finite");
  }
  return numbers;
}

/// A number, a switch or an array of numbers.
std::vector<double> ValuesOf(const Json& value)
{
  if (value.is_boolean())
  {
    return { value.get<bool>() ? 1.0 : 0.0 };
  }
  return value.is_array() ? value.get<std::vector<double>>()
                          : std::vector<double>{ value.get<double>() };
}

/// ForegroundMass for foregroundMass.
std::string PropertyOfKey(std::string name)
{
  if (!name.empty())
  {
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  }
  return name;
}

/// [json.exception.type_error.302] type must be ...
std::string ReasonOf(const Json::exception& error)
{
  const std::string reason = error.what();
  const std::size_t start = reason.find("] ");
  return reason.substr(start == std::string::npos ? 0 : start + 2);
}

/// Reads entry after entry of a list; what is wrong in one is said with its name and number.
template <typename Read>
void ReadEntries(const Json& list, const std::string& name, const Read& read)
{
  int number = 0;
  for (const Json& entry : list)
  {
    ++number;
    const std::string place = name + " " + std::to_string(number) + ": ";
    try
    {
      read(entry);
    }
    catch (const Json::exception& error)
    {
      throw Failure(place + ReasonOf(error));
    }
    catch (const Failure& failure)
    {
      throw Failure(place + failure.what());
    }
  }
}

CorrectionPoint CorrectionOf(const Json& entry)
{
  CorrectionPoint point;
  point.Kind = KindOf(entry.at("kind").get<std::string>());
  point.Place = Numbers<3>(entry, "position");
  if (point.Kind == FlipFree::ConstraintKind::Seed)
  {
    point.Radius = entry.at("radius").get<double>();
  }
  RequireRadius(point);
  return point;
}

/// Organs of version 1 have neither a kind nor corrections.
bool IsVessel(const Json& entry)
{
  const auto kind = entry.value("kind", std::string("organ"));
  if (kind != "organ" && kind != "vessel")
  {
    throw Failure("the kind is '" + kind + "'; it can be organ or vessel");
  }
  return kind == "vessel";
}

/// The page keeps organs that have not been given a seed yet, and vessels without enough points.
bool CanBeRepeated(const Json& entry)
{
  return IsVessel(entry) ? entry.at("points").size() > 1
                         : !entry.at("seed").is_null() || entry.contains("startLabels");
}

void ReadOrgan(const Json& entry, SessionOrgan& organ)
{
  organ.Preset = entry.at("preset").get<std::string>();
  if (entry.value("startSurface", false))
  {
    throw Failure("it began with a surface, which a session does not hold");
  }
  if (entry.contains("startLabels"))
  {
    const Json& labels = entry.at("startLabels");
    organ.StartLabels = labels.at("name").get<std::string>();
    const Json& label = labels.at("label");
    organ.StartLabel =
      label.is_string() ? label.get<std::string>() : std::to_string(label.get<int>());
    if (!IsLabel(organ.StartLabel))
    {
      throw Failure("the label of its start is negative, or empty");
    }
  }
  else
  {
    const Json& seed = entry.at("seed");
    organ.Seed = Numbers<3>(seed, "center");
    organ.Radius = seed.at("radius").get<double>();
    if (!IsSeedRadius(organ.Radius))
    {
      throw Failure("the radius " + SeedRadiusRule(organ.Radius));
    }
  }
}

void RefuseSeeds(const std::vector<CorrectionPoint>& corrections)
{
  if (std::any_of(corrections.begin(), corrections.end(),
        [](const CorrectionPoint& point) { return point.Kind == FlipFree::ConstraintKind::Seed; }))
  {
    throw Failure("a seed is of no use to a vessel");
  }
}

void ReadVessel(const Json& entry, SessionOrgan& vessel)
{
  ReadEntries(entry.at("points"), "point",
    [&vessel](const Json& point) {
      vessel.Points.push_back(Numbers<3>(Json{ { "point", point } }, "point"));
    });
}

/// Vessels of version 2 have none.
void ReadCorrections(const Json& entry, SessionOrgan& organ)
{
  ReadEntries(entry.value("corrections", Json::array()), "correction",
    [&organ](const Json& correction) { organ.Corrections.push_back(CorrectionOf(correction)); });
}

SessionOrgan OrganOf(const Json& entry)
{
  SessionOrgan organ;
  const auto name = entry.at("name").get<std::string>();
  organ.Name = FileNameOf(name);
  organ.Title = name;
  try
  {
    organ.Color = entry.value("color", std::string());
    (IsVessel(entry) ? ReadVessel : ReadOrgan)(entry, organ);
    ReadCorrections(entry, organ);
    if (IsVessel(entry))
    {
      RefuseSeeds(organ.Corrections);
    }
    for (const auto& [parameter, value] : entry.at("parameters").items())
    {
      organ.Parameters[PropertyOfKey(parameter)] = ValuesOf(value);
    }
  }
  catch (const Json::exception& error)
  {
    throw Failure("'" + name + "': " + ReasonOf(error));
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + name + "': " + failure.what());
  }
  return organ;
}

bool CanGrowWithOthers(const SessionOrgan& organ, const SessionOrgan& first)
{
  return organ.Points.empty() && organ.StartLabel.empty() && organ.Preset == first.Preset &&
    organ.Parameters == first.Parameters;
}

Session SessionOf(const Json& content)
{
  const std::array<Json, 2> known{ { 1, 2 } };
  if (content.at("format") != "flipfree-session" ||
    std::find(known.begin(), known.end(), content.at("version")) == known.end())
  {
    throw Failure("it has another format or a newer version");
  }
  Session session;
  const Json& image = content.at("image");
  session.ImageName = image.at("name").get<std::string>();
  session.SeriesUID = image.value("series", std::string());
  session.Size = image.at("size").get<std::array<int, 3>>();
  session.Spacing = Numbers<3>(image, "spacing");
  session.Origin = Numbers<3>(image, "origin");
  session.Direction = Numbers<9>(image, "direction");
  std::set<std::string> names;
  ReadEntries(content.at("organs"), "organ",
    [&](const Json& entry)
    {
      if (CanBeRepeated(entry))
      {
        session.Organs.push_back(OrganOf(entry));
        if (!names.insert(session.Organs.back().Name).second)
        {
          throw Failure("another organ has the name '" + session.Organs.back().Name + "', too");
        }
      }
    });
  if (session.Organs.empty())
  {
    throw Failure("no organ has a seed");
  }
  session.Together = content.value("together", false);
  session.Fixed = content.value("fixed", std::vector<std::string>());
  for (const SessionOrgan& organ : session.Organs)
  {
    if (session.Together && !CanGrowWithOthers(organ, session.Organs.front()))
    {
      throw Failure("'" + organ.Title +
        "': organs that were segmented together have a seed each, and the same parameters");
    }
  }
  return session;
}

/// Empty if there is no such file.
std::string PathBeside(const Session& session, const std::string& name)
{
  namespace fs = std::filesystem;
  const fs::path path = fs::path(session.File).parent_path() / fs::path(name).filename();
  std::error_code error;
  return name.empty() || !fs::exists(path, error) ? std::string() : path.string();
}

FlipFree::ImageGeometry GeometryOf(const Session& session)
{
  FlipFree::ImageGeometry geometry;
  geometry.Dimensions = session.Size;
  geometry.Spacing = Eigen::Vector3d(session.Spacing.data());
  geometry.Origin = Eigen::Vector3d(session.Origin.data());
  geometry.Direction = Eigen::Map<const FlipFree::RowMajorMatrix>(session.Direction.data());
  return geometry;
}

} // namespace

Session ReadSession(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  if (!file)
  {
    throw UnreadableFile(name);
  }
  try
  {
    Session session = SessionOf(Json::parse(file));
    session.File = name;
    return session;
  }
  catch (const Json::exception& error)
  {
    throw Failure("'" + name + "' is not a session that the page or --save-session has saved: " +
      ReasonOf(error) + ". Save it again.");
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + name + "' cannot be repeated: " + failure.what() +
      ". Open it in the page and save it again.");
  }
}

std::string ImageBeside(const Session& session)
{
  std::string path = PathBeside(session, session.ImageName);
  if (path.empty())
  {
    throw Failure("The image '" + session.ImageName + "' is not beside '" + session.File +
      "'. Give it, too: flipfree segment IMAGE --session '" + session.File + "'.");
  }
  return path;
}

std::string FileBeside(const Session& session, const std::string& name, const std::string& what)
{
  std::string path = PathBeside(session, name);
  if (path.empty())
  {
    throw Failure(
      what + " '" + name + "' is not beside '" + session.File + "'. Copy the file there.");
  }
  return path;
}

void RequireImageOf(const Session& session, const std::string& name,
  const FlipFree::ImageGeometry& image)
{
  if (!FlipFree::HaveSamePlaces(GeometryOf(session), image))
  {
    throw Failure("'" + name + "' is not the image of '" + session.File + "', which is '" +
      session.ImageName + "' of " + std::to_string(session.Size[0]) + " x " +
      std::to_string(session.Size[1]) + " x " + std::to_string(session.Size[2]) +
      " voxels: its voxels are elsewhere. Give that image.");
  }
}

} // namespace Command
