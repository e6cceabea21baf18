// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in sin(...), cos(...) and tan(...) that may be meant as degrees.
#include <algorithm>
#include <array>
#include <optional>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/lexer.hpp"
#include "codegen/model/file/sections.hpp"

namespace regulus::detail {
namespace {

bool is_circular(const Token& name) {
  constexpr std::array<std::string_view, 3> kFunctions{"sin", "cos", "tan"};
  return name.kind == Token::Kind::kName &&
         std::ranges::find(kFunctions, name.text) != kFunctions.end();
}

bool is_one_of(const Token& token, std::string_view symbols) {
  return token.kind == Token::Kind::kSymbol && symbols.find(token.text.front()) != symbols.npos;
}

bool is_beyond_a_turn(std::string_view number) {
  const auto value = exact_decimal(number);
  return value && value->to_double() > kOneTurn;
}

/// Returns a number beyond a turn that is added to an angle, or is one.
std::optional<std::string_view> angle_beyond_a_turn(std::string_view text) {
  Lexer lexer(text);
  std::vector<bool> in_angle;  // for each open parenthesis
  Token before, token = lexer.next();
  for (Token next; token.kind != Token::Kind::kEnd; before = token, token = next) {
    next = lexer.next();
    const bool is_inside = !in_angle.empty() && in_angle.back();
    if (token.is('('))
      in_angle.push_back(is_circular(before) || (is_inside && is_one_of(before, "(+-")));
    if (token.is(')') && !in_angle.empty()) in_angle.pop_back();
    if (token.kind == Token::Kind::kNumber && is_inside && is_one_of(before, "(+-") &&
        is_one_of(next, ")+-") && is_beyond_a_turn(token.text))
      return token.text;
  }
  return std::nullopt;
}

void warn_about_text(ModelReading& reading, const TomlEntry& entry, const std::string& text) {
  const auto angle = angle_beyond_a_turn(text);
  if (!angle) return;
  const Place place = reading.toml.place(entry);
  reading.model.warnings.push_back(
      (place.file.empty() ? "" : place.file + ":" + std::to_string(place.line) + ": ") + place.key +
      " has the angle " + std::string(*angle) +
      " rad, more than a turn; if degrees are meant, write " + std::string(*angle) + "deg");
}

}  // namespace

void warn_about_written_angles(ModelReading& reading, const TomlEntry& root) {
  const TomlReader& toml = reading.toml;
  if (const auto* text = root.node->as_string()) return warn_about_text(reading, root, text->get());
  std::vector<TomlEntry> parts;
  if (root.node->is_table()) parts = toml.entries(root);
  if (root.node->is_array()) parts = toml.elements(root, "a list");
  for (const TomlEntry& part : parts)
    if (part.path != "name" && part.path != "source") warn_about_written_angles(reading, part);
}

}  // namespace regulus::detail
