// SPDX-License-Identifier: GPL-3.0-or-later
// Questions whose proofs may be in shards: one of each kind, about small models.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <ostream>
#include <string>
#include <utility>
#include <variant>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/refusals.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/unit/api/circle.hpp"

namespace regulus::detail::test::claims_in_shards {

// In bytes: every line is a shard, or some forty lines are.
inline constexpr std::uint64_t kOneLine = 1, kManyLines = 600;

/// det J⁻¹ = cos h: regular up to a tolerance of π/2, in many boxes.
inline constexpr const char* kTurn = R"toml(regulus = 1
name = "turn"
[pose]
x = "m"
y = "m"
[geometry]
h = { value = 0, tolerance = 0, group = "base" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["cos(x*y)", "sin(x*y)"], ["-sin(x*y + h)", "cos(x*y + h)"]]
[load.weight]
force = [[-1, 1], [-3, -1]]
[actuators]
force = [-5, 5]
error = 0.1
[motion.box]
x = [0, 1]
y = [0, 1]
[motion.way]
waypoints = "way.csv"
)toml";

inline constexpr const char* kWay = "x,y\n0.1,0.2\n1,0.5\n0.3,1\n";

/// The branch q = √(c·l), r = 9·q/(9 + l).
inline constexpr const char* kRoot = R"toml(regulus = 1
name = "root"
[pose]
l = "m"
[geometry]
c = { value = 1, tolerance = 0, group = "base" }
[closure]
unknowns = { q = "m", r = "m" }
equations = ["q^2 - c*l", "r*(9 + l) - 9*q"]
start = { l = 4, q = 2, r = "18/13" }
[load.weight]
wrench = [[-3, 3], [-1, 1]]
[actuators]
force = [-7, 7]
error = 0.1
[motion.box]
l = [0.1, 9]
[motion.way]
waypoints = "way.csv"
)toml";

/// The branch ends at 0.
inline constexpr const char *kWayOfRoot = "l\n4\n9\n0.1\n", *kWayToTheEnd = "l\n4\n9\n-1\n";

/// A platform whose legs have errors.
inline constexpr const char* kTriangle = R"toml(regulus = 1
name = "triangle"
[legs]
unit = "cm"
[[legs.leg]]
type = "RPR"
base = [0, 10]
platform = [0, 4]
[[legs.leg]]
type = "RPR"
base = ["-5*sqrt(3)", -5]
platform = ["-2*sqrt(3)", -2]
[[legs.leg]]
type = "RPR"
base = ["5*sqrt(3)", -5]
platform = ["2*sqrt(3)", -2]
[actuators]
error = 0.01
[motion.box]
x = [-1, 1]
y = 0
phi = "60*deg"
[motion.way]
waypoints = "way.csv"
phi = "60*deg"
)toml";

inline constexpr const char* kWayOfTriangle = "x,y\n0,0\n1,0\n1,1\n";

/// A model, and the way-points of its motion "way"; its motion "box" is over ranges.
struct ClaimedModel {
  const char *text, *waypoints;
};
inline constexpr ClaimedModel kTurning{kTurn, kWay}, kPlatform{kTriangle, kWayOfTriangle},
    kBranch{kRoot, kWayOfRoot}, kBranchThatEnds{kRoot, kWayToTheEnd};

/// Asks a kind of question about a variety or along way-points.
struct Claim {
  const char* name;
  Kind variety, along;
  Asked (*asked)(ModelOptions model);
  ClaimedModel model = kTurning;
  std::uint64_t shard_size = kOneLine;
  bool is_repeatable = true;  ///< its ends do not depend on the time that is left
};

inline Asked with_tolerance(ModelOptions model, const std::string& range) {
  model.tolerances = {"base=" + range};
  AskMargin asked{std::move(model), interpreted(), {}};
  asked.gap = "0.5";
  return asked;
}

inline QuantityOptions force() { return {.quantity = "force", .load = "weight", .row = "1"}; }

inline Asked with_limit(ModelOptions model, const std::string& limit) {
  auto asked = std::get<AskMargin>(with_tolerance(std::move(model), "0:0.3"));
  asked.quantity = force();
  asked.limit = limit;
  return asked;
}

