// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/identifiers.hpp"

#include <algorithm>
#include <array>

#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kLongest = 60;  ///< leaves room for a number

/// Keys of a motion, beside which its joints stand.
constexpr std::array<const char*, 4> kMotionKeys = {"parameters", "constraints", "alpha", "error"};

bool is_free(const std::string& name) {
  return is_name(name) && !is_reserved(name) && name.size() <= kLongest &&
         std::ranges::find(kMotionKeys, name) == kMotionKeys.end();
}

std::string made_of(const std::string& name) {
  std::string made;
  for (const char c : name) {
    const std::string one(1, c);
    made += is_name("a" + one) ? c : '_';
  }
  made.resize(std::min(made.size(), kLongest - 2));
  return is_free(made) ? made : "q_" + made;
}

}  // namespace

std::string Identifiers::of(const std::string& name) {
  const std::string first = is_free(name) ? name : made_of(name);
  std::string made = first;
  for (int number = 2; !used_.insert(made).second; ++number)
    made = first + "_" + std::to_string(number);
  if (made != name) changes_.push_back(in_quotes(name) + " is " + made);
  return made;
}

}  // namespace regulus::detail
