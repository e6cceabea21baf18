// SPDX-License-Identifier: GPL-3.0-or-later
// Replays the boxes of a real search in virtual time, on more ranks than any machine here has, and
// prints the table of SCALE.md.
#include <fmt/format.h>

#include <array>
#include <string>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/scale/replay.hpp"

namespace {

using namespace regulus;
using namespace regulus::detail;

/// So many boxes share their time in the record. With fewer, the kernel would have empty lanes.
constexpr std::uint64_t kBoxesOfTime = 64;

/// Robot 2 with wider angles than those of the paper: close to its singularities, so long.
struct Question {
  std::string model = "robot_2", motion = "table5_30", degrees;
};

Result record(const Question& question, bench::Trace& trace) {
  ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/" + question.model + ".toml";
  model.motion = question.motion;
  for (const char* angle : {"psi", "theta", "phi"})
    model.ranges.push_back(fmt::format("{0}=-{1}*deg:{1}*deg", angle, question.degrees));
  bench::RecordingWorkers recording(trace);
  SearchOptions options;
  options.method = Method::kReg;
  options.workers = &recording;
  PreparedSearch prepared = prepare(model, options);
  Settings settings = settings_of(prepared, options, nullptr);
  settings.boxes_of_unit = kBoxesOfTime;
  return run_search(prepared, options, settings);
}

/// A unit takes 10 to 20 ms, as units of searches do, if a box is not longer than that.
constexpr std::array kJobs = {bench::Job{64, 60, 64}, bench::Job{256, 60, 16},
                              bench::Job{1024, 60, 4}, bench::Job{10240, 600, 1}};

void replay(const bench::Trace& trace, const bench::Job& job) {
  const bench::Replayed r = bench::Replay(trace, job).run();
  const double ranks = static_cast<double>(job.ranks), messages = static_cast<double>(r.messages);
  fmt::print(
      "| {} | {} | {} | {:.3g} ms | {:.2f} s | {:.3f} | {:.0f} | {:.0f} % | {:.1f} µs | {} | "
      "{:.0f} MB |\n",
      job.ranks, job.seconds, job.unit, 1e3 * r.busy / static_cast<double>(r.units), r.seconds,
      r.busy / (ranks * r.seconds), messages / r.seconds, 100 * messages * job.message / r.seconds,
      1e6 * r.own_seconds / messages, r.most_known, r.most_megabytes);
  std::fflush(stdout);
}

}  // namespace

/// scale [DEGREES [RANKS]]: the angles of the search, and the only row to make.
int main(int argc, char** argv) {
  const Question question{.degrees = argc > 1 ? argv[1] : "35.4"};
  bench::Trace trace;
  const double before = bench::thread_seconds();
  const Result result = record(question, trace);
  const double rest = bench::thread_seconds() - before - trace.seconds;
  const auto boxes = static_cast<double>(trace.boxes.size() - 1);
  fmt::print(
      "{} {} ±{}°: {}, {} boxes, {} of them in units, which take {:.1f} s, {:.2f} µs a box, "
      "and {:.2f} µs a box for all else\n\n",
      question.model, question.motion, question.degrees, name(result.verdict),
      result.statistics.boxes, trace.boxes.size() - 1, trace.seconds, 1e6 * trace.seconds / boxes,
      1e6 * rest / boxes);
  std::fflush(stdout);
  fmt::print(
      "| ranks | seconds of work each | boxes of a unit | mean unit | end after | efficiency | "
      "messages a second | rank 0 busy | processor time a message | units known | memory |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  const std::string ranks = argc > 2 ? argv[2] : "";
  for (const bench::Job& job : kJobs)
    if (ranks.empty() || ranks == std::to_string(job.ranks)) replay(trace, job);
}
