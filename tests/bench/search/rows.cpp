// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/search/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>

#include "codegen/question/engine/choices.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/search/prepared.hpp"

namespace regulus::detail::bench {
namespace {

constexpr SearchCase kCases[] = {{"wide_15", "robot_1", "wide_15", "", 15},
                                 {"table5_20", "robot_2", "table5_20", "", 25},
                                 {"table5_30", "robot_2", "table5_30", "", 120},
                                 {"wide_40, singular", "robot_1", "wide_40", "", 100},
                                 {"table5_40, singular", "robot_2", "table5_40", "", 50},
                                 {"table6_15_15, ±0.1", "robot_1", "table6_15_15", "0.1", 8000},
                                 {"T2", "robot_1", "T2"},
                                 {"T2_errors, ±0.05", "robot_1", "T2_errors", "0.05"}};

std::string count_of(std::uint64_t boxes) {
  return boxes == 1 ? "1 box" : fmt::format("{} boxes", boxes);
}

/// Compares searches of one problem; the first one is the reference.
class SearchComparison {
 public:
  void add(std::string name, std::string explanation, const SearchCase& which,
           const SearchOptions& options, unsigned batch = REGULUS_LANES,
           std::optional<Target> target = std::nullopt, bool anew = false) {
    TimedSearch& search = searches_.emplace_back(which, options);
    search.settings().batch = batch;
    search.run();
    static_cast<void>(search.statistics());
    Row& row = rows_.emplace_back();
    row.name = std::move(name);
    row.explanation = std::move(explanation);
    row.target = target;
    contenders_.push_back(
        {row.name, 1, [&search, anew] { anew ? search.run_anew() : search.run(); }});
  }

  void skip(Row row) { skipped_.push_back(std::move(row)); }

  /// Adds rows of microseconds a search, with boxes and the time of a box in the explanation.
  void append_to(Section& section) {
    RoundOptions options;
    options.rounds = 9;
    const std::vector<Timing> timings = compare(contenders_, options);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::uint64_t boxes = searches_[i].statistics().boxes;
      const double microseconds = timings[i].seconds.median * 1e6;
      Row& row = rows_[i];
      row.value = microseconds;
      row.unit = "µs";
      row.ratio = timings[i].ratio;
      row.explanation = fmt::format("{}: {}, {:.3g} µs a box", row.explanation, count_of(boxes),
                                    microseconds / static_cast<double>(boxes));
      section.rows.push_back(std::move(row));
    }
    section.rows.insert(section.rows.end(), skipped_.begin(), skipped_.end());
  }

 private:
  std::deque<TimedSearch> searches_;
  std::vector<Row> rows_, skipped_;
  std::vector<Contender> contenders_;
};

/// Returns options for one thread, since processor time is measured.
SearchOptions alone() {
  SearchOptions options;
  options.threads = 1;
  return options;
}

SearchOptions on(Isa isa) {
  SearchOptions options = alone();
  options.isa = isa;
  return options;
}

/// Problems that include models with divisions and roots.
constexpr SearchCase kEngineCases[] = {{"wide_15, ±0.1", "robot_1", "wide_15", "0.1"},
                                       {"table5_30", "robot_2", "table5_30"},
                                       {"hexapod_6rus", "hexapod_6rus", "work"},
                                       {"delta", "delta", "work"},
                                       {"puma_560", "puma_560", "dexterous"}};

/// Returns a target on the time, not on a ratio: it depends on the machine and its load.
std::optional<Target> target_of(const SearchCase& which) {
  if (which.most_microseconds > 0) return value_at_most(which.most_microseconds);
  return std::nullopt;
}

void add_case(const SearchCase& which, Section& section) {
  SearchComparison comparison;
  for (const Isa isa : kAllIsas) {
    const std::string title = fmt::format("{}, {}", which.title, name(isa));
    if (supported(isa))
      comparison.add(title, "eight boxes at once", which, on(isa), REGULUS_LANES,
                     isa == best_isa() ? target_of(which) : std::nullopt);
    else
      comparison.skip(skipped_row(title, "this processor cannot run it", ""));
  }
  comparison.add(fmt::format("{}, one at a time", which.title),
                 "Settings::batch = 1: seven lanes of eight idle", which, on(best_isa()), 1,
                 std::nullopt);
  comparison.add(fmt::format("{}, a new solver", which.title),
                 "set up, and without knowledge of the question", which, on(best_isa()),
                 REGULUS_LANES, std::nullopt, true);
  comparison.append_to(section);
}

Section search_heading() {
  return {
      "search",
      "Whole searches",
      "`regulus check` on the paper's problems, search alone, in one process. The ratio is of "
      "total times, to the first row of the problem; the instruction set is the kernel's, the "
      "regularity tests run on the best there is. A solver is kept from one search to the next: "
      "it knows where the last one split boxes, and proves the leaves anew.",
      {}};
}

}  // namespace

