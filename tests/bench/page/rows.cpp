// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/page/rows.hpp"

#include <filesystem>
#include <stdexcept>

#include "tests/bench/measure/process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kMostKilobytes = 1500;
constexpr double kMostMilliseconds = 2000;

Row size_row(const std::string& name, const std::string& page, const std::string& explanation) {
  Row row;
  row.name = name + ", size";
  row.value = double(fs::file_size(page)) / 1000;
  row.unit = "kB";
  row.target = value_at_most(kMostKilobytes);
  row.explanation = explanation;
  return row;
}

Row frame_row(const std::string& name, const std::string& page) {
  const std::string label = name + ", until it is drawn";
  const std::string explanation =
      "headless Chromium that is running, from the start of the navigation, software rendering";
  if (!fs::exists(REGULUS_CHROMIUM) || !fs::exists(REGULUS_NODE))
    return skipped_row(label, "there is no Chromium, or no node", explanation);
  const ProcessRun run =
      run_process({REGULUS_NODE, REGULUS_SOURCE_DIR "/tests/bench/page/first_frame.mjs",
                   REGULUS_BINARY_DIR "/tests/page", REGULUS_CHROMIUM, page});
  if (run.exit_code != 0) throw std::runtime_error("the browser failed: " + run.output);
  Row row;
  row.name = label;
  row.value = std::stod(run.output);
  row.unit = "ms";
  row.target = value_at_most(kMostMilliseconds);
  row.explanation = explanation;
  return row;
}

}  // namespace

Section page_rows() {
  Section section{"page", "The page", "Pages of `regulus report`.", {}};
  if (!fs::exists(REGULUS_BINARY_DIR "/share/regulus/page.html")) {
    section.rows.push_back(skipped_row("pages", "this build has no page: npm is missing", ""));
    return section;
  }
  const test::TemporaryDirectory folder;
  const auto add = [&](const std::string& name, std::vector<std::string> words,
                       const std::string& explanation) {
    const std::string page = folder.path() / (name + ".html");
    words.insert(words.begin(), {REGULUS_COMMAND, "report"});
    words.insert(words.end(), {"--quiet", "--output", page});
    if (const ProcessRun run = run_process(words); run.exit_code > 2 || run.exit_code < 0)
      throw std::runtime_error("regulus report failed: " + run.output);
    section.rows.push_back(size_row(name, page, explanation));
    section.rows.push_back(frame_row(name, page));
  };
  add("a proof of few boxes", {REGULUS_SOURCE_DIR "/models/robot_1.toml", "wide_15"},
      "`models/robot_1.toml wide_15`");
  add("a paving of 5000 boxes",
      {REGULUS_SOURCE_DIR "/models/planar_3rpr.toml", "crossing", "--paving", "--resolution",
       "1/48"},
      "`models/planar_3rpr.toml crossing --paving --resolution 1/48`");
  return section;
}

}  // namespace regulus::detail::bench
