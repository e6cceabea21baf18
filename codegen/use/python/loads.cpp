// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/python/loads.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "codegen/use/api/regulus.hpp"
#include "codegen/use/python/calls.hpp"
#include "codegen/use/python/words.hpp"

namespace regulus::detail {
namespace {

namespace py = pybind11;

/// The paving with its boxes: `bounds` has the lower and the upper bound of each variable.
struct LoadPavingWithBoxes {
  LoadPaving paving;
  std::vector<std::uint8_t> claims;
  std::vector<double> bounds;
};

LoadPavingWithBoxes locate_load_boxes(const Question& question, LocateLoadOptions options,
                                      const std::atomic<bool>& interrupt) {
  LoadPavingWithBoxes found;
  options.on_box = [&found](ForceClaim claim, std::span<const Interval> box) {
    found.claims.push_back(static_cast<std::uint8_t>(claim));
    for (const Interval& range : box) {
      found.bounds.push_back(range.lo);
      found.bounds.push_back(range.hi);
    }
  };
  found.paving = locate_load(question, options, &interrupt);
  return found;
}

/// Copies the boxes as an array of the shape (boxes, variables, 2).
py::array_t<double> array_of_load_bounds(const LoadPavingWithBoxes& p) {
  const auto variables = static_cast<py::ssize_t>(p.paving.finding.variables.size());
  const auto boxes = static_cast<py::ssize_t>(p.claims.size());
  return py::array_t<double>(std::vector<py::ssize_t>{boxes, variables, 2}, p.bounds.data());
}

/// The stretches of a motion along way-points, as JSON.
std::vector<std::string> stretches_of_load(const LoadPavingWithBoxes& p) {
  std::vector<std::string> texts;
  for (const LoadStretch& stretch : p.paving.stretches) texts.push_back(stretch.json);
  return texts;
}

void bind_load_findings(py::module_& module) {
  py::class_<LoadFinding>(module, "LoadFinding")
      .def_property_readonly("verdict",
                             [](const LoadFinding& f) { return word_of_verdict(f.verdict); })
      .def_readonly("claim", &LoadFinding::claim)
      .def_readonly("reason", &LoadFinding::reason)
      .def_readonly("boxes", &LoadFinding::boxes)
      .def_readonly("report", &LoadFinding::report)
      .def_readonly("json", &LoadFinding::json)
      .def_readonly("seconds", &LoadFinding::seconds)
      .def_readonly("certificate", &LoadFinding::certificate)
      .def_readonly("no_certificate", &LoadFinding::no_certificate);
  py::class_<LoadPavingWithBoxes>(module, "LoadPavingFinding")
      .def_property_readonly(
          "verdict",
          [](const LoadPavingWithBoxes& p) { return word_of_verdict(p.paving.finding.verdict); })
      .def_property_readonly("reason",
                             [](const LoadPavingWithBoxes& p) { return p.paving.finding.reason; })
      .def_property_readonly(
          "variables", [](const LoadPavingWithBoxes& p) { return p.paving.finding.variables; })
      .def_property_readonly("report",
                             [](const LoadPavingWithBoxes& p) { return p.paving.finding.report; })
      .def_property_readonly("json",
                             [](const LoadPavingWithBoxes& p) { return p.paving.finding.json; })
      .def_property_readonly(
          "certificate", [](const LoadPavingWithBoxes& p) { return p.paving.finding.certificate; })
      .def_property_readonly(
          "no_certificate",
          [](const LoadPavingWithBoxes& p) { return p.paving.finding.no_certificate; })
      .def_property_readonly("stretches", stretches_of_load)
      .def("claims",
           [](const LoadPavingWithBoxes& p) {
             return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(p.claims.size()),
                                              p.claims.data());
           })
      .def("bounds", array_of_load_bounds);
  module.attr("LOAD_CLAIMS") =
      py::make_tuple(name(ForceClaim::kFeasible), name(ForceClaim::kInfeasible),
                     name(ForceClaim::kUndecided), name(ForceClaim::kOutside));
}

}  // namespace

void bind_loads(py::module_& module) {
  bind_load_findings(module);
  module.def(
      "check_load",
      [](const Question& question, const std::string& load, const SearchOptions& options,
         const std::string& path, std::uint64_t shard_size) {
        return run_there([=](const std::atomic<bool>& interrupt) {
          return check_load(question, load, options, &interrupt, path, shard_size);
        });
      },
      py::arg("question"), py::arg("load"), py::arg("options"), py::arg("certificate") = "",
      py::arg("shard_size") = 0);
  module.def(
      "locate_load",
      [](const Question& question, const std::string& load, const SearchOptions& search,
         const std::string& resolution, const std::string& path, std::uint64_t shard_size) {
        LocateLoadOptions options{search, load, resolution, path};
        options.shard_size = shard_size;
        return run_there([=](const std::atomic<bool>& interrupt) {
          return locate_load_boxes(question, options, interrupt);
        });
      },
      py::arg("question"), py::arg("load"), py::arg("options"), py::arg("resolution") = "",
      py::arg("certificate") = "", py::arg("shard_size") = 0);
}

}  // namespace regulus::detail
