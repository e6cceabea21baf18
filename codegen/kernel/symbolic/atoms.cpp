// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/atoms.hpp"

#include <algorithm>
#include <iterator>

#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {

AtomTable::AtomTable(const std::vector<std::string>& variables,
                     const std::vector<std::string>& points, WorkMeter* meter)
    : meter_(meter) {
  for (const std::string& name : variables) {
    declared_.emplace(name, declared_.size());
    static_cast<void>(variable_atom(variable(name)));
  }
  for (const std::string& name : points) static_cast<void>(coefficient_atom(point(name)));
}

std::size_t AtomTable::first_variable(const Expression& e) const {
  std::size_t first = declared_.size();
  for (const auto& [name, count] : count_occurrences(e)) {
    const auto found = declared_.find(name);
    if (found != declared_.end()) first = std::min(first, found->second);
  }
  return first;
}

Atom AtomTable::number(const Expression& e, Series& series) {
  const auto [entry, added] = series.numbers.emplace(e, static_cast<Atom>(series.list.size()));
  if (!added) return entry->second;
  constexpr std::size_t kMostAtoms = 0xffff;
  if (series.list.size() >= kMostAtoms)
    throw InputError::statement("", 0, "the model has more than 65535 distinct sub-expressions",
                                "simplify its expressions");
  series.list.push_back(e);
  if (&series == &variables_) ranks_.push_back(first_variable(e));
  return entry->second;
}

bool AtomTable::precedes(Atom a, Atom b) const {
  if (ranks_[a] != ranks_[b]) return ranks_[a] < ranks_[b];
  return compare(variables_.list[a], variables_.list[b]) < 0;
}

AtomProduct multiply(const AtomProduct& a, const AtomProduct& b) {
  if (b.empty()) return a;
  if (a.empty()) return b;
  AtomProduct result(a.size() + b.size(), u'\0');
  std::merge(a.begin(), a.end(), b.begin(), b.end(), result.begin());
  return result;
}

bool divide(const AtomProduct& a, const AtomProduct& b, AtomProduct& quotient) {
  if (!std::includes(a.begin(), a.end(), b.begin(), b.end())) return false;
  quotient.clear();
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(quotient));
  return true;
}

bool lex_greater(const AtomProduct& a, const AtomProduct& b) noexcept {
  const std::size_t shared = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < shared; ++i)
    if (a[i] != b[i]) return a[i] < b[i];
  return a.size() > b.size();
}

int exponent_of(const AtomProduct& p, Atom a) noexcept {
  return static_cast<int>(std::count(p.begin(), p.end(), a));
}

}  // namespace regulus::detail
