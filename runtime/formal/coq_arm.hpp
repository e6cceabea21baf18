// SPDX-License-Identifier: Apache-2.0
// The parts of an arm, [serial], as the verifier's reader finds them in a model file, in the words of
// Arms.v.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/verifier/model/model_file.hpp"

namespace regulus::verifier {

/// A part of an arm: `text`, and behind it the value of a joint that moves, which is
/// multiplier·q + offset for the pose parameter q; no multiplier and no offset: q.
struct CoqPart {
  std::string text;
  std::optional<std::size_t> joint;  ///< its pose parameter, from 0
  std::string multiplier{}, offset{};
  bool is_in_degrees = false;
  bool follows = false;  ///< another joint, `multiplier` times as fast
};

/// Reads the value at a place of the file as a real number of Coq, without names of the motion. `name`: of
/// the quantity if the value may have a tolerance; its angle is in radians. Empty: a number as it is in the
/// file.
using CoqTextAt =
    std::function<std::string(const std::string& place, const std::string& name, bool is_angle)>;

/// Returns the parts from the base to the tool, and adds to `read` the places that have a meaning.
/// Throws Unfinished for what Arms.v has no word for.
[[nodiscard]] std::vector<CoqPart> read_coq_parts(const WrittenValues& values,
                                                  const CoqTextAt& text_at,
                                                  std::set<std::string>& read);

/// Returns the part with these words for the pose parameters.
[[nodiscard]] std::string coq_part(const CoqPart& part, const std::vector<std::string>& joints);

}  // namespace regulus::verifier
