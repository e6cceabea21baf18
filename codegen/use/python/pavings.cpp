// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/python/pavings.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "codegen/use/api/regulus.hpp"
#include "codegen/use/python/calls.hpp"
#include "codegen/use/python/words.hpp"

namespace regulus::detail {
namespace {

namespace py = pybind11;

/// The paving with its boxes: `bounds` has the lower and the upper bound of each variable.
struct PavingWithBoxes {
  Paving paving;
  std::vector<std::uint8_t> claims;
  std::vector<double> bounds;
};

PavingWithBoxes locate_boxes(const Question& question, const SearchOptions& search,
                             const std::string& resolution, const std::string& certificate,
                             std::uint64_t shard_size, const std::atomic<bool>& interrupt) {
  PavingWithBoxes found;
  LocateOptions options{.search = search, .resolution = resolution};
  options.certificate = certificate;
  options.shard_size = shard_size;
  options.on_box = [&found](Claim claim, std::span<const Interval> box) {
    found.claims.push_back(static_cast<std::uint8_t>(claim));
    for (const Interval& range : box) {
      found.bounds.push_back(range.lo);
      found.bounds.push_back(range.hi);
    }
  };
  found.paving = locate(question, options, &interrupt);
  return found;
}

/// Copies the boxes as an array of the shape (boxes, variables, 2).
py::array_t<double> array_of_bounds(const PavingWithBoxes& p) {
  const auto variables = static_cast<py::ssize_t>(p.paving.variables.size());
  const auto boxes = static_cast<py::ssize_t>(p.claims.size());
  return py::array_t<double>(std::vector<py::ssize_t>{boxes, variables, 2}, p.bounds.data());
}

/// The stretches of a motion along way-points, as JSON.
std::vector<std::string> stretches_of(const PavingWithBoxes& p) {
  std::vector<std::string> texts;
  for (const Stretch& stretch : p.paving.stretches) texts.push_back(stretch.json);
  return texts;
}

}  // namespace

void bind_pavings(py::module_& module) {
  py::class_<PavingWithBoxes>(module, "PavingFinding")
      .def_property_readonly(
          "verdict", [](const PavingWithBoxes& p) { return word_of_verdict(p.paving.verdict); })
      .def_property_readonly(
          "reason", [](const PavingWithBoxes& p) { return describe(p.paving.result.reason); })
      .def_property_readonly("variables",
                             [](const PavingWithBoxes& p) { return p.paving.variables; })
      .def_property_readonly("report", [](const PavingWithBoxes& p) { return p.paving.report; })
      .def_property_readonly("json", [](const PavingWithBoxes& p) { return p.paving.json; })
      .def_property_readonly("stretches", stretches_of)
      .def_property_readonly("certificate",
                             [](const PavingWithBoxes& p) { return p.paving.certificate; })
      .def_property_readonly("no_certificate",
                             [](const PavingWithBoxes& p) { return p.paving.no_certificate; })
      .def("claims",
           [](const PavingWithBoxes& p) {
             return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(p.claims.size()),
                                              p.claims.data());
           })
      .def("bounds", array_of_bounds);
  module.attr("CLAIMS") =
      py::make_tuple(name(Claim::kFree), name(Claim::kSingular), name(Claim::kUndecided),
                     name(Claim::kOutside), name(Claim::kUnreachable));
  module.def(
      "locate",
      [](const Question& question, const SearchOptions& options, const std::string& resolution,
         const std::string& path, std::uint64_t shard_size) {
        return run_there([=](const std::atomic<bool>& interrupt) {
          return locate_boxes(question, options, resolution, path, shard_size, interrupt);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("resolution") = "",
      py::arg("certificate") = "", py::arg("shard_size") = 0);
}

}  // namespace regulus::detail
