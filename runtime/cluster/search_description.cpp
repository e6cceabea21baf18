// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/search_description.hpp"

#include "runtime/cluster/bytes.hpp"

namespace regulus::detail::cluster {
namespace {

void put(ByteWriter& to, const Problem& problem) {
  to.put_list(std::span<const Interval>(problem.outer));
  to.put_count(problem.inner.size());
  for (const std::optional<Interval>& inner : problem.inner) {
    to.put(inner.has_value());
    if (inner) to.put(*inner);
  }
  to.put(problem.alpha);
  to.put(problem.determinant_exponent);
  to.put_list(std::span<const std::uint8_t>(problem.idle));
}

Problem take_problem(ByteReader& from) {
  Problem problem;
  problem.outer = from.take_list<Interval>();
  for (std::uint64_t left = from.take_count(); left > 0; --left)
    problem.inner.push_back(from.take<bool>() ? std::optional(from.take<Interval>())
                                              : std::nullopt);
  problem.alpha = from.take<Interval>();
  problem.determinant_exponent = from.take<int>();
  problem.idle = from.take_list<std::uint8_t>();
  return problem;
}

/// Calls `each` for each setting on which an outcome depends.
template <typename SettingsType, typename Each>
void for_each_setting(SettingsType& settings, const Each& each) {
  each(settings.method);
  each(settings.determinant);
  each(settings.uncertainty);
  each(settings.entries);
  each(settings.bisection);
  each(settings.min_relative_width);
  each(settings.batch);
  each(settings.boxes_of_unit);
  each(settings.exhaustive);
  each(settings.split_certified);
  each(settings.enclose_determinants);
  each(settings.ingredients);
}

void put(ByteWriter& to, const WitnessCandidates::Candidate& candidate) {
  to.put_list(std::span<const double>(candidate.point));
  to.put(candidate.approx);
  to.put(candidate.tried);
}

WitnessCandidates::Candidate take_candidate(ByteReader& from) {
  WitnessCandidates::Candidate candidate;
  candidate.point = from.take_list<double>();
  candidate.approx = from.take<double>();
  candidate.tried = from.take<double>();
  return candidate;
}

void put(ByteWriter& to, const Learned& learned) {
  const WitnessCandidates& candidates = learned.candidates;
  to.put(learned.threshold.value());
  for (const auto* one : {&candidates.positive, &candidates.negative, &candidates.small})
    put(to, *one);
  to.put(candidates.small_known);
  to.put(candidates.small_fresh);
  to.put(candidates.small_tries);
}

Learned take_learned(ByteReader& from) {
  Learned learned;
  WitnessCandidates& candidates = learned.candidates;
  learned.threshold = AdaptiveThreshold(from.take<double>());
  for (auto* one : {&candidates.positive, &candidates.negative, &candidates.small})
    *one = take_candidate(from);
  candidates.small_known = from.take<bool>();
  candidates.small_fresh = from.take<bool>();
  candidates.small_tries = from.take<unsigned>();
  return learned;
}

}  // namespace

std::string write_search(const Problem& problem, const Settings& settings, const Learned& learned) {
  ByteWriter bytes;
  put(bytes, problem);
  for_each_setting(settings, [&bytes](const auto& setting) { bytes.put(setting); });
  bytes.put_list(std::span<const double>(settings.weights));
  put(bytes, learned);
  return bytes.take();
}

SearchDescription read_search(std::string_view text) {
  ByteReader reader(text);
  SearchDescription search;
  search.problem = take_problem(reader);
  for_each_setting(search.settings, [&reader](auto& setting) {
    setting = reader.take<std::remove_reference_t<decltype(setting)>>();
  });
  search.settings.weights = reader.take_list<double>();
  search.learned = take_learned(reader);
  if (!reader.at_end()) throw MalformedMessage();
  return search;
}

}  // namespace regulus::detail::cluster
