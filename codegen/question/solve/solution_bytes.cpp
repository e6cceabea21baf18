// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solution_bytes.hpp"

#include <span>

namespace regulus::detail {
namespace {

using cluster::ByteReader;
using cluster::ByteWriter;

template <class Number>
void put_numbers(ByteWriter& to, const std::vector<Number>& numbers) {
  to.put_list(std::span<const Number>(numbers));
}

template <class Number>
void put_lists(ByteWriter& to, const std::vector<std::vector<Number>>& lists) {
  to.put_each(lists, [&to](const auto& list) { put_numbers(to, list); });
}

template <class Number>
std::vector<std::vector<Number>> take_lists(ByteReader& from) {
  std::vector<std::vector<Number>> lists;
  from.take_each([&] { lists.push_back(from.take_list<Number>()); });
  return lists;
}

/// Takes a value of an enumeration whose greatest one is `last`.
template <class Word>
Word take_word(ByteReader& from, Word last) {
  const auto value = from.take<std::underlying_type_t<Word>>();
  if (value > static_cast<std::underlying_type_t<Word>>(last)) throw cluster::MalformedMessage();
  return static_cast<Word>(value);
}

void put(ByteWriter& to, const CertainSolution& solution) {
  put_numbers(to, solution.values);
  to.put(solution.condition);
  to.put(solution.sign);
  to.put(solution.limits);
  to.put_text(solution.beyond);
  put_numbers(to, solution.middle);
}

CertainSolution take_solution(ByteReader& from) {
  CertainSolution solution;
  solution.values = from.take_list<Interval>();
  solution.condition = from.take<double>();
  solution.sign = from.take<int>();
  solution.limits = take_word(from, WithinLimits::kUnknown);
  solution.beyond = from.take_text();
  solution.middle = from.take_list<double>();
  return solution;
}

}  // namespace

void put(ByteWriter& to, const Solutions& s) {
  to.put_each(s.unknowns, [&to](const SolvedUnknown& unknown) {
    to.put_text(unknown.name);
    to.put_text(unknown.unit);
    to.put(unknown.period);
    to.put(unknown.range.has_value());
    to.put(unknown.range.value_or(Interval(0.0)));
  });
  to.put(s.is_nominal);
  to.put_each(s.found, [&to](const CertainSolution& solution) { put(to, solution); });
  to.put(s.completeness);
  to.put_text(s.how);
  to.put_text(s.obstacle);
  to.put(s.changes);
  put_lists(to, s.open);
  to.put(s.is_counted);
  to.put(s.complex_found.has_value());
  to.put(s.complex_found.value_or(0));
  put_lists(to, s.roots);
  to.put(s.opposite);
  to.put(s.left_out.has_value());
  put_numbers(to, s.left_out.value_or(std::vector<std::size_t>{}));
  to.put(s.boxes);
  to.put(s.seconds);
  to.put(s.stopped_by.has_value());
  to.put(s.stopped_by.value_or(Reason{}));
}

Solutions take_solutions(ByteReader& from) {
  Solutions s;
  from.take_each([&] {
    SolvedUnknown& unknown = s.unknowns.emplace_back();
    unknown.name = from.take_text();
    unknown.unit = from.take_text();
    unknown.period = from.take<double>();
    const bool has_range = from.take_flag();
    const auto range = from.take<Interval>();
    if (has_range) unknown.range = range;
  });
  s.is_nominal = from.take_flag();
  from.take_each([&] { s.found.push_back(take_solution(from)); });
  s.completeness = take_word(from, Completeness::kIncomplete);
  s.how = from.take_text();
  s.obstacle = from.take_text();
  s.changes = from.take_flag();
  s.open = take_lists<Interval>(from);
  s.is_counted = from.take_flag();
  const bool is_known = from.take_flag();
  const auto complex = from.take<std::uint64_t>();
  if (is_known) s.complex_found = complex;
  s.roots = take_lists<Complex>(from);
  s.opposite = from.take<std::size_t>();
  const bool has_pair = from.take_flag();
  const auto pair = from.take_list<std::size_t>();
  if (has_pair) s.left_out = pair;
  s.boxes = from.take<std::uint64_t>();
  s.seconds = from.take<double>();
  const bool is_stopped = from.take_flag();
  const auto reason = from.take<Reason>();
  if (is_stopped) s.stopped_by = reason;
  return s;
}

void put(ByteWriter& to, const ListProof& list) {
  for (const std::string* text : {&list.head, &list.proof, &list.obstacle, &list.doubt})
    to.put_text(*text);
}

ListProof take_list_proof(ByteReader& from) {
  ListProof list;
  for (std::string* text : {&list.head, &list.proof, &list.obstacle, &list.doubt})
    *text = from.take_text();
  return list;
}

}  // namespace regulus::detail
