// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the benchmarks, prints each table when it is ready, and writes the report.
//
//     bench [--only SECTION,…] [--json FILE] [--markdown FILE]
//     bench one MODEL MOTION [--tolerance E] [--runs N [--anew]]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include "tests/bench/completeness/rows.hpp"
#include "tests/bench/counts/rows.hpp"
#include "tests/bench/embedded/rows.hpp"
#include "tests/bench/kernel/rows.hpp"
#include "tests/bench/latency/rows.hpp"
#include "tests/bench/limit/rows.hpp"
#include "tests/bench/page/rows.hpp"
#include "tests/bench/report/writers.hpp"
#include "tests/bench/search/prepared.hpp"
#include "tests/bench/search/rows.hpp"

namespace regulus::detail::bench {
namespace {

struct NamedSection {
  const char* name;
  Section (*run)();
};

/// The sections in the order of the report.
constexpr NamedSection kSections[] = {
    {"kernel", kernel_rows},
    {"limit", limit_rows},
    {"search", search_rows},
    {"product", product_rows},
    {"engines", engine_rows},
    {"threads", thread_rows},
    {"embedded", embedded_rows},
    {"process", process_rows},
    {"compile", compile_rows},
    {"counts", count_rows},
    {"completeness", completeness_rows},
    {"margins", margin_rows},
    {"page", page_rows},
};

struct Options {
  std::vector<std::string> only;
  std::string json;
  std::string markdown;
};

bool wanted(const Options& options, const char* name) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void run(const Options& options) {
  Report report{this_machine(), {}};
  for (const NamedSection& section : kSections) {
    if (!wanted(options, section.name)) continue;
    report.sections.push_back(section.run());
    std::cout << to_markdown(report.sections.back()) << std::endl;
  }
  write(options.json, to_json(report));
  write(options.markdown, to_markdown(report));
  std::cout << summary(report) << '\n';
}

}  // namespace
}  // namespace regulus::detail::bench

int main(int argc, char** argv) {
  using namespace regulus::detail::bench;
  CLI::App app{"What the code costs, and what others cost for the same."};
  Options options;
  std::vector<std::string> names;
  for (const NamedSection& section : kSections) names.emplace_back(section.name);
  app.add_option("--only", options.only, "Run these sections")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--json", options.json, "Write the report as JSON");
  app.add_option("--markdown", options.markdown, "Write the report as Markdown");
  CLI::App& one = *app.add_subcommand("one", "Time the search of one problem");
  std::string model, motion, tolerance;
  one.add_option("MODEL", model, "A model file")->required();
  one.add_option("MOTION", motion, "One of its motions")->required();
  one.add_option("--tolerance", tolerance, "Of the groups base and platform");
  std::size_t runs = 0;
  one.add_option("--runs", runs, "Nothing but so many searches, for a profiler");
  bool anew = false;
  one.add_flag("--anew", anew, "Each of them by a new solver");
  CLI11_PARSE(app, argc, argv);
  try {
    const SearchCase which{motion.c_str(), model.c_str(), motion.c_str(), tolerance.c_str()};
    if (one && runs > 0)
      std::cout << least_microseconds(which, runs, anew) << " µs at least\n";
    else if (one)
      std::cout << to_markdown(rows_of(which));
    else
      run(options);
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << '\n';
    return 70;
  }
}
