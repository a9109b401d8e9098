/**
 * The parts of the extension, and how a settings struct becomes a class of Python.
 */
#ifndef FlipFreeBindings_h
#define FlipFreeBindings_h

#include "ParameterTable.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace FlipFree
{

void BindCommand(nanobind::module_& module);
void BindSegmentation(nanobind::module_& module);
void BindVessels(nanobind::module_& module);
void BindDicom(nanobind::module_& module);
void BindEvaluation(nanobind::module_& module);
void BindExchange(nanobind::module_& module);
void BindLabels(nanobind::module_& module);
void BindPhantoms(nanobind::module_& module);

/// The parameters of some settings: names, types ("bool", "int", "float") and numbers.
template <typename Settings>
nanobind::class_<Settings> BindSettings(nanobind::module_& module, const char* name,
  const ParameterTable<Settings>& (*table)())
{
  const auto find = [table](const std::string& wanted) -> const Parameter<Settings>&
  {
    const Parameter<Settings>* const parameter = FindParameter(table(), wanted);
    if (!parameter)
    {
      throw std::out_of_range(wanted);
    }
    return *parameter;
  };
  return nanobind::class_<Settings>(module, name)
    .def_static("parameters",
      [table]
      {
        const char* const types[] = { "bool", "int", "float" };
        std::vector<std::tuple<std::string, std::string, int>> parameters;
        for (const Parameter<Settings>& parameter : table())
        {
          parameters.emplace_back(parameter.Name, types[static_cast<int>(parameter.Type)],
            parameter.Count);
        }
        return parameters;
      })
    .def("get",
      [find](const Settings& settings, const std::string& wanted)
      { return find(wanted).Get(settings); })
    .def("set",
      [find](Settings& settings, const std::string& wanted, const std::vector<double>& values)
      {
        const Parameter<Settings>& parameter = find(wanted);
        if (static_cast<int>(values.size()) != parameter.Count)
        {
          throw std::invalid_argument(wanted);
        }
        parameter.Set(settings, values);
      });
}

} // namespace FlipFree

#endif
