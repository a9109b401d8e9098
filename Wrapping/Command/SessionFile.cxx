#include "SessionFile.h"

#include "Failure.h"

#include "vtkImageData.h"
#include "vtkMath.h"

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
std::string PropertyOf(std::string name)
{
  if (!name.empty())
  {
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  }
  return name;
}

/// Letters, digits and dashes, as the page makes them of a name, too.
std::string FileNameOf(const std::string& name)
{
  std::string file;
  for (const char letter : name)
  {
    const bool isPlain = letter < 0 || std::isalnum(static_cast<unsigned char>(letter)) != 0;
    file += isPlain ? letter : '-';
  }
  return file;
}

SessionOrgan OrganOf(const Json& entry)
{
  SessionOrgan organ;
  organ.Name = FileNameOf(entry.at("name").get<std::string>());
  organ.Preset = entry.at("preset").get<std::string>();
  const Json& seed = entry.at("seed");
  organ.Seed = Numbers<3>(seed, "center");
  organ.Radius = seed.at("radius").get<double>();
  for (const auto& [name, value] : entry.at("parameters").items())
  {
    organ.Parameters[PropertyOf(name)] = ValuesOf(value);
  }
  return organ;
}

Session SessionOf(const Json& content)
{
  if (content.at("format") != "flipfree-session" || content.at("version") != 1)
  {
    throw Failure("it is of another format or of a newer version");
  }
  Session session;
  const Json& image = content.at("image");
  session.ImageName = image.at("name").get<std::string>();
  session.Size = image.at("size").get<std::array<int, 3>>();
  session.Spacing = Numbers<3>(image, "spacing");
  session.Origin = Numbers<3>(image, "origin");
  session.Direction = Numbers<9>(image, "direction");
  std::set<std::string> names;
  for (const Json& entry : content.at("organs"))
  {
    // The page keeps organs that have not been given a seed yet.
    if (!entry.at("seed").is_null())
    {
      session.Organs.push_back(OrganOf(entry));
      if (!names.insert(session.Organs.back().Name).second)
      {
        throw Failure("two organs have the name '" + session.Organs.back().Name + "'");
      }
    }
  }
  if (session.Organs.empty())
  {
    throw Failure("no organ has a seed");
  }
  return session;
}

/// The far corner of a grid whose near corner is its origin.
std::array<double, 3> FarCorner(const Session& session)
{
  std::array<double, 3> corner = session.Origin;
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      corner[row] +=
        session.Direction[3 * row + axis] * session.Spacing[axis] * (session.Size[axis] - 1);
    }
  }
  return corner;
}

} // namespace

Session ReadSession(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  if (!file)
  {
    throw Failure("'" + name + "' cannot be read. Check the name and the permissions.");
  }
  try
  {
    Session session = SessionOf(Json::parse(file));
    session.File = name;
    return session;
  }
  catch (const Json::exception& error)
  {
    // [json.exception.type_error.302] type must be ...
    const std::string reason = error.what();
    const std::size_t start = reason.find("] ");
    throw Failure("'" + name + "' is not a session that the page has saved: " +
      reason.substr(start == std::string::npos ? 0 : start + 2) + ". Save it again.");
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + name + "' cannot be repeated: " + failure.what() +
      ". Open it in the page and save it again.");
  }
}

std::string ImageBeside(const Session& session)
{
  namespace fs = std::filesystem;
  const fs::path path = fs::path(session.File).parent_path() / session.ImageName;
  std::error_code error;
  if (session.ImageName.empty() || !fs::exists(path, error))
  {
    throw Failure("The image '" + session.ImageName + "' is not beside '" + session.File +
      "'. Give it, too: flipfree segment IMAGE --session '" + session.File + "'.");
  }
  return path.string();
}

void RequireImageOf(const Session& session, const std::string& name, vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  double corners[2][3];
  const double first[3] = { 0, 0, 0 };
  const double last[3] = { size[0] - 1.0, size[1] - 1.0, size[2] - 1.0 };
  image->TransformContinuousIndexToPhysicalPoint(first, corners[0]);
  image->TransformContinuousIndexToPhysicalPoint(last, corners[1]);
  const std::array<double, 3> farCorner = FarCorner(session);
  const double tolerance = 0.1 * *std::min_element(session.Spacing.begin(), session.Spacing.end());
  const bool isSame = std::equal(session.Size.begin(), session.Size.end(), size) &&
    std::sqrt(vtkMath::Distance2BetweenPoints(corners[0], session.Origin.data())) <= tolerance &&
    std::sqrt(vtkMath::Distance2BetweenPoints(corners[1], farCorner.data())) <= tolerance;
  if (!isSame)
  {
    throw Failure("'" + name + "' is not the image of '" + session.File + "', which is '" +
      session.ImageName + "' of " + std::to_string(session.Size[0]) + " x " +
      std::to_string(session.Size[1]) + " x " + std::to_string(session.Size[2]) +
      " voxels: its voxels are elsewhere. Give that image.");
  }
}

} // namespace Command