Section search_rows() {
  Section section = search_heading();
  for (const SearchCase& which : kCases) add_case(which, section);
  return section;
}

Section rows_of(const SearchCase& which) {
  Section section = search_heading();
  add_case(which, section);
  return section;
}

double least_microseconds(const SearchCase& which, std::size_t runs, bool anew) {
  TimedSearch search(which, on(best_isa()));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t run = 0; run < runs; ++run) {
    const double start = thread_seconds();
    anew ? search.run_anew() : search.run();
    least = std::min(least, thread_seconds() - start);
  }
  return 1e6 * least;
}

Section engine_rows() {
  Section section{
      "engines",
      "Compiled or interpreted",
      "The same searches by compiled code and by the vector machine, which runs the list "
      "that the code is made from: the same boxes. The ratio is to the compiled kernel "
      "for the same instruction set.",
      {}};
  for (const SearchCase& which : kEngineCases)
    for (const Isa isa : kAllIsas) {
      if (!supported(isa)) continue;
      SearchComparison comparison;
      for (const auto& [engine, title] :
           {std::pair{Engine::kJit, "compiled"}, std::pair{Engine::kInterpreted, "interpreted"}}) {
        SearchOptions options = on(isa);
        options.engine = engine;
        comparison.add(fmt::format("{}, {}, {}", which.title, name(isa), title), "search alone",
                       which, options);
      }
      comparison.append_to(section);
    }
  return section;
}

Section product_rows() {
  constexpr SearchCase kBoth[] = {{"wide_15", "robot_1", "wide_15"},
                                  {"table5_20", "robot_2", "table5_20"},
                                  {"table5_30", "robot_2", "table5_30"},
                                  {"table6_5_5, ±0.05", "robot_1", "table6_5_5", "0.05"},
                                  {"T2", "robot_1", "T2"},
                                  {"T2_errors, ±0.05", "robot_1", "T2_errors", "0.05"}};
  Section section{"product",
                  "K·J⁻¹ multiplied out symbolically, and from numbers",
                  "The paper's point: a variable that occurs less often gives narrower bounds. The "
                  "ratio is of total times, to the first row of the problem.",
                  {}};
  for (const SearchCase& which : kBoth) {
    SearchComparison comparison;
    for (const char* method : {"kj", "kj-numeric", "auto"}) {
      SearchOptions options = alone();
      options.method = choice_of<Method>("--method", method);
      comparison.add(fmt::format("{}, {}", which.title, method),
                     fmt::format("`--method {}`", method), which, options);
    }
    comparison.append_to(section);
  }
  return section;
}

Section thread_rows() {
  Section section{"threads",
                  "Threads",
                  "Time on the wall, and processor time, of a search of more than 100 000 boxes. "
                  "The ratio is to one thread: below 1 is sooner.",
                  {}};
  SearchOptions options = alone();
  options.without = {"moving"};
  TimedSearch search({"", "robot_1", "wide_15", "0.115"}, options);
  const auto with_threads = [&](unsigned threads) {
    search.settings().threads = threads;
    search.run();
  };
  const Contender contenders[] = {{"1", 1, [&] { with_threads(1); }},
                                  {"2", 1, [&] { with_threads(2); }}};
  RoundOptions rounds;
  rounds.rounds = 5;
  rounds.slice = 0;
  rounds.clock = wall_seconds;
  const std::vector<Timing> wall = compare(contenders, rounds);
  rounds.rounds = 3;
  rounds.clock = process_seconds;
  const std::vector<Timing> work = compare(contenders, rounds);
  const std::string what = fmt::format("`wide_15 --without moving`, anchors ±0.115 cm: {}",
                                       count_of(search.statistics().boxes));
  section.rows = {
      timed_row("1 thread", wall[0], 1, "s", what),
      timed_row("2 threads", wall[1], 1, "s", "the same boxes; needs a processor that is free"),
      timed_row("1 thread, processor time", work[0], 1, "s", "the same"),
      timed_row("2 threads, processor time", work[1], 1, "s",
                "of both together: what sharing the work costs, whoever else runs")};
  section.rows[1].target = ratio_at_most(1 / 1.85);
  return section;
}

}  // namespace regulus::detail::bench
