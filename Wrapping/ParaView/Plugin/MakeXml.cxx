// Prints an XML file of the plugin, in which the parameters are filled in from the kernels' tables:
//
//     <?parameters Search advanced?>       the properties of a list; advanced: hidden at first
//     <?parameters Organ LabelValue?>      of those named; Name=Other: as the class calls it
//     <?exposed Search?>                   the names of a list, to be exposed or to be grouped
#include "Deformation/SegmentationParameters.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "Measures/ScoreParameters.h"
#include "MessageText.h"
#include "ParameterTable.h"
#include "QuantityNames.h"
#include "TextWords.h"
#include "Vessel/VesselParameters.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace
{

using namespace FlipFree;

/// The panel need not show a greater limit.
constexpr double PracticallyInfinite = 1e6;

struct Property
{
  std::string Name;
  ParameterType Type;
  std::vector<double> Default;
  double Minimum;
  double Maximum;
  ParameterWords Words;
};

using PropertyList = std::vector<Property>;

template <typename Settings>
PropertyList ListOf(const ParameterTable<Settings>& table)
{
  PropertyList list;
  list.reserve(table.size());
  for (const Parameter<Settings>& parameter : table)
  {
    list.push_back({ parameter.Name, parameter.Type, parameter.Get(Settings()), parameter.Minimum,
      parameter.Maximum, parameter.Words });
  }
  return list;
}

PropertyList Chosen(const PropertyList& list, const std::vector<std::string>& names)
{
  PropertyList chosen;
  for (const std::string& name : names)
  {
    const auto found = std::find_if(list.begin(), list.end(),
      [&](const Property& property) { return property.Name == name.substr(0, name.find('=')); });
    if (found == list.end())
    {
      throw std::out_of_range("there is no parameter " + name);
    }
    chosen.push_back(*found);
    chosen.back().Name = name.substr(name.find('=') + 1);
  }
  return chosen;
}

const PropertyList& ListOf(std::string_view name)
{
#define NAME(Name, ...) #Name,
  static const PropertyList organ = ListOf(SegmentationParameters());
  static const std::map<std::string, PropertyList> lists{ { "Organ", organ },
    { "Feature", Chosen(organ, { FLIPFREE_FEATURE_PARAMETERS(NAME, ) }) },
    { "Search", Chosen(organ, { FLIPFREE_TARGET_PARAMETERS(NAME, ) }) },
    { "Deform", Chosen(organ, { FLIPFREE_STEP_PARAMETERS(NAME, ) }) },
    { "Vessel", ListOf(VesselParameters()) }, { "Surfaces", ListOf(LabelSurfaceParameters()) },
    { "Scores", ListOf(ScoreParameters()) } };
#undef NAME
  return lists.at(std::string(name));
}

/// `Label Value` for LabelValue.
std::string LabelOf(const std::string& name)
{
  return std::regex_replace(name, std::regex("([a-z])([A-Z])"), "$1 $2");
}

std::string InXml(const std::string& text)
{
  return std::regex_replace(std::regex_replace(text, std::regex("&"), "&amp;"), std::regex("<"),
    "&lt;");
}

std::string DefaultOf(const Property& property)
{
  std::string text;
  for (const double value : property.Default)
  {
    text += (text.empty() ? "" : " ") + TextOf(value);
  }
  return text;
}

std::string DocumentationOf(const Property& property)
{
  QuantityNames names;
  for (const Property& other : ListOf("Organ"))
  {
    names[other.Name] = LabelOf(other.Name);
  }
  const std::string help = WithNames(property.Words.Help, names);
  const std::string unit = property.Words.Unit;
  if (property.Type == ParameterType::Boolean)
  {
    return help + ". Default " + (property.Default.front() != 0 ? "on." : "off.");
  }
  std::string text = help + ". Default " + DefaultOf(property) +
    (unit == "MM"          ? " mm"
        : unit == "VOXELS" ? " voxels"
                           : "");
  if (property.Minimum > -PracticallyInfinite)
  {
    text += "; " + TextOf(property.Minimum) +
      (property.Maximum < PracticallyInfinite ? " to " + TextOf(property.Maximum) : " or more");
  }
  return text + ".";
}

std::string DomainOf(const Property& property, const std::string& kind)
{
  if (property.Type == ParameterType::Boolean)
  {
    return "<BooleanDomain name=\"bool\"/>";
  }
  if (property.Name == "Modality")
  {
    return R"(<EnumerationDomain name="enum"><Entry text="Automatic" value="0"/>)"
           R"(<Entry text="CT" value="1"/><Entry text="MR" value="2"/></EnumerationDomain>)";
  }
  std::string domain = "<" + kind + "RangeDomain name=\"range\"";
  if (property.Minimum > -PracticallyInfinite)
  {
    domain += " min=\"" + TextOf(property.Minimum) + "\"";
  }
  if (property.Maximum < PracticallyInfinite)
  {
    domain += " max=\"" + TextOf(property.Maximum) + "\"";
  }
  return domain + "/>";
}

std::string ElementOf(const Property& property, bool isAdvanced)
{
  const std::string kind = property.Type == ParameterType::Real ? "Double" : "Int";
  return "<" + kind + "VectorProperty name=\"" + property.Name + "\" label=\"" +
    LabelOf(property.Name) + "\" command=\"Set" + property.Name + "\"" +
    (isAdvanced ? R"( panel_visibility="advanced")" : "") + " number_of_elements=\"" +
    std::to_string(property.Default.size()) + "\" default_values=\"" + DefaultOf(property) + "\">" +
    DomainOf(property, kind) + "<Documentation>" + InXml(DocumentationOf(property)) +
    "</Documentation></" + kind + "VectorProperty>\n";
}

/// What a place holder such as `parameters Search advanced` stands for.
std::string Filled(const std::string& holder)
{
  std::vector<std::string> words = Words(holder);
  PropertyList list = ListOf(words.at(1));
  const bool isAdvanced = words.back() == "advanced";
  words.resize(words.size() - (isAdvanced ? 1 : 0));
  if (words.size() > 2)
  {
    list = Chosen(list, { words.begin() + 2, words.end() });
  }
  std::string text;
  for (const Property& property : list)
  {
    text += words[0] == "exposed" ? "<Property name=\"" + property.Name + "\"/>\n"
                                  : ElementOf(property, isAdvanced);
  }
  return text;
}

} // namespace

int main(int argc, char* argv[])
{
  try
  {
    std::ifstream file(argc > 1 ? argv[1] : "");
    std::string text{ std::istreambuf_iterator<char>(file), {} };
    static const std::regex holder(R"(<\?((parameters|exposed)[^?]*)\?>)");
    for (std::smatch found; std::regex_search(text, found, holder);)
    {
      text = found.prefix().str() + Filled(found[1]) + found.suffix().str();
    }
    std::cout << text;
    return text.empty() ? 1 : 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
