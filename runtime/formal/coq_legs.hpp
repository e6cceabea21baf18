// SPDX-License-Identifier: Apache-2.0
// The legs of a robot, [legs], as the verifier's reader finds them in a model file, in the words of
// Legs.v.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/verifier/model/leg_rows.hpp"
#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {

struct CoqNumber {
  std::string text;
  NodeId node = kNoNode;
};

/// `values` are the numbers of `text`. The mode is that of the file, and `actuated` is not used.
struct CoqLeg {
  LegValues values;
  std::string text;
};

/// How the numbers of a file are read: those with a tolerance by their places and names, and others.
struct LegNumbers {
  using Places = std::vector<std::pair<std::string, std::string>>;
  std::function<std::vector<CoqNumber>(const Places&, const SectionQuantity&)> quantities;
  std::function<CoqNumber(const std::string& place)> constant;
  Graph& graph;
};

/// Returns the legs, and adds to `read` the places that have a meaning. Throws Unfinished for what
/// Legs.v has no word for.
[[nodiscard]] std::vector<CoqLeg> read_coq_legs(const WrittenValues& values,
                                                const LegNumbers& numbers,
                                                std::set<std::string>& read);

}  // namespace regulus::verifier
