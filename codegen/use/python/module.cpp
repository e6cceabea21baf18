// SPDX-License-Identifier: GPL-3.0-or-later
// regulus._regulus: regulus/regulus.hpp for Python. Numbers are exact texts here; the package around
// it (regulus/) makes them of Python's numbers, and reads the reports.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "codegen/question/engine/choices.hpp"
#include "codegen/support/write_file.hpp"
#include "codegen/use/api/regulus.hpp"
#include "codegen/use/python/calls.hpp"
#include "codegen/use/python/loads.hpp"
#include "codegen/use/python/pavings.hpp"
#include "codegen/use/python/solutions.hpp"
#include "codegen/use/python/words.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
namespace {

namespace py = pybind11;

const char* word_of_outcome(ProofOutcome outcome) {
  switch (outcome) {
    case ProofOutcome::kVerified:
      return "verified";
    case ProofOutcome::kRejected:
      return "rejected";
    case ProofOutcome::kUnfinished:
      break;
  }
  return "unfinished";
}

const char* word_of_bound(BoundVerdict verdict) {
  switch (verdict) {
    case BoundVerdict::kWithin:
      return "within";
    case BoundVerdict::kExceeded:
      return "exceeded";
    case BoundVerdict::kUndecided:
      return "possible-problem";
    case BoundVerdict::kBracket:
      break;
  }
  return "";
}

/// A prepared question that the algebra thread makes, uses and destroys.
class PreparedHandle {
 public:
  explicit PreparedHandle(std::shared_ptr<PreparedQuestion> question)
      : question_(std::move(question)) {}
  PreparedHandle(PreparedHandle&&) noexcept = default;
  PreparedHandle(const PreparedHandle&) = delete;
  PreparedHandle& operator=(const PreparedHandle&) = delete;
  PreparedHandle& operator=(PreparedHandle&&) = delete;
  ~PreparedHandle() {
    if (!question_) return;
    // The destructor of the last reference runs there, and this thread does not wait for it.
    auto* const last = new std::shared_ptr<PreparedQuestion>(std::move(question_));
    try {
      static_cast<void>(
          AlgebraThread::of_this_process().add([last](const std::atomic<bool>&) { delete last; }));
    } catch (const std::exception&) {
      // A process that was forked at the wrong moment has no thread that may destroy it.
    }
  }

  [[nodiscard]] const std::shared_ptr<PreparedQuestion>& question() const { return question_; }

