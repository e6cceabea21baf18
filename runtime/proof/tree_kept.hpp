// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/proof/proof_file.hpp"

namespace regulus::detail {

/// Returns the word of FORMAT.md for the rule of a leaf.
using LeafWord = const char* (*)(Rule) noexcept;

/// Keeps the tree of a search until it is known if, and where, it is written: 24 bytes for each box.
class TreeKept final : public Observer {
 public:
  void on_split(const OpenBox&, const Split& split) noexcept override { this->split(split); }
  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    leaf(box.id, rule);
  }
  void split(const Split& split) noexcept;
  void leaf(BoxId box, Rule rule) noexcept;

  /// Notes that a part of the tree is lost.
  void lose() noexcept { is_whole_ = false; }
  /// Forgets the tree: another search begins.
  void clear() noexcept;
  /// Throws std::bad_alloc if there was no memory for some of it.
  void write_to(ProofFile& file, LeafWord word) const;

 private:
  struct Event {
    BoxId box;
    double at;               ///< of a split
    std::uint32_t variable;  ///< the same; kNone: it is a leaf
    Rule rule;               ///< of a leaf
  };
  static constexpr std::uint32_t kNone = std::uint32_t(-1);
  void keep(const Event& event) noexcept;

  std::vector<Event> events_;
  bool is_whole_ = true;
};

}  // namespace regulus::detail
