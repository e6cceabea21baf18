// SPDX-License-Identifier: Apache-2.0
// The keys of a model file, for what prints its robot.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "runtime/verifier/model/model_file.hpp"

namespace regulus::verifier {

/// "[3]"
[[nodiscard]] inline std::string index(std::size_t i) { return '[' + std::to_string(i) + ']'; }

[[noreturn]] inline void refuse_model(const std::string& what) {
  throw Unfinished("there is no theorem about a model file with " + what + " yet");
}

class FileKeys {
 public:
  explicit FileKeys(const WrittenValues& values) : values_(values) {}

  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }
  [[nodiscard]] bool has_below(const std::string& table) const {
    const auto first = values_.lower_bound(table);
    return first != values_.end() && first->first.starts_with(table);
  }
  [[nodiscard]] std::string word(const std::string& place, const char* otherwise) const {
    const auto found = values_.find(place);
    return found == values_.end() ? otherwise : found->second.text;
  }

  /// `table`: with a dot behind its name.
  [[nodiscard]] std::set<std::string> keys_of(const std::string& table) const {
    std::set<std::string> keys;
    for (auto place = values_.lower_bound(table);
         place != values_.end() && place->first.starts_with(table); ++place) {
      const std::string rest = place->first.substr(table.size());
      keys.insert(rest.substr(0, rest.find_first_of(".[")));
    }
    return keys;
  }

  void require_known_keys(const std::string& table, const std::set<std::string>& known) const {
    for (const std::string& key : keys_of(table))
      if (!known.contains(key))
        refuse_model("the key '" + key + "' in [" + table.substr(0, table.size() - 1) + ']');
  }

 protected:
  const WrittenValues& values_;
};

}  // namespace regulus::verifier
