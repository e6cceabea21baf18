// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/python/solutions.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "codegen/use/api/regulus.hpp"
#include "codegen/use/python/calls.hpp"

namespace regulus::detail {
namespace {

namespace py = pybind11;

const char* word_of_limits(WithinLimits limits) {
  switch (limits) {
    case WithinLimits::kWithin:
      return "within";
    case WithinLimits::kBeyond:
      return "beyond";
    case WithinLimits::kUnknown:
      return "border";
    case WithinLimits::kNoLimits:
      break;
  }
  return "none";
}

const char* word_of_solutions(const Solutions& s) {
  if (s.completeness != Completeness::kComplete) return "incomplete";
  return s.found.empty() ? "none" : "complete";
}

/// The enclosures as an array of the shape (solutions, unknowns, 2).
py::array_t<double> array_of_enclosures(const Solutions& s) {
  std::vector<double> bounds;
  for (const CertainSolution& one : s.found)
    for (const Interval& value : one.values) {
      bounds.push_back(value.lo);
      bounds.push_back(value.hi);
    }
  return py::array_t<double>(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(s.found.size()),
                               static_cast<py::ssize_t>(s.unknowns.size()), 2},
      bounds.data());
}

/// A number of each solution.
template <class Number, class Of>
py::array_t<Number> array_of(const Solutions& s, const Of& of) {
  std::vector<Number> numbers;
  for (const CertainSolution& one : s.found) numbers.push_back(of(one));
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

template <class Of>
auto by_unknown(const Of& of) {
  return [of](const Solutions& s) {
    std::vector<std::string> words;
    for (const SolvedUnknown& unknown : s.unknowns) words.push_back(of(unknown));
    return words;
  };
}

void bind_solve_findings(py::module_& module) {
  py::class_<Solutions>(module, "Solutions")
      .def_property_readonly("verdict", word_of_solutions)
      .def_property_readonly("unknowns", by_unknown([](const auto& u) { return u.name; }))
      .def_property_readonly("units", by_unknown([](const auto& u) { return u.unit; }))
      .def_readonly("how", &Solutions::how)
      .def_readonly("obstacle", &Solutions::obstacle)
      .def_readonly("boxes", &Solutions::boxes)
      .def("enclosures", array_of_enclosures)
      .def("signs",
           [](const Solutions& s) {
             return array_of<std::int8_t>(
                 s, [](const CertainSolution& one) { return static_cast<std::int8_t>(one.sign); });
           })
      .def("conditions",
           [](const Solutions& s) {
             return array_of<double>(s, [](const CertainSolution& one) { return one.condition; });
           })
      .def("limits", [](const Solutions& s) {
        std::vector<std::string> words;
        for (const CertainSolution& one : s.found) words.emplace_back(word_of_limits(one.limits));
        return words;
      });
  py::class_<SolveFinding>(module, "SolveFinding")
      .def_readonly("solutions", &SolveFinding::solutions)
      .def_readonly("headline", &SolveFinding::headline)
      .def_readonly("report", &SolveFinding::report)
      .def_readonly("json", &SolveFinding::json)
      .def_readonly("seconds", &SolveFinding::seconds)
      .def_readonly("certificate", &SolveFinding::certificate)
      .def_readonly("no_certificate", &SolveFinding::no_certificate);
  py::class_<SolveManyFinding>(module, "SolveManyFinding")
      .def("solutions",
           [](const SolveManyFinding& f) {
             std::vector<Solutions> all;
             for (const SolvedPlace& place : f.places) all.push_back(place.solutions);
             return all;
           })
      .def_readonly("left", &SolveManyFinding::left)
      .def_readonly("headline", &SolveManyFinding::headline)
      .def_readonly("report", &SolveManyFinding::report)
      .def_readonly("json", &SolveManyFinding::json)
      .def_readonly("seconds", &SolveManyFinding::seconds)
      .def_readonly("certificate", &SolveManyFinding::certificate)
      .def_readonly("no_certificate", &SolveManyFinding::no_certificate);
}

}  // namespace

void bind_solutions(py::module_& module) {
  bind_solve_findings(module);
  module.def(
      "solve",
      [](const Question& question, const SearchOptions& search, const std::vector<std::string>& at,
         const std::vector<std::string>& hold, const std::string& certificate) {
        const SolveOptions options{search, at, hold, certificate, 0};
        return run_there([=](const std::atomic<bool>& interrupt) {
          return solve(question, options, &interrupt);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("at"), py::arg("hold"),
      py::arg("certificate") = "");
  module.def(
      "solve_many",
      [](const Question& question, const SearchOptions& search, const std::vector<std::string>& at,
         const std::vector<std::string>& hold, const std::vector<std::vector<std::string>>& numbers,
         const std::string& table, const std::string& certificate, std::uint64_t shard_size) {
        const SolveOptions options{search, at, hold, certificate, shard_size};
        const Places places{numbers, table};
        return run_there([=](const std::atomic<bool>& interrupt) {
          return solve_many(question, places, options, &interrupt);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("at"), py::arg("hold"), py::arg("numbers"),
      py::arg("table"), py::arg("certificate") = "", py::arg("shard_size") = 0);
}

}  // namespace regulus::detail
