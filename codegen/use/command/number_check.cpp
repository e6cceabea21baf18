// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/number_check.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

template <class Number>
std::optional<Number> number_in(const std::string& word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

std::string found(const std::string& word, const std::string& expected) {
  return "found " + in_quotes(word) + ", expected " + expected;
}

/// The description is empty: the help shows the name of the value alone.
template <class Accepts>
CLI::Validator check(const std::string& expected, Accepts accepts) {
  return {[expected, accepts](const std::string& word) -> std::string {
            return accepts(word) ? "" : found(word, expected);
          },
          ""};
}

std::string range_text(std::uint64_t least, std::uint64_t most) {
  return "from " + std::to_string(least) +
         (most == UINT64_MAX ? " on" : " to " + std::to_string(most));
}

}  // namespace

CLI::Validator positive_seconds() {
  return check("a number of seconds above 0", [](const std::string& word) {
    const auto number = number_in<double>(word);
    return number && std::isfinite(*number) && *number > 0;
  });
}

CLI::Validator number_from_zero(const std::string& what) {
  return check(what + ", 0 or more", [](const std::string& word) {
    const auto number = number_in<double>(word);
    return number && std::isfinite(*number) && *number >= 0;
  });
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return check("a whole number " + range_text(least, most), [least, most](const std::string& word) {
    const auto number = number_in<std::uint64_t>(word);
    return number && *number >= least && *number <= most;
  });
}

CLI::Validator size_in_bytes(std::uint64_t least, std::uint64_t most) {
  return {[least, most](std::string& word) -> std::string {
            std::string bytes = word;
            try {
              const std::string error = CLI::AsSizeValue(true)(bytes);
              const auto number = number_in<std::uint64_t>(bytes);
              if (error.empty() && number && *number >= least && *number <= most) {
                word = bytes;
                return "";
              }
            } catch (const CLI::ParseError&) {
              // Its message lists all units; ours shows one.
            }
            return found(word, "a size " + range_text(least, most) + " bytes, such as 64MB");
          },
          ""};
}

}  // namespace regulus::detail
