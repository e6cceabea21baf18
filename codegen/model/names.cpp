// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/names.hpp"

#include <algorithm>
#include <numeric>

#include "codegen/model/exact/real_functions.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr std::size_t kLongestQuote = 40;
constexpr std::size_t kLongestLabel = 200;
constexpr std::size_t kMostAlternatives = 20;

bool is_letter(char c) noexcept { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }
bool is_digit(char c) noexcept { return '0' <= c && c <= '9'; }

/// Levenshtein's distance, by rows.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, substituted}));
    }
  }
  return row.back();
}

std::string joined(std::span<const std::string> words, std::string_view last) {
  const std::size_t shown = std::min(words.size(), kMostAlternatives);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == words.size() ? last : ", ";
    text += words[i];
  }
  return shown < words.size() ? text + " …" : text;
}

/// True for k_ digits _ digits: the symbolic stage gives these names to the entries of K.
bool is_preconditioner_entry(std::string_view name) {
  if (!name.starts_with("k_")) return false;
  const std::size_t bar = name.find('_', 2);
  if (bar == std::string_view::npos || bar == 2 || bar + 1 == name.size()) return false;
  const auto all_digits = [](std::string_view s) { return std::ranges::all_of(s, is_digit); };
  return all_digits(name.substr(2, bar - 2)) && all_digits(name.substr(bar + 1));
}

}  // namespace

bool is_name(std::string_view text) noexcept {
  return !text.empty() && text.size() <= kLongestName && is_letter(text.front()) &&
         std::ranges::all_of(text, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

bool is_reserved(std::string_view name) {
  return name == "pi" || name == "deg" || is_function(name) || is_preconditioner_entry(name);
}

std::string nearest(std::string_view name, std::span<const std::string> candidates) {
  if (name.size() > kLongestName) return {};
  std::size_t fewest = name.size() / 3 + 2;
  const std::string stem = std::string(name) + "_";
  std::string best;
  for (const std::string& candidate : candidates) {
    const bool is_stem = candidate.starts_with(stem);
    const std::size_t distance = is_stem ? 1 : edit_distance(name, candidate);
    if (distance < fewest && distance < candidate.size()) fewest = distance, best = candidate;
  }
  return best;
}

std::string alternatives(std::span<const std::string> words) { return joined(words, " or "); }

std::string enumeration(std::span<const std::string> words) { return joined(words, ", "); }

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates,
                       const std::string& otherwise) {
  const std::string meant = nearest(name, candidates);
  return meant.empty() ? otherwise : "did you mean " + in_quotes(meant) + "?";
}

std::string_view first_bytes(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  const auto continues = [&](std::size_t at) { return (text[at] & 0xC0) == 0x80; };
  while (most > 0 && continues(most)) --most;
  return text.substr(0, most);
}

std::string in_quotes(std::string_view text) {
  const std::string_view shown = first_bytes(text, kLongestQuote);
  return '\'' + visible(shown) + (shown.size() < text.size() ? "…'" : "'");
}

bool is_label(std::string_view text) noexcept {
  return text.size() <= kLongestLabel && text.find('\\') == std::string_view::npos &&
         visible(text) == text;
}

}  // namespace regulus::detail