inline Asked ask_check(ModelOptions model) {
  model.tolerances = {"base=0.3"};
  return AskCheck{std::move(model), interpreted()};
}
inline Asked ask_paving(ModelOptions model) {
  return AskPaving{std::move(model), interpreted(), "1/4"};
}
inline Asked ask_margin(ModelOptions model) { return with_tolerance(std::move(model), "0.1:0.3"); }
inline Asked ask_bound(ModelOptions model) {
  return AskBound{std::move(model), interpreted(), force(), "", "0.1"};
}
inline Asked ask_condition(ModelOptions model) {
  const QuantityOptions condition{.quantity = "condition", .norm = "2"};
  return AskBound{std::move(model), interpreted(), condition, "", "0.5"};
}
inline Asked ask_load(ModelOptions model) { return AskLoad{std::move(model), interpreted()}; }
inline Asked ask_load_paving(ModelOptions model) {
  return AskLoadPaving{std::move(model), interpreted(), "", "1/8"};
}
inline ModelOptions to_the_end(ModelOptions model) {
  if (model.motion == "box") model.ranges = {"l=-1:9"};
  return model;
}
inline Asked ask_datasheet(ModelOptions model) {
  return AskDatasheet{std::move(model), interpreted(), "0.5"};
}
inline Asked ask_finite(ModelOptions model, const std::string& freedom) {
  QuantityOptions error{.quantity = "error"};
  error.freedom = freedom;
  error.is_finite = true;
  return AskBound{std::move(model), interpreted(), error, "", "0.2"};
}

using enum Kind;

inline constexpr Claim kClaims[] = {
    {"Check", kCheck, kWayCheck, ask_check},
    {"Paving", kPaving, kWayPaving, ask_paving},
    {"Margin", kMargin, kWayMargin, ask_margin},
    {"LimitMargin", kLimitMargin, kWayLimitMargin,
     [](ModelOptions model) { return with_limit(std::move(model), "6"); }},
    {"Bound", kBound, kWayBound, ask_bound},
    {"Condition2", kCondition2, kWayCondition2, ask_condition},
    {"Load", kLoad, kWayLoad, ask_load},
    {"LoadPaving", kLoadPaving, kWayLoadPaving, ask_load_paving},
    {"Datasheet", kDatasheet, kWayDatasheet, ask_datasheet, kTurning, kManyLines, false},
    {"FiniteErrors", kFiniteErrors, kWayFiniteErrors,
     [](ModelOptions model) { return ask_finite(std::move(model), "phi_deviation"); }, kPlatform},
    {"ClosureCheck", kClosureCheck, kClosureWayCheck, ask_check, kBranch},
    {"ClosurePaving", kClosurePaving, kClosureWayPaving,
     [](ModelOptions model) { return ask_paving(to_the_end(std::move(model))); }, kBranchThatEnds},
    {"ClosureMargin", kClosureMargin, kClosureWayMargin, ask_margin, kBranch},
    {"ClosureLimitMargin", kClosureLimitMargin, kClosureWayLimitMargin,
     [](ModelOptions model) { return with_limit(std::move(model), "7"); }, kBranch},
    {"ClosureBound", kClosureBound, kClosureWayBound, ask_bound, kBranch},
    {"ClosureCondition2", kClosureCondition2, kClosureWayCondition2, ask_condition, kBranch},
    {"ClosureLoad", kClosureLoad, kClosureWayLoad, ask_load, kBranch},
    {"ClosureLoadPaving", kClosureLoadPaving, kClosureWayLoadPaving,
     [](ModelOptions model) { return ask_load_paving(to_the_end(std::move(model))); },
     kBranchThatEnds},
    {"ClosureDatasheet", kClosureDatasheet, kClosureWayDatasheet, ask_datasheet, kBranch, kOneLine,
     false},
    {"ClosureFiniteErrors", kClosureFiniteErrors, kClosureWayFiniteErrors,
     [](ModelOptions model) {
       model.tolerances = {"base=0.1"};
       return ask_finite(std::move(model), "q");
     },
     kBranch},
};

struct Case {
  const Claim& claim;
  bool is_along_way;
};

inline std::string name_of(const Case& one) {
  return one.claim.name + std::string(one.is_along_way ? "AlongWayPoints" : "");
}
inline void PrintTo(const Case& one, std::ostream* out) { *out << name_of(one); }

/// Asks the question of a claim.
class AClaim : public testing::TestWithParam<Case> {
 protected:
  AClaim() {
    std::ofstream(model_) << GetParam().claim.model.text;
    std::ofstream(folder_.path() / "way.csv") << GetParam().claim.model.waypoints;
  }

  /// Answers it with a proof; `shard_size` 0: in one file.
  void prove(const std::string& path, std::uint64_t shard_size, unsigned threads = 1) const {
    const auto& [claim, is_along_way] = GetParam();
    ModelOptions model;
    model.path = model_;
    model.motion = is_along_way ? "way" : "box";
    Services services;
    services.certificate = path;
    services.shard_size = shard_size;
    Asked asked = claim.asked(std::move(model));
    std::visit(
        [&](auto& question) {
          question.search.threads = threads;
          static_cast<void>(ask(question, services));
        },
        asked);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

  const TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "turn.toml";
};

}  // namespace regulus::detail::test::claims_in_shards
