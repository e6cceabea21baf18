// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/paving_tree.hpp"

#include <fmt/format.h>

namespace regulus::detail {

void PavingTree::on_split(const OpenBox& box, const Split& split) noexcept {
  lines_ += fmt::format("s {} {} {}\n", box.id, split.variable, split.at);
}

void PavingTree::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  add_leaf(box, claims_.of(box.box, rule));
}

void PavingTree::on_open(const OpenBox& box) noexcept { add_leaf(box, Claim::kUndecided); }

void PavingTree::add_leaf(const OpenBox& box, Claim claim) {
  lines_ += fmt::format("l {} {}\n", box.id, name(claim));
  ++leaves_;
}

std::string PavingTree::text() const { return lines_ + fmt::format("end {}\n", leaves_); }

}  // namespace regulus::detail
