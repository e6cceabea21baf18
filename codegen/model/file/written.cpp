// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/written.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/names.hpp"

namespace regulus {

using namespace detail;

namespace {

constexpr std::size_t kDigitsOfAnInteger = 15;  // far below TOML's limits

bool is_integer(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.size() <= kDigitsOfAnInteger &&
         text.find_first_not_of("0123456789") == std::string_view::npos &&
         (text.size() == 1 || text.front() != '0');
}

std::string escaped(char c) {
  std::array<char, 8> code{};
  std::snprintf(code.data(), code.size(), "\\u%04X", static_cast<unsigned>(c));
  return code.data();
}

}  // namespace

void write_once(WrittenSection& section, const std::string& what, WrittenLine line) {
  const auto first = std::ranges::find(section, line.key, &WrittenLine::key);
  if (first != section.end())
    throw mistake(line.place,
                  what + " is given twice, first at line " + std::to_string(first->place.line()),
                  "give it once", line.key);
  section.push_back(std::move(line));
}

std::string written(std::string_view label) {
  std::string text = "\"";
  for (const char c : label) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (c == '"' || c == '\\') text += '\\';
    text += control ? escaped(c) : std::string(1, c);
  }
  return text + '"';
}

std::string written(const Formula& formula) {
  return is_integer(formula.text()) ? formula.text() : written(std::string_view(formula.text()));
}

std::string written(const std::vector<Formula>& formulas) {
  std::string text;
  for (const Formula& formula : formulas) text += (text.empty() ? "" : ", ") + written(formula);
  return std::string("[").append(text) + ']';
}

std::string written_key(const std::string& key) {
  return is_name(key) ? key : written(std::string_view(key));
}

void WrittenSymbols::declare(const GiNaC::symbol& symbol) {
  declared_.insert_or_assign(symbol.get_name(), symbol);
}

void WrittenSymbols::use(const Formula& formula, const SourcePlace& place) {
  for (const GiNaC::ex& symbol : formula.symbols()) used_.push_back({symbol, place});
}

void WrittenSymbols::use(const std::vector<Formula>& formulas, const SourcePlace& place) {
  for (const Formula& formula : formulas) use(formula, place);
}

bool WrittenSymbols::declares(const GiNaC::ex& symbol) const {
  const auto at = declared_.find(formula_text(symbol));
  return at != declared_.end() && at->second.is_equal(symbol);
}

void WrittenSymbols::require_declared(const WrittenSymbols* outer) const {
  for (const auto& [symbol, place] : used_)
    if (!declares(symbol) && (outer == nullptr || !outer->declares(symbol)))
      throw mistake(
          place,
          "the GiNaC symbol " + in_quotes(formula_text(symbol)) + " was not given to the robot",
          "declare it; another symbol of the same name does not count", formula_text(symbol));
}

InputError mistake(const SourcePlace& place, const std::string& problem, const std::string& remedy,
                   const std::string& symbol) {
  return InputError::statement(place.file_name(), static_cast<int>(place.line()), problem, remedy,
                               symbol);
}

}  // namespace regulus
