#include "Exchange/NiftiLabelTable.h"

#include "Exchange/ByteOrder.h"

#include <algorithm>
#include <climits>
#include <cstdlib>

namespace FlipFree
{
namespace
{

void ReplaceAll(std::string& text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
  {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

// The content of an element as text.
std::string TextOfElement(std::string content)
{
  const std::string begin = "<![CDATA[";
  const std::size_t data = content.find(begin);
  if (data != std::string::npos)
  {
    content = content.substr(data + begin.size());
    return content.substr(0, content.find("]]>"));
  }
  for (const auto& [entity, character] : { std::pair<const char*, const char*>{ "&lt;", "<" },
         { "&gt;", ">" }, { "&quot;", "\"" }, { "&apos;", "'" }, { "&amp;", "&" } })
  {
    ReplaceAll(content, entity, character);
  }
  return content;
}

// <Label Key="5" Red="1" ...><![CDATA[liver]]></Label>
void AddLabels(const std::string& xml, std::map<int, std::string>& names)
{
  const std::string element = "<Label ";
  for (std::size_t at = xml.find(element); at != std::string::npos; at = xml.find(element, at + 1))
  {
    const std::size_t end = xml.find('>', at);
    const std::size_t key = xml.find("Key=\"", at);
    const std::size_t close = xml.find("</Label>", at);
    if (close == std::string::npos || key >= end || end > close)
    {
      continue;
    }
    char* rest = nullptr;
    const long label = std::strtol(xml.c_str() + key + 5, &rest, 10);
    const std::string name = TextOfElement(xml.substr(end + 1, close - end - 1));
    if (*rest == '"' && label > 0 && label <= INT_MAX && !name.empty())
    {
      names.emplace(static_cast<int>(label), name);
    }
  }
}

} // namespace

std::map<int, std::string> NiftiLabelNames(const std::string& start, std::size_t begin,
  std::uint64_t voxelOffset, bool isBigEndian)
{
  constexpr std::size_t Prefix = 8; // an extension's size and its kind
  std::map<int, std::string> names;
  const auto end = static_cast<std::size_t>(std::min<std::uint64_t>(start.size(), voxelOffset));
  if (begin + 4 > end || start[begin] == 0)
  {
    return names;
  }
  std::size_t at = begin + 4;
  while (at + Prefix <= end)
  {
    const auto size = NumberFrom<std::int32_t>(&start[at], isBigEndian);
    if (size < static_cast<std::int32_t>(Prefix) || static_cast<std::size_t>(size) > end - at)
    {
      break;
    }
    AddLabels(start.substr(at + Prefix, static_cast<std::size_t>(size) - Prefix), names);
    at += static_cast<std::size_t>(size);
  }
  return names;
}

} // namespace FlipFree
