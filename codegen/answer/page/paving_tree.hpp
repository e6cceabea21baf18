// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a paving as text, in the lines of a certificate's proof with claims in the place of
// rules.
#pragma once

#include <string>

#include "runtime/problem/observer.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {

class PavingTree final : public Observer {
 public:
  /// As LeafClaims. The kernel of `problem` must outlive this.
  PavingTree(const Problem& problem, std::size_t reach) : claims_(problem, reach) {}

  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  /// Returns the lines, up to `end`. Requires: the search has ended.
  [[nodiscard]] std::string text() const;

 private:
  void add_leaf(const OpenBox& box, Claim claim);

  LeafClaims claims_;
  std::string lines_;
  std::size_t leaves_ = 0;
};

}  // namespace regulus::detail
