#include "SessionRecord.h"

#include "Failure.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace Command
{
namespace
{

using OrderedJson = nlohmann::ordered_json; // as people read it: the format first

/// Of a file, or of a folder with a slash at its end.
std::string NameIn(const std::string& path)
{
  const std::filesystem::path whole(path);
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

void Fill(OrderedJson& value, const std::string& name)
{
  if (!name.empty())
  {
    value = name;
  }
}

/// Empty where there is none.
std::string At(const std::vector<std::string>& texts, std::size_t index)
{
  return index < texts.size() ? texts[index] : std::string();
}

/// In a line each unless `indent` is negative. Names that are no UTF-8 do not stop it.
std::string TextOf(const OrderedJson& session, int indent = -1)
{
  return session.dump(indent, ' ', false, OrderedJson::error_handler_t::replace);
}

} // namespace

std::string NamedProvenance(const std::string& provenance, const OriginNames& names)
{
  OrderedJson session = OrderedJson::parse(provenance, nullptr, false);
  if (session.is_discarded()) // a name is no UTF-8
  {
    return provenance;
  }
  OrderedJson& organs = session.at("organs");
  Fill(session.at("image").at("name"), NameIn(names.Image));
  if (!names.Series.empty())
  {
    session.at("image")["series"] = names.Series;
  }
  for (std::size_t index = 0; index < organs.size(); ++index)
  {
    Fill(organs[index].at("name"), At(names.Organs, index));
    Fill(organs[index].at("color"), At(names.Colors, index));
    if (organs[index].contains("startLabels"))
    {
      OrderedJson& start = organs[index].at("startLabels");
      Fill(start.at("name"), NameIn(names.StartLabels));
      // A name stays one: in other layers of the file, its value means other segments.
      if (!names.StartLabel.empty() && names.StartLabel != start.at("label").dump())
      {
        start.at("label") = names.StartLabel;
      }
    }
  }
  for (std::size_t index = 0; index < names.Fixed.size(); ++index)
  {
    session.at("fixed").at(index) = NameIn(names.Fixed[index]);
  }
  return TextOf(session);
}

std::string OrganOfFiles(const std::vector<std::string>& files)
{
  const auto file =
    std::find_if(files.begin(), files.end(), [](const std::string& name) { return !name.empty(); });
  const std::string name = file == files.end() ? std::string() : NameIn(*file);
  return name.substr(0, name.find('.', 1));
}

std::string FileNameOf(const std::string& organ)
{
  std::string file = organ;
  std::replace_if(
    file.begin(), file.end(),
    [](char letter)
    {
      const auto code = static_cast<unsigned char>(letter);
      return code < 128 && !std::isalnum(code);
    },
    '-');
  return file;
}

std::string SessionText(const std::string& name, const std::vector<std::string>& sessions)
{
  if (!std::all_of(sessions.begin(), sessions.end(),
        [](const auto& text) { return OrderedJson::accept(text); }))
  {
    throw Failure("'" + name + "' cannot be written: the name of an organ is not in UTF-8.");
  }
  OrderedJson all = OrderedJson::parse(sessions.front());
  for (auto more = sessions.begin() + 1; more != sessions.end() && !all.contains("together");
       ++more)
  {
    const OrderedJson session = OrderedJson::parse(*more);
    all["organs"].push_back(session.at("organs").at(0));
  }
  return TextOf(all, 2) + "\n";
}

} // namespace Command
