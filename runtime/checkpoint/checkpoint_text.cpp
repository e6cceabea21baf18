// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "runtime/checkpoint/checkpoint.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus {

using namespace detail;

namespace {

void put(std::string& text, double x) {
  char number[32];
  std::snprintf(number, sizeof number, "%a", x);
  text += number;
}

void put(std::string& text, std::span<const Interval> box) {
  for (const Interval& x : box) {
    text += ' ';
    put(text, x.lo);
    text += ':';
    put(text, x.hi);
  }
}

void put(std::string& text, std::uint64_t n) { text += ' ' + std::to_string(n); }

void put(std::string& text, const char* name, const WitnessCandidates::Candidate& candidate) {
  text += std::string("\ncandidate ") + name;
  for (const double x : {candidate.approx, candidate.tried}) put(text += ' ', x);
  for (const double x : candidate.point) put(text += ' ', x);
}

void put(std::string& text, const WitnessCandidates& candidates) {
  put(text, "positive", candidates.positive);
  put(text, "negative", candidates.negative);
  put(text, "small", candidates.small);
  text += "\nsmall";
  for (const unsigned n :
       {unsigned{candidates.small_known}, unsigned{candidates.small_fresh}, candidates.small_tries})
    put(text, std::uint64_t{n});
}

void put(std::string& text, const Headway::Run& run) {
  text += "\nrun";
  for (const std::uint64_t n : {run.begin, run.leaves, run.multiprecision}) put(text, n);
  put(text += ' ', run.part);
}

void put_counts(std::string& text, const SearchState& state) {
  text += "\nboxes";
  for (const std::uint64_t n :
       {state.statistics.boxes, state.statistics.max_frontier, state.statistics.probes})
    put(text, n);
  text += "\nseconds ";
  put(text, state.statistics.seconds);
  text += "\nleaves";
  for (const std::uint64_t n : state.statistics.leaves) put(text, n);
  text += "\nfilters";
  for (const std::uint64_t n : state.filter_boxes) put(text, n);
  text += "\ndescent";
  put(text, state.next_descent);
  text += "\nlimit ";
  put(text, state.threshold.value());
}

}  // namespace

std::string write_checkpoint(const CheckpointedQuestion& question, const SearchState& state,
                             const OpenBoxes& open) {
  std::string text = "regulus checkpoint 7\nquestion " + question.identity + "\nnext";
  put(text, state.next_id);
  put_counts(text, state);
  put(text, state.candidates);
  put(text, state.headway.run());
  text += "\nblocked";
  if (state.blocked) {
    put(text, static_cast<std::uint64_t>(state.blocked_reason));
    put(text, state.boxes_when_blocked);
    put(text, state.blocking_box);
  } else {
    text += " none";
  }
  text += "\nunits";
  for (const std::uint64_t n : state.units) put(text, n);
  text += "\nopen";
  put(text, std::uint64_t{open.size()});
  for (std::size_t i = 0; i < open.size(); ++i) {
    const OpenBox box = open.at(i);
    text += "\nb";
    put(text, box.id);
    put(text, std::uint64_t{box.depth});
    put(text, box.box.first(question.splittable));
  }
  text += '\n';
  return text + end_of_checkpoint(text);
}

std::string end_of_checkpoint(std::string_view before) { return "end " + sha256(before) + '\n'; }

}  // namespace regulus