 private:
  std::shared_ptr<PreparedQuestion> question_;
};

PreparedHandle prepare_question(const Question& question, const SearchOptions& options) {
  return run_there([question, options](const std::atomic<bool>& interrupt) {
    return PreparedHandle(std::make_shared<PreparedQuestion>(question, options, &interrupt));
  });
}

Finding check_prepared(const PreparedHandle& prepared, const Question& question,
                       std::uint64_t max_boxes, double time_limit, unsigned threads) {
  return run_there([to = prepared.question(), question, max_boxes, time_limit,
                    threads](const std::atomic<bool>& interrupt) {
    return to->check(question, {max_boxes, time_limit, threads}, &interrupt);
  });
}

Finding describe_prepared(const PreparedHandle& prepared, const Question& question,
                          const Finding& finding, std::uint64_t max_boxes, double time_limit,
                          unsigned threads) {
  return run_there([to = prepared.question(), question, finding, max_boxes, time_limit,
                    threads](const std::atomic<bool>&) {
    Finding described = finding;
    to->describe(question, described, {max_boxes, time_limit, threads});
    return described;
  });
}

/// Binds an option whose values are words.
template <class Value>
void word_option(py::class_<SearchOptions>& options, const char* name,
                 Value SearchOptions::*member) {
  options.def_property(
      name, [member](const SearchOptions& o) { return word_of(o.*member); },
      [member, name](SearchOptions& o, const std::string& word) {
        o.*member = choice_of<Value>(name, word);
      });
}

void bind_questions(py::module_& module) {
  py::class_<Question>(module, "Question")
      .def(py::init(&Question::of_text), py::arg("text"), py::arg("name"), py::arg("motion") = "")
      .def("copy", [](const Question& q) { return Question(q); })
      .def(
          "range",
          [](Question& q, const std::string& p, const std::string& lo, const std::string& hi) {
            q.range(p, lo, hi);
          },
          py::arg("parameter"), py::arg("lower"), py::arg("upper"))
      .def(
          "tolerance",
          [](Question& q, const std::string& g, const std::string& t) { q.tolerance(g, t); },
          py::arg("groups"), py::arg("tolerance"))
      .def(
          "tube", [](Question& q, const std::string& p, const std::string& e) { q.tube(p, e); },
          py::arg("parameters"), py::arg("error"))
      .def("beyond_limits", [](Question& q) { q.beyond_limits(); })
      .def(
          "waypoints", [](Question& q, const std::string& file) { q.waypoints(file); },
          py::arg("file"))
      .def(
          "alpha", [](Question& q, const std::string& a) { q.alpha(a); }, py::arg("threshold"));
  py::class_<QuantityOptions>(module, "QuantityOptions")
      .def(py::init([](const std::string& quantity, const std::string& load,
                       const std::string& twist, const std::string& leg, const std::string& freedom,
                       bool least, bool is_signed, const std::string& norm, bool is_finite) {
             return QuantityOptions{quantity, load,      twist, leg,      freedom,
                                    least,    is_signed, norm,  is_finite};
           }),
           py::arg("quantity"), py::arg("load"), py::arg("twist"), py::arg("leg"),
           py::arg("freedom"), py::arg("least"), py::arg("signed"), py::arg("norm"),
           py::arg("finite") = false);
}

void bind_options(py::module_& module) {
  py::class_<SearchOptions> options(module, "SearchOptions");
  options.def(py::init<>())
      .def_readwrite("use_cache", &SearchOptions::use_cache)
      .def_readwrite("filters", &SearchOptions::filters)
      .def_readwrite("kernel", &SearchOptions::kernel)
      .def_readwrite("without", &SearchOptions::without)
      .def_readwrite("weights", &SearchOptions::weights)
      .def_readwrite("max_boxes", &SearchOptions::max_boxes)
      .def_readwrite("threads", &SearchOptions::threads)
      .def_readwrite("time_limit", &SearchOptions::time_limit)
      .def_readwrite("symbolic_budget", &SearchOptions::symbolic_budget)
      .def_readwrite("precision", &SearchOptions::precision);
  word_option(options, "method", &SearchOptions::method);
  word_option(options, "determinant", &SearchOptions::determinant);
  word_option(options, "entries", &SearchOptions::entries);
  word_option(options, "bisect", &SearchOptions::bisection);
  word_option(options, "uncertainty", &SearchOptions::uncertainty);
  word_option(options, "engine", &SearchOptions::engine);
  word_option(options, "isa", &SearchOptions::isa);
}

void bind_findings(py::module_& module) {
  py::class_<Finding>(module, "Finding")
      .def_property_readonly("verdict", [](const Finding& f) { return word_of_verdict(f.verdict); })
      .def_property_readonly("reason", [](const Finding& f) { return describe(f.result.reason); })
      .def_property_readonly("boxes", [](const Finding& f) { return f.result.statistics.boxes; })
      .def_readonly("claim", &Finding::claim)
      .def_readonly("report", &Finding::report)
      .def_readonly("json", &Finding::json)
      .def_readonly("seconds", &Finding::seconds)
      .def_readonly("certificate", &Finding::certificate)
      .def_readonly("no_certificate", &Finding::no_certificate);
  py::class_<MarginFinding>(module, "MarginFinding")
      .def_readonly("safe", &MarginFinding::safe)
      .def_readonly("singular", &MarginFinding::singular)
      .def_readonly("exceeded", &MarginFinding::exceeded)
      .def_readonly("closed", &MarginFinding::closed)
      .def_readonly("bracket", &MarginFinding::bracket)
      .def_readonly("report", &MarginFinding::report)
      .def_readonly("json", &MarginFinding::json);
  py::class_<BoundFinding>(module, "BoundFinding")
      .def_property_readonly("verdict",
                             [](const BoundFinding& f) { return word_of_bound(f.verdict); })
      .def_readonly("attained", &BoundFinding::attained)
      .def_readonly("proved", &BoundFinding::proved)
      .def_readonly("closed", &BoundFinding::closed)
      .def_readonly("unit", &BoundFinding::unit)
      .def_readonly("result", &BoundFinding::result)
      .def_readonly("report", &BoundFinding::report)
      .def_readonly("json", &BoundFinding::json);
  py::class_<Confirmation>(module, "Confirmation")
      .def_property_readonly("outcome",
                             [](const Confirmation& c) { return word_of_outcome(c.outcome); })
      .def_readonly("claim", &Confirmation::claim)
      .def_readonly("reason", &Confirmation::reason)
      .def_readonly("json", &Confirmation::json);
}

void bind_prepared(py::module_& module) {
  py::class_<PreparedHandle>(module, "PreparedQuestion")
      .def("check", check_prepared, py::arg("question"), py::arg("max_boxes") = 0,
           py::arg("time_limit") = 0.0, py::arg("threads") = 0)
      .def("describe", describe_prepared, py::arg("question"), py::arg("finding"),
           py::arg("max_boxes") = 0, py::arg("time_limit") = 0.0, py::arg("threads") = 0);
  module.def("prepare", prepare_question, py::arg("question"), py::arg("options"));
}

void bind_searches(py::module_& module) {
  module.def(
      "check",
      [](const Question& question, const SearchOptions& options, const std::string& path,
         std::uint64_t shard_size) {
        return run_there([=](const std::atomic<bool>& interrupt) {
          return check(question, options, &interrupt, path, shard_size);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("certificate") = "",
      py::arg("shard_size") = 0);
  module.def(
      "margin",
      [](const Question& question, const SearchOptions& search, const std::string& tolerance,
         const std::string& alpha, const std::string& scale, const std::string& parameter,
         const std::string& gap, const QuantityOptions& quantity, const std::string& limit,
         const std::string& path, std::uint64_t shard_size, const std::string& tube) {
        const MarginOptions options{search,   tolerance, alpha, scale,      parameter, gap,
                                    quantity, limit,     path,  shard_size, tube};
        return run_there([=](const std::atomic<bool>& interrupt) {
          return margin(question, options, &interrupt);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("tolerance"), py::arg("alpha"),
      py::arg("scale"), py::arg("parameter"), py::arg("gap"), py::arg("quantity"), py::arg("limit"),
      py::arg("certificate") = "", py::arg("shard_size") = 0, py::arg("tube") = "");
  module.def(
      "bound",
      [](const Question& question, const SearchOptions& search, const QuantityOptions& quantity,
         const std::string& limit, const std::string& gap, const std::string& path,
         std::uint64_t shard_size) {
        const BoundOptions options{search, quantity, limit, gap, path, shard_size};
        return run_there([=](const std::atomic<bool>& interrupt) {
          return bound(question, options, &interrupt);
        });
      },
      py::arg("question"), py::arg("options"), py::arg("quantity"), py::arg("limit"),
      py::arg("gap"), py::arg("certificate") = "", py::arg("shard_size") = 0);
}

void bind_import(py::module_& module) {
  module.def(
      "import_file",
      [](const std::string& path, const std::string& base, const std::string& tip,
         const std::vector<std::string>& cuts, const std::vector<std::string>& welds,
         const std::vector<std::string>& actuated, const std::vector<std::string>& at, bool closure,
         const std::string& snap) {
        const ImportOptions options{.base = base,
                                    .tip = tip,
                                    .cuts = cuts,
                                    .welds = welds,
                                    .actuated = actuated,
                                    .at = at,
                                    .closure = closure,
                                    .snap = snap};
        const Imported imported =
            run_there([=](const std::atomic<bool>&) { return import_file(path, options); });
        return std::pair(imported.model, imported.report());
      },
      py::arg("path"), py::arg("base"), py::arg("tip"), py::arg("cuts"), py::arg("welds"),
      py::arg("actuated"), py::arg("at"), py::arg("closure"), py::arg("snap"));
}

void bind_files(py::module_& module) {
  module.def(
      "write_page",
      [](const Question& question, const std::string& kind, const std::string& headline,
         const std::string& report, const std::string& json, const std::string& certificate,
         const std::string& page_template, const std::string& path) {
        const PageContents contents{kind, headline, report, json, certificate, "", page_template};
        run_there([=](const std::atomic<bool>&) {
          write_page(question, contents, path);
          return true;
        });
      },
      py::arg("question"), py::arg("kind"), py::arg("headline"), py::arg("report"), py::arg("json"),
      py::arg("certificate"), py::arg("page_template"), py::arg("path"));
  module.def(
      "robot_picture",
      [](const Question& question) {
        return run_there([=](const std::atomic<bool>&) { return robot_picture(question); });
      },
      py::arg("question"));
  module.def(
      "verify",
      [](const std::string& path, const std::string& model, const std::string& waypoints,
         unsigned threads, double time_limit, std::uint64_t max_boxes, bool allow_options) {
        const VerifyOptions options{model,      waypoints, threads,
                                    time_limit, max_boxes, allow_options};
        return run_there([=](const std::atomic<bool>&) { return verify(path, options); });
      },
      py::arg("path"), py::arg("model"), py::arg("waypoints"), py::arg("threads"),
      py::arg("time_limit"), py::arg("max_boxes"), py::arg("allow_options"));
  module.def(
      "write_file",
      [](const py::bytes& path, const std::string& text) { write_file(std::string(path), text); },
      py::arg("path"), py::arg("text"));
  module.def(
      "describe_model",
      [](const Question& question) {
        return run_there([=](const std::atomic<bool>&) { return describe_model(question); });
      },
      py::arg("question"));
}

/// Throws the class of regulus.errors with the parts of the message.
void throw_input_error(const InputError& error) {
  const py::object type = py::module_::import("regulus.errors").attr("InputError");
  const py::object thrown = type(error.what(), error.file(), error.line(), error.found(),
                                 error.expected(), error.symbol());
  PyErr_SetObject(type.ptr(), thrown.ptr());
}

void throw_error(const char* type, const char* what) {
  PyErr_SetString(py::module_::import("regulus.errors").attr(type).ptr(), what);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    throw_input_error(error);
  } catch (const UsageError& error) {
    throw_error("UsageError", error.what());
  } catch (const FileError& error) {
    throw_error("FileError", error.what());
  } catch (const ReadingStopped& stopped) {
    throw_error("UsageError", stopped.what());
  } catch (const CompileError& error) {
    throw_error("CompileError", error.what());
  } catch (const InternalError& error) {
    throw_error("InternalError", error.what());
  }
}

}  // namespace
}  // namespace regulus::detail

PYBIND11_MODULE(_regulus, module) {
  using namespace regulus;
  using namespace regulus::detail;
  module.doc() = "regulus/regulus.hpp for Python; the package regulus is the interface.";
  module.attr("VERSION") = regulus::kVersion;
  pybind11::register_exception_translator(translate);
  bind_questions(module);
  bind_options(module);
  bind_findings(module);
  bind_pavings(module);
  bind_prepared(module);
  bind_searches(module);
  bind_loads(module);
  bind_solutions(module);
  bind_import(module);
  bind_files(module);
  // The thread must not be at work while the process takes its libraries down.
  pybind11::module_::import("atexit").attr("register")(
      pybind11::cpp_function([] { AlgebraThread::stop_in_this_process(); }));
}
