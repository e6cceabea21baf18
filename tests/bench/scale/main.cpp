// SPDX-License-Identifier: GPL-3.0-or-later
// Replays the units of a real search in virtual time, on more ranks than any machine here has, and
// prints the table of SCALE.md. All grants and answers pass through the real supervisor.
#include <fmt/format.h>

#include <string>

#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/scale/replay.hpp"

namespace {

using namespace regulus;

struct Job {
  std::size_t ranks;
  double seconds;  ///< of work for each
};

struct Question {
  std::string model, motion;
  Method method;
  std::uint64_t boxes_of_unit;
};

Result search(const Question& question, cluster::Workers& workers) {
  ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/" + question.model + ".toml";
  model.motion = question.motion;
  SearchOptions options;
  options.method = question.method;
  options.workers = &workers;
  PreparedSearch prepared = prepare(model, options);
  Settings settings = settings_of(prepared, options, nullptr);
  settings.boxes_of_unit = question.boxes_of_unit;
  return run_search(prepared, options, settings);
}

void replay(const Question& question, const bench::Trace& trace, const Job& job) {
  const auto ranks = static_cast<double>(job.ranks);
  const double slower = ranks * job.seconds / trace.seconds;
  bench::ReplayedRanks workers(trace, job.ranks, slower, {});
  const double before = bench::thread_seconds();
  static_cast<void>(search(question, workers));
  const double own = bench::thread_seconds() - before;
  fmt::print("| {} | {} | {:.1f} ms | {:.1f} s | {:.3f} | {:.0f} | {:.1f} µs |\n", job.ranks,
             job.seconds, 1e3 * slower * trace.seconds / static_cast<double>(trace.units.size()),
             workers.now(), workers.busy() / (ranks * workers.now()),
             static_cast<double>(workers.messages()) / workers.now(),
             1e6 * own / static_cast<double>(workers.messages()));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t boxes_of_unit = argc > 1 ? std::stoul(argv[1]) : 1;
  const Question question{"robot_2", "table5_30", Method::kReg, boxes_of_unit};
  bench::Trace trace;
  bench::RecordingWorkers recording(trace);
  const Result result = search(question, recording);
  fmt::print("{} {}: {}, {} boxes, {} units of up to {} boxes, {:.1f} s\n\n", question.model,
             question.motion, name(result.verdict), result.statistics.boxes, trace.units.size(),
             boxes_of_unit + 7, trace.seconds);
  fmt::print(
      "| ranks | seconds of work each | mean unit | end after | efficiency | messages a second | "
      "processor time a message |\n|---|---|---|---|---|---|---|\n");
  for (const Job& job : {Job{64, 60}, {1024, 60}, {10240, 600}}) replay(question, trace, job);
}
