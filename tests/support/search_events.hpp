// SPDX-License-Identifier: GPL-3.0-or-later
// All that a search tells its observer about boxes, as text.
#pragma once

#include <cstdio>
#include <string>

#include "runtime/problem/observer.hpp"

namespace regulus::detail::test {

/// Leaves out when the search reported progress, which depends on time in a search of many units.
class SearchEvents : public Observer {
 public:
  void on_split(const OpenBox& box, const Split& split) noexcept override {
    put(box);
    text += " split " + std::to_string(split.variable) + ' ' + std::to_string(split.lower);
    put(split.at);
    text += '\n';
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    put(box);
    text += std::string(" leaf ") + name(rule) + ", " + describe(proof.reason);
    if (proof.determinant) put(*proof.determinant);
    if (proof.witness != nullptr) put(*proof.witness);
    text += '\n';
  }
  void on_open(const OpenBox& box) noexcept override {
    put(box);
    text += " open\n";
  }
  void on_finish(const Result& result) noexcept override {
    text += name(result.verdict) + std::string(", ") + describe(result.reason);
    if (result.witness) put(*result.witness);
    for (const Interval& x : result.blocking_box) put(x);
    for (const std::uint64_t n : result.statistics.leaves) text += ' ' + std::to_string(n);
    text += ' ' + std::to_string(result.statistics.boxes) + ' ' +
            std::to_string(result.statistics.probes) + ' ' +
            std::to_string(result.statistics.max_frontier) + '\n';
  }

  std::string text;

 protected:
  void put(double x) noexcept {
    char number[32];
    std::snprintf(number, sizeof number, " %a", x);
    text += number;
  }
  void put(const Interval& x) noexcept { put(x.lo), put(x.hi); }
  void put(const Witness& witness) noexcept {
    for (const WitnessPoint& point : witness.points) {
      for (const Interval& x : point.variables) put(x);
      for (const Interval& x : point.pose) put(x);
      put(point.determinant);
    }
  }
  void put(const OpenBox& box) noexcept {
    text += std::to_string(box.id) + '@' + std::to_string(box.depth);
    for (const Interval& x : box.box) put(x);
  }
};

}  // namespace regulus::detail::test
