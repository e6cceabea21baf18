// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/shared_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/model/names.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/command/number_check.hpp"

namespace regulus::detail {
namespace {

/// Adds an option that takes one of a few words; the message about a mistyped word suggests one.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::string& description) {
  const CLI::Validator known(
      [name](const std::string& word) -> std::string {
        try {
          static_cast<void>(choice_of<Value>(name.c_str(), word));
          return "";
        } catch (const UsageError& error) {
          const std::string text = error.what();
          return text.substr(text.find(": ") + 2);  // CLI11 puts the option's name before it
        }
      },
      "");
  CLI::Option* option = app.add_option_function<std::string>(
      name,
      [name, &value](const std::string& word) { value = choice_of<Value>(name.c_str(), word); },
      description);
  return option->check(known)->check(CLI::IsMember(words_of<Value>()))->default_str(word_of(value));
}

/// Checks the name of an ingredient; the message about a mistyped one suggests a name.
CLI::Validator known_ingredient() {
  return {[](const std::string& word) -> std::string {
            const std::vector<std::string> known = ingredient_names();
            if (std::ranges::find(known, word) != known.end()) return "";
            return "there is no " + in_quotes(word) + "; " +
                   suggestion(word, known, fmt::format("it can be {}", fmt::join(known, ", ")));
          },
          ""};
}

void add_bisect_options(CLI::App& app, SearchOptions& options) {
  add_choice(app, "--bisect", options.bisection, "Which range is split");
  app.add_option(
         "--weight", options.weights,
         "With --bisect weighted: a factor for the width of a range relative to the whole of "
         "it; the widest is split. Not named: 1")
      ->take_all()
      ->expected(1)
      ->type_name("NAME=W");
}

}  // namespace

void add_model_arguments(CLI::App& app, ModelOptions& options) {
  app.add_option("MODEL", options.path, "Model file (TOML), or the name of an installed model")
      ->required();
  app.add_option("MOTION", options.motion, "Motion; optional if the model has only one");
}

void add_model_options(CLI::App& app, ModelOptions& options) {
  add_model_arguments(app, options);
  add_model_changes(app, options);
}

void add_waypoint_options(CLI::App& app, ModelOptions& options) {
  app.add_option("--waypoints", options.waypoints,
                 "Follow the way-points of FILE (CSV, or moves in G-code) instead of the motion's "
                 "own poses; the motion gives the pose parameters that the file does not")
      ->type_name("FILE");
  app.add_option("--tube", options.tubes,
                 "Control error around the motion, ± on each pose parameter that is named: "
                 "x,y=0.1; without names, on all, if they have one unit")
      ->take_all()
      ->expected(1)
      ->type_name("p=E");
}

void add_method_options(CLI::App& app, Method& method, std::uint64_t& budget) {
  add_choice(app, "--method", method, "Method that decides a box");
  app.add_option("--symbolic-budget", budget,
                 "Limit on the terms of the polynomial of --method closed-form; the default takes "
                 "about one "
                 "second")
      ->check(whole_number(1))
      ->type_name("TERMS")
      ->capture_default_str();
}

void add_filter_option(CLI::App& app, SearchOptions& options) {
  app.add_option("--filter", options.filters,
                 "Shared object with your own regularity test, used on the boxes that the method "
                 "leaves undecided; the report names it (regulus/filter.h)")
      ->take_all()
      ->expected(1)
      ->type_name("FILE.so");
}

void add_kernel_option(CLI::App& app, SearchOptions& options) {
  app.add_option("--kernel", options.kernel,
                 "Search with the functions of FILE.cpp, which explain --stage text wrote and you "
                 "have edited; Clang compiles them, and the claim is about them")
      ->type_name("FILE.cpp")
      ->excludes("--engine");
}

void add_search_options(CLI::App& app, SearchOptions& options) {
  add_method_options(app, options.method, options.symbolic_budget);
  add_choice(app, "--determinant", options.determinant,
             "How the determinant of an interval matrix is enclosed: by expansion, by Gaussian "
             "elimination, or by expansion first and elimination if that decides nothing (both)");
  add_choice(app, "--entries", options.entries,
             "How a method of the paper encloses the entries of its matrix: as rewritten "
             "(natural), or also narrowed by their derivatives; auto: with derivatives for K·J^-1 "
             "and if uncertain quantities are split");
  add_bisect_options(app, options);
  add_choice(app, "--uncertainty", options.uncertainty,
             "Uncertain quantities: kept whole in the matrix elements, or split like variables");
  app.add_option("--without", options.without,
                 "Switch off a part of the method, to see its effect; may be repeated; the result "
                 "stays sound but slower:" +
                     describe_ingredient())
      ->take_all()
      ->expected(1)
      ->check(known_ingredient())
      ->type_name("NAME");
  add_choice(
      app, "--engine", options.engine,
      "How the model's functions run: compiled by LLVM (jit, margin's default), compiled from "
      "their C++ text by Clang (clang), interpreted, or taken from the cache if it has them, else "
      "interpreted and compiled during a long search (auto, the default of other commands)")
      ->default_str("");
  add_choice(app, "--isa", options.isa,
             "Instruction set of the kernel; default: the best of this processor");
  app.add_option("--threads", options.threads, "Use N threads; default: one for each processor")
      ->type_name("N")
      ->check(whole_number(1, kMaxThreads));
  app.add_option(
         "--max-boxes", options.max_boxes,
         "Evaluate at most N boxes; the search may stop up to an eighth earlier, because it "
         "evaluates boxes in rounds")
      ->check(whole_number(1))
      ->type_name("N");
  app.add_option("--time-limit", options.time_limit, "Stop after S seconds")
      ->check(positive_seconds())
      ->type_name("S");
  app.add_option("--precision", options.precision,
                 "Limit on the bits of precision that are used if doubles cannot decide")
      ->check(whole_number(53, 1U << 20))
      ->type_name("BITS")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-cache", [&options] { options.use_cache = false; }, "Do not read or write the cache");
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  app.add_flag("--json", options.json, "Print the report on standard output, as one JSON object");
  app.add_flag("--quiet", options.quiet, "Print only the verdict (or the JSON report)");
}

void add_page_option(CLI::App& app, OutputOptions& options) {
  app.add_option("--page", options.page,
                 "Write a page of the answer, for any browser, offline: the robot, the claim, the "
                 "proof or the bars. An earlier FILE.html is renamed to FILE.html.old")
      ->type_name("FILE.html");
}

void add_checkpoint_options(CLI::App& app, CheckpointOptions& options) {
  app.add_option(
         "--checkpoint", options.path,
         "Save the search to FILE regularly and when it stops; if FILE exists, continue from it")
      ->type_name("FILE");
  app.add_option("--checkpoint-every", options.interval, "Seconds between two saves; default 10")
      ->type_name("S")
      ->check(number_from_zero("a number of seconds"));
}

void add_bracket_checkpoint(CLI::App& app, std::string& path) {
  app.add_option("--checkpoint", path,
                 "Save the outcome of each search to FILE when it ends; if FILE exists, continue "
                 "from it, and prove the ends of each bracket again")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--checkpoint-every",
         [](const std::string&) {
           throw CLI::ValidationError(
               "--checkpoint-every",
               "a bound needs no interval: each search is saved when it ends, or about every "
               "ten seconds");
         })
      ->group("");
}

}  // namespace regulus::detail
