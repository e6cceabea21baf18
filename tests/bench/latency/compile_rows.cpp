// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "codegen/kernel/cpp/emit.hpp"
#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "tests/bench/kernel/subject.hpp"
#include "tests/bench/latency/rows.hpp"
#include "tests/support/spawned_compiler.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::bench {
namespace {

/// A kernel, and the target of the ratio: compiling in process against spawning a compiler for its
/// text.
struct Subject {
  const char* name;
  const char* explanation;
  Module module;
  std::optional<Target> target;
};

Module robot_1(const FormulationOptions& functions) {
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  options.motion = "wide_15";
  const Request request = read_request(options);
  return lower(formulate(request.model, request.motion, functions));
}

std::vector<Subject> subjects() {
  Settings derivatives;
  derivatives.entries = Entries::kDerivatives;
  return {{"values", "A and K·M, nothing else", kernel_subject(), ratio_at_least(15)},
          {"values and derivatives", "what `check --method kj` compiles",
           robot_1(functions_needed(Method::kKj, derivatives)), ratio_at_least(4)},
          {"second order", "what `check` compiles", robot_1(functions_needed(Method::kAuto)), {}}};
}

void add_rows(const Subject& subject, Section& section) {
  const test::TemporaryDirectory directory;
  CompileOptions options;
  options.isa = best_isa();
  options.use_cache = false;
  const machine::PackKernel program = select(subject.module);
  const EmittedKernel text = emit(subject.module);
  const Contender contenders[] = {
      {"in process", 1, [&] { static_cast<void>(compile_kernel(program, options)); }},
      {"spawned", 1, [&] {
         static_cast<void>(
             test::compile_with_spawned("g++", text.source, options.isa, directory.path()));
       }}};
  RoundOptions rounds;
  rounds.rounds = 5;
  rounds.slice = 0;
  rounds.clock = wall_seconds;
  const std::vector<Timing> timings = compare(contenders, rounds);

  const auto lines = std::count(text.source.begin(), text.source.end(), '\n');
  section.rows.push_back(
      timed_row(fmt::format("{}, in process", subject.name), timings[0], 1e3, "ms",
                fmt::format("{}: {} lines; machine code in memory, ready to be called",
                            subject.explanation, lines)));
  section.rows.push_back(timed_row(fmt::format("{}, `g++`", subject.name), timings[1], 1e3, "ms",
                                   "`g++ -O2 -shared -fPIC` as a process, then dlopen"));
  section.rows.back().target = subject.target;
}

}  // namespace

Section compile_rows() {
  Section section{"compile",
                  "From text to machine code",
                  fmt::format("The same text for {}, without a cache, on the wall; the compiler in "
                              "process has been loaded. The ratio is to the row above.",
                              name(best_isa())),
                  {}};
  if (!test::is_installed("g++")) {
    section.rows = {skipped_row("in process against `g++`", "g++ was not found", "")};
    return section;
  }
  // The rows of whole processes include the extra cost of the first compilation.
  CompileOptions options;
  options.isa = best_isa();
  options.use_cache = false;
  static_cast<void>(rounding_self_test(options));
  for (const Subject& subject : subjects()) add_rows(subject, section);
  return section;
}

}  // namespace regulus::detail::bench
