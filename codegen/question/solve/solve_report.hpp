// SPDX-License-Identifier: GPL-3.0-or-later
// What an answer about all solutions tells.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// Returns "COMPLETE: 6 poses", "NONE" or "INCOMPLETE: at least 2 poses".
[[nodiscard]] std::string describe_result(const Solutions& solutions, const SolvedNoun& noun);

/// Returns the claim as a sentence.
[[nodiscard]] std::string describe_claim(const Solutions& solutions, const SolvedNoun& noun);

/// Returns "complete", "none" or "incomplete".
[[nodiscard]] const char* word_of(const Solutions& solutions) noexcept;

/// What was asked about all places.
struct SolveAsked {
  const Request& request;  ///< at the place, or at the first of many
  const SearchOptions& search;
  const std::vector<std::string>& held;
};

/// Returns everything that the boxes of the searches depend on, for a checkpoint. `places`: a digest of
/// many places; empty: there is one.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const SolveAsked& asked,
                                                           const std::string& places);

void tell_solutions(const SolveAsked& asked, const Solutions& solutions, const SolvedNoun& noun,
                    Facts& facts);

/// Returns the numbers of the place that is asked about.
[[nodiscard]] std::vector<PlacedValue> placed_values(const Request& request);

[[nodiscard]] nlohmann::ordered_json json_solved(const SolvedPlace& place, const Model& model,
                                                 const SolvedNoun& noun);
/// Returns how many places have each answer, the worst first, and how many solutions they have. `left`:
/// places that were not asked.
[[nodiscard]] std::string describe_places(const std::vector<SolvedPlace>& places,
                                          std::uint64_t left, const SolvedNoun& noun);
/// Returns ", t = 0.2 s"; nothing for a place without a time.
[[nodiscard]] std::string describe_time(const SolvedPlace& place, const std::string& unit);

/// The parts of a report about many places that it shares with that about one.
void tell_places_asked(const SolveAsked& asked, const std::vector<SolvedUnknown>& unknowns,
                       Facts& facts);

}  // namespace regulus::detail
