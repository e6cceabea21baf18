// SPDX-License-Identifier: GPL-3.0-or-later
// The ingredients that are left out, and the problems that are solved without them.
#pragma once

#include "codegen/question/engine/choices.hpp"
#include "tests/paper/tables/run_cell.hpp"

namespace regulus::detail::test {

struct AblationProblem {
  const char* name;
  Question question;
};

inline const AblationProblem kAblationProblems[] = {
    {"R1", {"models/robot_1.toml", "wide_15"}},
    {"R2", {"models/robot_2.toml", "table5_30"}},
    {"R1 ±0.05", {"models/robot_1.toml", "table6_15_15", {}, {"base,platform=0.05"}}},
    {"R1 ±0.1", {"models/robot_1.toml", "table6_15_15", {}, {"base,platform=0.1"}}},
    {"R2 ±20", {"models/robot_2.toml", "table5_20", {}, {"base,platform=20"}}},
    {"R2 ±40", {"models/robot_2.toml", "table5_20", {}, {"base,platform=40"}}},
    {"T2", {"models/robot_1.toml", "T2_errors", {}, {"base,platform=0.05"}}},
    {"balls", {"tests/paper/models/robot_1_balls.toml", "table6_15_15", {}, {"base,platform=0.1"}}},
    {"reach", {"tests/paper/models/robot_1_unscaled.toml", "reach"}},
    {"shared", {"tests/paper/models/robot_1_unscaled.toml", "wide_15", {}, {"size=0.1"}}},
    {"α", {"models/robot_1.toml", "wide_15", {}, {}, "0.5"}},
    {"±40°", {"models/robot_1.toml", "wide_40"}},
    {"±29°",
     {"models/robot_1.toml",
      "wide_15",
      {"psi=-29*deg:29*deg", "theta=-29*deg:29*deg", "phi=-29*deg:29*deg"},
      {"base,platform=0.01"}}},
};

/// Words of the command line, and the options that they mean.
struct Ablation {
  std::vector<std::string> without = {};
  std::string bisect = "impact";
  std::string method = "auto";

  [[nodiscard]] SearchOptions options(double limit) const {
    SearchOptions search;
    search.without = without;
    search.bisection = choice_of<Bisection>("--bisect", bisect);
    search.method = choice_of<Method>("--method", method);
    search.time_limit = limit;
    return search;
  }

  [[nodiscard]] std::string words() const {
    std::string text;
    for (const std::string& name : without) text += " --without " + name;
    if (bisect != "impact") text += " --bisect " + bisect;
    if (method != "auto") text += " --method " + method;
    return text.empty() ? "all of it" : text.substr(1);
  }
};

}  // namespace regulus::detail::test
