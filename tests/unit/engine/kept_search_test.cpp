// SPDX-License-Identifier: GPL-3.0-or-later
// A prepared search can be run again, with the same events to the last bit.
#include <gtest/gtest.h>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/search_events.hpp"

namespace regulus {
namespace {

struct Question {
  const char* model;
  const char* motion;
  const char* tolerance;
};

PreparedSearch prepared(const Question& question, const SearchOptions& search) {
  ModelOptions model;
  model.path = std::string(REGULUS_SOURCE_DIR "/models/") + question.model;
  model.motion = question.motion;
  if (*question.tolerance != '\0')
    model.tolerances = {std::string("base,platform=") + question.tolerance};
  return prepare(model, search);
}

std::string events_of(PreparedSearch& preparation, const SearchOptions& search) {
  test::SearchEvents events;
  static_cast<void>(run_search(preparation, search, settings_from(search), &events));
  return events.text;
}

TEST(KeptSearch, RepeatsItselfToTheBit) {
  for (const Question& question : {Question{"robot_1.toml", "wide_15", "0.1"},
                                   {"robot_1.toml", "T2_errors", "0.05"},
                                   {"robot_1.toml", "wide_40", ""},
                                   {"robot_2.toml", "table5_30", ""},
                                   {"delta.toml", "work", ""}}) {
    SearchOptions search;
    search.threads = 1;
    search.engine = Engine::kInterpreted;
    PreparedSearch preparation = prepared(question, search);
    const std::string first = events_of(preparation, search);
    EXPECT_FALSE(first.empty());
    for (int again = 0; again < 2; ++again)
      EXPECT_TRUE(events_of(preparation, search) == first) << question.motion;
    PreparedSearch moved = std::move(preparation);
    EXPECT_TRUE(events_of(moved, search) == first) << question.motion;
  }
}

}  // namespace
}  // namespace regulus
