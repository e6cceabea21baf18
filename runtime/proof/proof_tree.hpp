// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace regulus::detail {

/// The tree of boxes of a certificate, from its lines in any order that is valid.
class ProofTree {
 public:
  struct Node {
    union {
      double at = 0;         ///< of a split
      std::uint64_t offset;  ///< of a leaf: of its line in the file, in bytes
    };
    std::uint32_t lower = 0;  ///< the number of the lower half; 0: it is a leaf
    std::uint16_t variable = 0;
    std::uint16_t rule = 0;  ///< of a leaf
  };

  /// Takes a line of the proof. Returns false if it is the line `end`. Throws std::runtime_error,
  /// whose text completes the sentence "the certificate cannot ...". `offset`: of the line.
  [[nodiscard]] bool add(const std::string& line, std::uint64_t offset);

  [[nodiscard]] const Node& node(std::uint64_t box) const { return nodes_.at(box); }
  /// Returns nullptr for a tube: its numbers are in the line of the leaf alone.
  [[nodiscard]] const std::string* rule(const Node& leaf) const {
    return leaf.rule == kTube ? nullptr : &rules_.at(leaf.rule);
  }

 private:
  static constexpr std::uint16_t kTube = 0xffff;

  void split(const char* words);
  void leave(const char* words, std::uint64_t offset);

  std::vector<Node> nodes_ = std::vector<Node>(1);
  std::vector<std::string> rules_;
};

}  // namespace regulus::detail
