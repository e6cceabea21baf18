// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of the files of --checkpoint, as one who knows the format makes them.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/checkpoint/checkpoint.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail::test {

using nlohmann::json;

/// Calls change(tree) for each tree in a file.
inline void for_each_tree(json& saved, const std::function<void(json&)>& change) {
  for (json& entry : saved.at("known"))
    if (entry.is_object() && entry.contains("steps")) change(entry);
}

inline bool has_tree(json saved) {
  bool is_there = false;
  for_each_tree(saved, [&is_there](json&) { is_there = true; });
  return is_there;
}

inline std::vector<std::string> words_of(const json& text) {
  std::istringstream in(text.get<std::string>());
  return {std::istream_iterator<std::string>(in), {}};
}

inline std::string text_from(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + ' ';
  return text;
}

/// Changes the lines of the state of a search, and signs it again.
inline void change_state(json& tree, const std::function<void(std::vector<std::string>&)>& change) {
  if (!tree.contains("state")) return;
  std::istringstream in(tree["state"].get<std::string>());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  lines.pop_back();
  change(lines);
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  tree["state"] = text + end_of_checkpoint(text);
}

/// Leaves the first open boxes out of the state.
inline void leave_out_of_state(json& tree, std::size_t count) {
  change_state(tree, [count](std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].starts_with("units")) lines[i] = "units";
      if (!lines[i].starts_with("open ")) continue;
      const std::size_t open = lines.size() - i - 1, gone = std::min(open, count);
      lines.erase(lines.end() - std::ptrdiff_t(open), lines.end() - std::ptrdiff_t(open - gone));
      lines[i] = "open " + std::to_string(open - gone);
    }
  });
}

/// The claims that a leaf may have: of a rule, a bound of a condition number, none.
inline const std::vector<std::string> kClaims = {"=0x0p+0",   "=0x1p+0", "=0x1.8p+1", "=0x1.4p+2",
                                                 "=0x1.2p+3", "=0x1p-3", "=0x1.6p+3", "-"};

/// All open boxes are leaves that claim this.
inline json with_leaves_for_open(json saved, const std::string& claim) {
  for_each_tree(saved, [&](json& tree) {
    std::vector<std::string> steps = words_of(tree["steps"]);
    for (const std::string& word : words_of(tree["open"]))
      steps.push_back(word.substr(0, word.find_first_of("-=")) + claim);
    tree["steps"] = text_from(steps);
    tree["open"] = "";
    leave_out_of_state(tree, ~std::size_t{0});
  });
  return saved;
}

/// All leaves have another claim.
inline json with_claims(json saved, const std::string& claim) {
  for_each_tree(saved, [&](json& tree) {
    std::vector<std::string> steps = words_of(tree["steps"]);
    for (std::string& word : steps)
      if (word.find(':') == std::string::npos)
        word = word.substr(0, word.find_first_of("-=")) + claim;
    tree["steps"] = text_from(steps);
  });
  return saved;
}

/// A box is missing: the open one that comes first, or a leaf.
inline json without_open(json saved) {
  for_each_tree(saved, [](json& tree) {
    std::vector<std::string> open = words_of(tree["open"]);
    if (!open.empty()) open.erase(open.begin());
    tree["open"] = text_from(open);
    leave_out_of_state(tree, 1);
  });
  return saved;
}
inline json without_leaf(json saved) {
  for_each_tree(saved, [](json& tree) {
    std::vector<std::string> steps = words_of(tree["steps"]);
    const auto leaf = std::ranges::find_if(
        steps, [](const std::string& word) { return word.find(':') == std::string::npos; });
    if (leaf != steps.end()) steps.erase(leaf);
    tree["steps"] = text_from(steps);
  });
  return saved;
}

/// The boxes that are left are smaller.
inline json with_smaller_boxes(json saved) {
  for_each_tree(saved, [](json& tree) {
    change_state(tree, [](std::vector<std::string>& lines) {
      for (std::string& line : lines)
        if (line.starts_with("b ")) {
          const std::size_t colon = line.rfind(':'), space = line.rfind(' ');
          line.replace(colon, line.size(), ':' + line.substr(space + 1, colon - space - 1));
        }
    });
  });
  return saved;
}

/// Every search of a bracket has proved its value.
inline json with_proved_values(json saved) {
  if (saved["known"].contains("brackets"))
    for (json& bracket : saved["known"]["brackets"])
      for (json& entry : bracket) entry["certified"] = true, entry["reason"] = 0;
  return saved;
}

/// Every search of a bracket has ended in vain, so that the next values are others.
inline json with_failures(json saved, Reason reason) {
  if (saved["known"].contains("brackets"))
    for (json& bracket : saved["known"]["brackets"])
      for (json& entry : bracket)
        entry["certified"] = false, entry["reason"] = static_cast<int>(reason);
  return saved;
}

/// Each search says that it took more boxes than it has, or than it was allowed.
inline json with_more_boxes(json saved) {
  for_each_tree(saved, [](json& tree) {
    change_state(tree, [](std::vector<std::string>& lines) {
      for (std::string& line : lines)
        if (line.starts_with("boxes ")) {
          std::istringstream in(line.substr(6));
          std::uint64_t boxes = 0, most = 0, points = 0;
          in >> boxes >> most >> points;
          line = "boxes " + std::to_string(boxes + 1) + " 123456789 " + std::to_string(points);
        }
    });
  });
  if (saved["known"].contains("brackets"))
    for (json& bracket : saved["known"]["brackets"])
      for (json& entry : bracket)
        if (entry["most_boxes"] < std::uint64_t{1} << 32)
          entry["boxes"] = entry["most_boxes"].get<std::uint64_t>() + 1;
  return saved;
}

}  // namespace regulus::detail::test
