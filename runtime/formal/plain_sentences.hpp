// SPDX-License-Identifier: Apache-2.0
// The sentences of a theorem file, one after the other.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_tokens.hpp"

namespace regulus::verifier {

using Sentence = std::vector<CoqToken>;

template <std::size_t N>
bool is_one_of(std::string_view text, const std::array<std::string_view, N>& all) {
  return std::ranges::find(all, text) != all.end();
}

class PlainSentences {
 public:
  /// `text` must outlive this object. Throws Rejection for a text that is not plain.
  explicit PlainSentences(std::string_view text);

  [[nodiscard]] bool at_end() const noexcept { return at_ >= sentences_.size(); }
  /// Returns the current sentence; an empty one at the end.
  [[nodiscard]] const Sentence& words() const;
  /// Returns it with single spaces.
  [[nodiscard]] std::string current() const { return joined(words()); }
  void next() noexcept { ++at_; }
  /// Goes on to the next sentence; throws Rejection if the current one is another.
  void expect(std::string_view sentence);
  /// Throws Rejection, with the line.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::vector<Sentence> sentences_;
  std::size_t at_ = 0, last_line_ = 1;
};

}  // namespace regulus::verifier
