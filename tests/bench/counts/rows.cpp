// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/counts/rows.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/kernel/subject.hpp"
#include "tests/bench/measure/process.hpp"

namespace regulus::detail::bench {
namespace {

/// Returns the number that follows `label` in a text.
std::optional<double> number_after(const std::string& text, const std::string& label) {
  const std::size_t at = text.find(label);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(text.substr(at + label.size()));
}

struct Counted {
  double instructions;
  std::string output;
};

/// Throws std::runtime_error with the output of the program.
Counted count(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"valgrind", "--tool=callgrind",
                                      "--toggle-collect=bench_counted_region",
                                      "--callgrind-out-file=/dev/null", REGULUS_COUNTED};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ProcessRun run = run_process(command);
  const std::optional<double> instructions = number_after(run.output, "Collected :");
  if (run.exit_code != 0 || !instructions) throw std::runtime_error(run.output);
  return {*instructions, std::move(run.output)};
}

struct KernelCount {
  const char* name;
  std::vector<std::string> arguments;
  const char* explanation;
};

void add_kernel_rows(Section& section) {
  const KernelCount counts[] = {
      {"K·M, ours, avx2", {"kernel", "avx2"}, "compiled ahead of time by the suite's compiler"},
      {"K·M, ours, portable", {"kernel", "portable"}, "the same, baseline instructions"},
      {"K·M, Boost.Interval, unprotected", {"rival", "boost_unprotected"}, "one box at a time"},
      {"K·M, MPFI, 53 bits", {"rival", "mpfi"}, "one box at a time"},
      {"K·M, this project's scalar Interval", {"rival", "scalar_interval"}, "one box at a time"},
      {"K·M, plain double, scalar", {"rival", "plain_scalar"}, "no enclosure"},
  };
  std::optional<double> reference;
  for (const KernelCount& c : counts) try {
      Row row;
      row.name = c.name;
      row.value = count(c.arguments).instructions / Sample::kBoxes;
      row.unit = "instructions/box";
      row.explanation = c.explanation;
      if (!reference) reference = row.value;
      const double ratio = *row.value / *reference;
      row.ratio = Spread{ratio, ratio, ratio};
      section.rows.push_back(std::move(row));
    } catch (const std::runtime_error&) {
      section.rows.push_back(
          skipped_row(c.name, "it cannot be run under valgrind here", c.explanation));
    }
}

void add_search_row(Section& section) {
  const Counted counted = count({"search"});
  Row row;
  row.name = "a whole search, portable";
  row.value = counted.instructions / number_after(counted.output, "boxes:").value();
  row.unit = "instructions/box";
  row.explanation = "`models/robot_1.toml wide_15`: kernel, regularity tests, bisection";
  section.rows.push_back(std::move(row));
}

}  // namespace

Section count_rows() {
  Section section{"counts",
                  "Instructions",
                  "Counted by callgrind, which knows no AVX-512; they are the same in every run of "
                  "the same program. The ratio is to the first row.",
                  {}};
  if (run_process({"valgrind", "--version"}).exit_code != 0) {
    section.rows = {skipped_row("instructions", "valgrind was not found (valgrind)", "")};
    return section;
  }
  add_kernel_rows(section);
  add_search_row(section);
  return section;
}

}  // namespace regulus::detail::bench
