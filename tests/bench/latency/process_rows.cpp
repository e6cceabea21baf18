// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/latency/rows.hpp"
#include "tests/bench/measure/process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::bench {
namespace {

/// Runs the command with a cache of its own.
class Command {
 public:
  Command(std::vector<std::string> arguments, const test::TemporaryDirectory& cache)
      : words_{REGULUS_COMMAND}, cache_("XDG_CACHE_HOME=" + cache.path().string()) {
    words_.insert(words_.end(), arguments.begin(), arguments.end());
  }

  void run() const { static_cast<void>(run(words_)); }

  /// Returns the median of a few runs.
  [[nodiscard]] double peak_megabytes() const {
    constexpr int kRuns = 3;
    constexpr double kKilobytes = 1024;
    std::vector<std::string> measured = {REGULUS_PEAK_MEMORY};
    measured.insert(measured.end(), words_.begin(), words_.end());
    std::vector<double> megabytes;
    for (int i = 0; i < kRuns; ++i) megabytes.push_back(std::stod(run(measured)) / kKilobytes);
    return spread_of(megabytes).median;
  }

 private:
  [[nodiscard]] std::string run(const std::vector<std::string>& words) const {
    ProcessRun run = run_process(words, {cache_});
    if (run.exit_code != 0) throw std::runtime_error("the command failed: " + run.output);
    return std::move(run.output);
  }

  std::vector<std::string> words_;
  std::string cache_;
};

Row memory_row(std::string name, double megabytes, double most) {
  Row row;
  row.name = std::move(name);
  row.value = megabytes;
  row.unit = "MB";
  row.target = value_at_most(most);
  row.explanation = "the most memory the process had at once (ru_maxrss)";
  return row;
}

/// The timings of version, warm, cold, other, range, large and errors.
Section latency_section(const std::vector<Timing>& timings) {
  Section section{
      "process",
      "The command as a process",
      "From before the process is started until it has ended, on the wall. The ratio is "
      "to the first row.",
      {}};
  section.rows.push_back(
      timed_row("`regulus --version`", timings[0], 1e3, "ms", "a process that does nothing"));
  section.rows.push_back(
      timed_row("`regulus check`, cache hit", timings[1], 1e3, "ms",
                "`models/robot_1.toml wide_15`: the problem and its kernel come from the "
                "cache, search; no compiler is loaded"));
  section.rows.back().target = ratio_at_most(3);
  section.rows.push_back(timed_row("`regulus check --no-cache`", timings[2], 1e3, "ms",
                                   "the same, the compiler loaded, kernel and rounding self-test "
                                   "compiled"));
  section.rows.push_back(
      timed_row("`regulus check`, an unknown robot", timings[3], 1e3, "ms",
                "nothing of it is in the cache, the operations are interpreted"));
  section.rows.push_back(timed_row("`regulus check`, another range", timings[4], 1e3, "ms",
                                   "the cache has the forms of the robot, but not the question"));
  section.rows.back().target = ratio_at_most(2);
  section.rows.push_back(timed_row("`regulus check`, an unknown 6-RUS", timings[5], 1e3, "ms",
                                   "`models/hexapod_6rus.toml work --no-cache`"));
  section.rows.back().target = value_at_most(500);
  section.rows.push_back(timed_row("`regulus check`, an unknown path with errors", timings[6], 1e3,
                                   "ms",
                                   "`models/robot_1.toml T2_errors --no-cache`, anchors ±0.05"));
  section.rows.back().target = value_at_most(250);
  return section;
}

}  // namespace

Section process_rows() {
  const test::TemporaryDirectory cache;
  const std::vector<std::string> check = {
      "check", REGULUS_SOURCE_DIR "/models/robot_1.toml", "wide_15", "--quiet", "--engine", "jit"};
  std::vector<std::string> uncached = check;
  uncached.emplace_back("--no-cache");
  const std::vector<std::string> other = {"check", check[1], "wide_15", "--quiet", "--no-cache"};
  const std::vector<std::string> many = {
      "check",     check[1], "wide_15",     "--quiet",
      "--without", "moving", "--tolerance", "base,platform=0.115"};
  const Command nothing({"--version"}, cache), warm(check, cache), cold(uncached, cache);
  const Command other_question(other, cache), many_boxes(many, cache);
  const Command large(
      {"check", REGULUS_SOURCE_DIR "/models/hexapod_6rus.toml", "work", "--quiet", "--no-cache"},
      cache);
  const Command errors({"check", check[1], "T2_errors", "--tolerance", "base,platform=0.05",
                        "--quiet", "--no-cache"},
                       cache);
  // Each has another range, so none of them is in the cache. The robot is.
  const auto other_range = [&](int number) {
    return Command({"check", check[1], "wide_15", "--quiet", "--range",
                    "x=-15:" + std::to_string(15 - 1e-5 * number)},
                   cache);
  };
  int ranges = 0;
  warm.run();  // fills the cache
  other_range(ranges).run();

  const Contender contenders[] = {{"version", 1, [&] { nothing.run(); }},
                                  {"warm", 1, [&] { warm.run(); }},
                                  {"cold", 1, [&] { cold.run(); }},
                                  {"other", 1, [&] { other_question.run(); }},
                                  {"range", 1, [&] { other_range(++ranges).run(); }},
                                  {"large", 1, [&] { large.run(); }},
                                  {"errors", 1, [&] { errors.run(); }}};
  RoundOptions options;
  options.rounds = 9;
  options.clock = wall_seconds;
  const std::vector<Timing> timings = compare(contenders, options);

  Section section = latency_section(timings);
  section.rows.push_back(memory_row("memory, cache hit", warm.peak_megabytes(), 40));
  section.rows.push_back(memory_row("memory, `--no-cache`", cold.peak_megabytes(), 250));
  section.rows.push_back(
      memory_row("memory, a search of 117 807 boxes", many_boxes.peak_megabytes(), 40));
  return section;
}

}  // namespace regulus::detail::bench
