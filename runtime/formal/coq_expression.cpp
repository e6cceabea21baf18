// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_expression.hpp"

#include <algorithm>

#include "runtime/formal/coq_tokens.hpp"
#include "runtime/verifier/infix_reader.hpp"

namespace regulus::verifier {
namespace {

/// Takes the longest beginning of `text` of which every character satisfies `is_part`.
template <class Predicate>
std::string_view take_while(std::string_view& text, Predicate is_part) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_part);
  const std::string_view taken = text.substr(0, std::size_t(end - text.begin()));
  text.remove_prefix(taken.size());
  return taken;
}

/// Takes a decimal. Coq wants a digit before and after the point.
std::string take_number(std::string_view& text) {
  std::string number(take_while(text, is_digit));
  if (number.empty()) number.push_back('0');
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::string_view digits = take_while(text, is_digit);
    if (!digits.empty()) number.append(1, '.').append(digits);
  }
  if (text.starts_with('e')) {
    text.remove_prefix(1);
    number += 'e';
    if (text.starts_with('-') || text.starts_with('+')) {
      number += text.front();
      text.remove_prefix(1);
    }
    number += take_while(text, is_digit);
  }
  return number;
}

}  // namespace

std::string coq_identifier(std::string_view name) { return std::string("_").append(name); }

std::string coq_expression(std::string_view text, const CoqNames& names) {
  std::string result;
  while (!text.empty()) {
    const char c = text.front();
    if (is_letter(c)) {
      const std::string_view name =
          take_while(text, [](char x) { return is_letter(x) || is_digit(x) || x == '_'; });
      result += is_reserved(name) ? std::string(name) : names.find(name)->second;
    } else if (is_digit(c) || c == '.') {
      result += take_number(text);
    } else {
      // "--" and "(*" are words of Coq.
      const bool is_operator = c == '-' || c == '*';
      const bool follows_space = result.empty() || result.back() == ' ' || result.back() == '(';
      if (is_operator && !follows_space) result += ' ';
      if (c != ' ' || !follows_space) result += c;
      if (is_operator) result += ' ';
      text.remove_prefix(1);
    }
  }
  return result;
}

std::string coq_comment(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view rest = text;
    const char32_t c = take_character(text);
    const std::string_view bytes = rest.substr(0, rest.size() - text.size());
    if ((c == '*' || c == ')') && !result.empty() && (result.back() == '(' || result.back() == '*'))
      result += ' ';
    if (c == '"')
      result += '\'';
    else
      result += is_plain_character(c) ? bytes : "?";
  }
  return result;
}

}  // namespace regulus::verifier
