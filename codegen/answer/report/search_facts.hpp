// SPDX-License-Identifier: GPL-3.0-or-later
// What every answer tells of its question and of its search.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Tells the model, its file and its hash, and the motion.
void tell_model(const SearchSubject& preparation, Facts& facts);
void tell_model(const Request& request, Facts& facts);
/// Tells them to programs alone.
void add_model(const SearchSubject& preparation, Facts& facts);
void add_model(const Request& request, Facts& facts);
/// Tells the question as json_question() returns it, its options and version, engine and threads.
void add_search(const SearchOptions& search, const nlohmann::ordered_json& question, Facts& facts);
/// Returns a question without what the head of each report has.
[[nodiscard]] nlohmann::ordered_json without_head(nlohmann::ordered_json question);
/// Tells model, motion, matrix, threshold and uncertain quantities: all that the claim is about.
void tell_question(const SearchSubject& preparation, const Request& request, Facts& facts);
/// Tells α: approximately, and its enclosure.
void tell_threshold(const SearchSubject& preparation, Facts& facts);
/// Tells method and engine, after a search of `boxes`.
void tell_method(const PreparedSearch& preparation, const SearchOptions& search, Method method,
                 std::uint64_t boxes, Facts& facts);
void tell_time(const StageSeconds& seconds, Facts& facts);
/// Tells whether the constraints leave any pose. People have a warning if this is not known.
void tell_occupancy(const Result& result, Facts& facts);

/// Returns "full 6×6 matrix", for example.
[[nodiscard]] std::string describe_size(const SearchSubject& preparation);
/// Returns the poses that a claim is about: "pose of the motion", "reachable pose of the motion".
[[nodiscard]] const char* describe_pose(const SearchSubject& preparation);
/// Returns "model 1.2 ms, …": the times of the stages.
[[nodiscard]] std::string describe_time(const StageSeconds& seconds);

[[nodiscard]] nlohmann::ordered_json json_seconds(const StageSeconds& seconds);
/// The same of an answer that tells of its search alone.
[[nodiscard]] nlohmann::ordered_json json_seconds(double search);
[[nodiscard]] const char* json_name(Verdict verdict);
/// Returns true, false or null: whether the constraints leave any pose.
[[nodiscard]] nlohmann::ordered_json json_occupancy(const Result& result);

}  // namespace regulus::detail
