// SPDX-License-Identifier: GPL-3.0-or-later
// Searches of the condition number of a small matrix.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/condition/condition_search.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "tests/support/search_events.hpp"

namespace regulus::detail::test {

/// A rotation with scales of its rows: κ₂ = 5 + (x + z)/8, so no box is much better than others.
inline constexpr const char* kTurned = R"toml(regulus = 1
name = "turn"
[pose]
x = "1"
y = "1"
z = "1"
[matrix]
rows = [["cos(x)*cos(y)", "cos(x)*sin(y)*sin(z) - sin(x)*cos(z)", "cos(x)*sin(y)*cos(z) + sin(x)*sin(z)"],
        ["2*sin(x)*cos(y)", "2*sin(x)*sin(y)*sin(z) + 2*cos(x)*cos(z)", "2*sin(x)*sin(y)*cos(z) - 2*cos(x)*sin(z)"],
        ["-(5 + (x + z)/8)*sin(y)", "(5 + (x + z)/8)*cos(y)*sin(z)", "(5 + (x + z)/8)*cos(y)*cos(z)"]]
[motion.m]
x = [0, 1]
y = [0, 1]
z = [0, 1]
constraints = ["x + y - 3/2"]
)toml";
inline constexpr double kTurnedCondition = 5.25;

struct Ended {
  ConditionResult result;
  std::string events;
  SavedTree saved;
  int saves = 0;
};

class TestMatrix {
 public:
  explicit TestMatrix(const std::string& text, Method method = Method::kReg,
                      Entries entries = Entries::kDerivatives) {
    Model model = parse_model(text, "test.toml");
    Motion motion = model.motions.front();
    SearchOptions search;
    search.engine = Engine::kInterpreted;
    search.method = method;
    search.entries = entries;
    search.without = {"columns", "rows"};
    prepared_.emplace(
        prepare(inverse_in_one_unit({std::move(model), std::move(motion)}), 0, search));
    scaling_ = prepared_->stages->formulation().scaling;
  }

  [[nodiscard]] Ended run(ConditionSettings settings, const SavedTree* from = nullptr) const {
    Ended ended;
    SearchEvents events;
    const Problem problem = prepared_->problem();
    settings.from = from;
    settings.save = [&](const SavedTree& state) { ended.saved = state, ++ended.saves; };
    ended.result = search_condition({problem, scaling_}, settings, &events);
    ended.events = events.text;
    return ended;
  }

  [[nodiscard]] Problem problem() const { return prepared_->problem(); }
  [[nodiscard]] const MatrixScaling& scaling() const { return scaling_; }

 private:
  std::optional<PreparedSearch> prepared_;
  MatrixScaling scaling_;
};

inline ConditionSettings settings_with_gap(double gap, unsigned threads = 1) {
  ConditionSettings settings;
  settings.gap = gap;
  settings.threads = threads;
  return settings;
}

inline void expect_same(const Ended& one, const Ended& other) {
  EXPECT_EQ(one.result.proved, other.result.proved);
  EXPECT_EQ(one.result.boxes, other.result.boxes);
  EXPECT_EQ(one.result.reason, other.result.reason);
  EXPECT_EQ(one.result.is_closed, other.result.is_closed);
  EXPECT_EQ(one.result.is_singular, other.result.is_singular);
  ASSERT_EQ(one.result.attained.has_value(), other.result.attained.has_value());
  if (one.result.attained) {
    EXPECT_EQ(one.result.attained->variables, other.result.attained->variables);
    EXPECT_EQ(one.result.attained->shown.condition, other.result.attained->shown.condition);
    EXPECT_EQ(one.result.attained->shown.most, other.result.attained->shown.most);
    EXPECT_EQ(one.result.attained->shown.least, other.result.attained->shown.least);
  }
  EXPECT_TRUE(one.events == other.events);
  EXPECT_TRUE(one.saved == other.saved);
}

/// Stops at each number of boxes and continues.
inline Ended run_with_stops(const TestMatrix& matrix, const ConditionSettings& settings,
                            std::initializer_list<std::uint64_t> stops) {
  std::optional<SavedTree> state;
  for (const std::uint64_t stop : stops) {
    ConditionSettings until = settings;
    until.max_boxes = stop;
    Ended ended = matrix.run(until, state ? &*state : nullptr);
    EXPECT_FALSE(ended.result.is_closed) << stop;
    state = std::move(ended.saved);
  }
  return matrix.run(settings, &*state);
}

}  // namespace regulus::detail::test
