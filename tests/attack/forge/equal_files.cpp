// SPDX-License-Identifier: GPL-3.0-or-later
// Model files that differ in the spelling of numbers alone.
#include <stdexcept>
#include <string>

#include "tests/attack/forge/same_question.hpp"
#include "tests/attack/forge/words.hpp"
#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::detail::attack {
namespace {

/// Returns the end of a number of a file that begins there, in any of its spellings.
std::size_t end_of_number(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (is_word(text[end]) || text[end] == '.' ||
                               ((text[end] == '-' || text[end] == '+') && end > begin &&
                                (text[end - 1] == 'e' || text[end - 1] == 'E'))))
    ++end;
  return end;
}

/// The numbers are replaced by their values.
std::string with_plain_numbers(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    const bool begins = is_digit(text[i]) && (i == 0 || !is_word(text[i - 1]));
    const std::size_t end = begins ? end_of_number(text, i) : i + 1;
    std::string word = text.substr(i, end - i);
    if (begins) try {
        word = toml_number(word).fraction();
      } catch (const std::invalid_argument&) {  // it is a name
      }
    plain += word;
    i = end;
  }
  for (std::size_t at; (at = plain.find("(-0)")) != std::string::npos;) plain.replace(at, 4, "0");
  return plain;
}

}  // namespace

bool are_equal_files(const std::string& a, const std::string& b) {
  return with_plain_numbers(a) == with_plain_numbers(b);
}

}  // namespace regulus::detail::attack
