// SPDX-License-Identifier: GPL-3.0-or-later
// Damages texts, each seed in another way.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace regulus::detail::test {

class Damage {
 public:
  /// `splices`: what may be put into a text; they outlive this object.
  Damage(unsigned seed, const std::vector<std::string>& splices)
      : random_(seed), splices_(splices) {}

  std::string done_to(std::string text) {
    for (std::size_t edits = 1 + pick(3); edits-- > 0;) edit(text);
    return text;
  }

 private:
  std::size_t pick(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  void edit(std::string& text) {
    const std::size_t at = pick(text.size()), length = 1 + pick(12);
    const std::string& splice = splices_[pick(splices_.size())];
    switch (pick(5)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, splice);
        break;
      case 2:
        text.insert(pick(text.size()), text.substr(at, 8 * length));
        break;
      case 3:
        text[at] = static_cast<char>(pick(256));
        break;
      default:
        text.replace(at, length, splice);
    }
    if (text.empty()) text.assign(1, 'x');
  }

  std::mt19937_64 random_;
  const std::vector<std::string>& splices_;
};

}  // namespace regulus::detail::test
