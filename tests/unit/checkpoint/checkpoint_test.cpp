// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/checkpoint/checkpoint.hpp"

#include <gtest/gtest.h>

#include <random>

namespace regulus::detail {
namespace {

class Boxes : public OpenBoxes {
 public:
  std::size_t size() const noexcept override { return boxes.size(); }
  OpenBox at(std::size_t i) const noexcept override {
    return {ids[i], static_cast<std::uint32_t>(3 + i), boxes[i]};
  }
  std::vector<BoxId> ids = {17, 16, 5};
  std::vector<std::vector<Interval>> boxes = {{{0, 0x1p-3}, {-1, 1}, {-0.5, 0.5}},
                                              {{0x1p-3, 0.25}, {-1, 0.1}, {-0.5, 0.5}},
                                              {{0.5, 1}, {0.3, 0.3}, {-0.5, 0.5}}};
};

CheckpointedQuestion question() {
  return {std::string(64, 'a'), 2, {{0, 1}, {-1, 1}, {-0.5, 0.5}}};
}

SearchState state() {
  SearchState s;
  s.next_id = 19;
  s.statistics.boxes = 12;
  s.statistics.max_frontier = 4;
  s.statistics.probes = 77;
  s.statistics.seconds = 0.1;
  for (std::size_t i = 0; i < kRules; ++i) s.statistics.leaves[i] = i * i;
  s.filter_boxes = {3, 0};
  s.next_descent = 64;
  s.threshold = AdaptiveThreshold(1.0625);
  s.candidates.positive = {{0.25, -1, 0.125}, 3.5, 0x1p-1060};
  s.candidates.small_known = true;
  s.candidates.small_tries = 9;
  s.headway = Headway({3, 7, 1, 0.0625});
  s.units = {2, 1};
  return s;
}

std::string text_of(const SearchState& s) { return write_checkpoint(question(), s, Boxes()); }

/// Returns the text with a valid checksum.
std::string signed_again(std::string text) {
  text.resize(text.rfind("end "));
  return text + end_of_checkpoint(text);
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = text_of(state());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return signed_again(text.replace(at, from.size(), to));
}

TEST(Checkpoint, WhatIsReadIsWhatWasWritten) {
  const Checkpoint read = read_checkpoint(text_of(state()), question());
  const SearchState expected = state();
  EXPECT_EQ(read.state.next_id, expected.next_id);
  EXPECT_EQ(read.state.statistics.boxes, expected.statistics.boxes);
  EXPECT_EQ(read.state.statistics.max_frontier, expected.statistics.max_frontier);
  EXPECT_EQ(read.state.statistics.probes, expected.statistics.probes);
  EXPECT_EQ(read.state.statistics.seconds, expected.statistics.seconds);
  EXPECT_EQ(read.state.statistics.leaves, expected.statistics.leaves);
  EXPECT_EQ(read.state.filter_boxes, expected.filter_boxes);
  EXPECT_EQ(read.state.next_descent, expected.next_descent);
  EXPECT_EQ(read.state.threshold.value(), expected.threshold.value());
  EXPECT_FALSE(read.state.blocked);
  EXPECT_EQ(read.state.candidates.positive.point, expected.candidates.positive.point);
  EXPECT_EQ(read.state.candidates.positive.approx, expected.candidates.positive.approx);
  EXPECT_EQ(read.state.candidates.positive.tried, expected.candidates.positive.tried);
  EXPECT_TRUE(read.state.candidates.negative.point.empty());
  EXPECT_TRUE(read.state.candidates.small_known);
  EXPECT_FALSE(read.state.candidates.small_fresh);
  EXPECT_EQ(read.state.candidates.small_tries, 9U);
  EXPECT_EQ(read.state.headway.run().begin, 3U);
  EXPECT_EQ(read.state.headway.run().leaves, 7U);
  EXPECT_EQ(read.state.headway.run().multiprecision, 1U);
  EXPECT_EQ(read.state.headway.run().part, 0.0625);
  EXPECT_EQ(read.state.units, expected.units);
  const Boxes boxes;
  const std::vector<OpenBox> open = read.open();
  ASSERT_EQ(open.size(), boxes.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    EXPECT_EQ(open[i].id, boxes.at(i).id);
    EXPECT_EQ(open[i].depth, boxes.at(i).depth);
    EXPECT_TRUE(std::equal(open[i].box.begin(), open[i].box.end(), boxes.boxes[i].begin()));
  }
}

TEST(Checkpoint, ABlockedBoxIsKept) {
  SearchState s = state();
  s.blocked = true;
  s.blocked_reason = Reason::kUncertainty;
  s.boxes_when_blocked = 11;
  s.blocking_box = {{0, 0.5}, {-1, -0.25}, {-0.5, 0.5}};
  const Checkpoint read = read_checkpoint(text_of(s), question());
  EXPECT_TRUE(read.state.blocked);
  EXPECT_EQ(read.state.blocked_reason, Reason::kUncertainty);
  EXPECT_EQ(read.state.boxes_when_blocked, 11U);
  EXPECT_EQ(read.state.blocking_box, s.blocking_box);
}

TEST(Checkpoint, OneOfAnotherQuestionIsRefused) {
  CheckpointedQuestion other = question();
  other.identity[63] = 'b';
  EXPECT_THROW(static_cast<void>(read_checkpoint(text_of(state()), other)), CheckpointError);
}

TEST(Checkpoint, AnyChangedByteAndAnyCutIsRefused) {
  const std::string text = text_of(state());
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_THROW(static_cast<void>(read_checkpoint(changed, question())), CheckpointError) << at;
    EXPECT_THROW(static_cast<void>(read_checkpoint(text.substr(0, at), question())),
                 CheckpointError)
        << at;
  }
  EXPECT_THROW(static_cast<void>(read_checkpoint(text + "\n", question())), CheckpointError);
}

TEST(Checkpoint, WhatCannotBeIsRefusedWithTheLine) {
  const auto expect_refusal = [](const std::string& text, const std::string& words) {
    try {
      static_cast<void>(read_checkpoint(text, question()));
      ADD_FAILURE() << text;
    } catch (const CheckpointError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  expect_refusal(replaced("b 17 ", "b 19 "), "line 18: expected a number up to 18");
  expect_refusal(replaced("b 17 ", "b 16 "), "a box twice");
  expect_refusal(replaced("b 17 3 0x0p+0:", "b 17 3 -0x1p+0:"), "a box of the variety");
  expect_refusal(replaced("0x1p-3:0x1p-2", "0x1p-2:0x1p-3"), "bounds in order");
  expect_refusal(replaced("0x1p-3:0x1p-2", "nan:0x1p-2"), "a hexadecimal number");
  expect_refusal(replaced("0x1p-3:0x1p-2", "0xinf:0x1p-2"), "a hexadecimal number");
  expect_refusal(replaced("units 2 1\nopen 3", "units 2 2\nopen 4"), "line 21");
  expect_refusal(replaced("units 2 1\nopen 3", "units 2\nopen 2"), "the end");
  expect_refusal(replaced("open 3", "open 99999999999999999999"), "a number");
  expect_refusal(replaced("next 19", "next 0"), "a number above 0");
  for (const char* other : {"1", "6", "8", "70"})
    expect_refusal(replaced("checkpoint 7", "checkpoint " + std::string(other)), "another version");
  expect_refusal(replaced("candidate positive 0x1.cp+1", "candidate positive nan"), "hexadecimal");
  expect_refusal(replaced(" -0x1p+0 0x1p-3\n", " -0x1p+0\n"), "a number for each variable");
  expect_refusal(replaced("units 2 1", "units 2 2"), "as many boxes as the units have");
  expect_refusal(replaced("units 2 1", "units 3 0"), "a number above 0");
  expect_refusal(replaced("run 3 7", "run 13 7"), "a number up to 12");
  expect_refusal(replaced("small 1 0 9", "small 2 0 9"), "a number up to 1");
  expect_refusal("[pose]\n", "not a checkpoint");
  expect_refusal("", "not a checkpoint");
}

/// A changed checkpoint is either read or refused.
TEST(Checkpoint, RandomChangesAreReadOrRefused) {
  std::mt19937 random(7);
  const std::string text = text_of(state());
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string changed = text;
    for (std::uint32_t n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = random() % changed.size();
      switch (random() % 3) {
        case 0:
          changed[at] = "0123456789abcdefxp+-: \n"[random() % 23];
          break;
        case 1:
          changed.erase(at, 1 + random() % 8);
          break;
        default:
          changed.insert(at, changed.substr(random() % changed.size(), random() % 8));
      }
    }
    if (changed.find("end ") == std::string::npos) continue;
    try {
      const Checkpoint checkpoint = read_checkpoint(signed_again(changed), question());
      ++read;
      for (const OpenBox& box : checkpoint.open())
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_TRUE(certain_subset(box.box[k], question().ranges[k]));
    } catch (const CheckpointError&) {
    }
  }
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace regulus::detail
