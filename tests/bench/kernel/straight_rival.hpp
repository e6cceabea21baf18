// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "left_product.hpp"
#include "tests/bench/kernel/rival.hpp"

namespace regulus::detail::bench {

/// Runs straight-line code over an arithmetic A. Besides the operations, A has
///
///   begin()                          called before the operations of a box
///   static void from(Interval, Number&), static Interval to(const Number&)
///   Scope                            lives around all operations and sets their rounding
template <class A>
class StraightRival final : public Rival {
 public:
  using Number = typename A::Number;

  explicit StraightRival(const Sample& sample)
      : variables_(sample.variables),
        points_(sample.points),
        boxes_(sample.boxes.size()),
        K_(sample.K),
        out_(sample.outputs) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) A::from(sample.boxes[i], boxes_[i]);
  }

  void pass() override {
    const typename A::Scope scope;
    for (std::size_t b = 0; b < Sample::kBoxes; ++b) evaluate(b);
  }

  std::vector<Interval> entries(std::size_t box) override {
    {
      const typename A::Scope scope;
      evaluate(box);
    }
    std::vector<Interval> result(out_.size());
    std::transform(out_.begin(), out_.end(), result.begin(), A::to);
    return result;
  }

 private:
  // Not inlined: no operation may be moved out of the scope that sets its rounding.
  [[gnu::noinline]] void evaluate(std::size_t b) {
    arithmetic_.begin();
    left_product(arithmetic_, &boxes_[b * variables_], &K_[b * points_], out_.data());
  }

  A arithmetic_;
  std::size_t variables_, points_;
  std::vector<Number> boxes_;
  std::vector<double> K_;
  std::vector<Number> out_;
};

/// The scope of an arithmetic that needs no setting.
struct NoScope {
  NoScope() {}
};

}  // namespace regulus::detail::bench
