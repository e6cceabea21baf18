// SPDX-License-Identifier: Apache-2.0
// Matrices of balls of Arb.
#pragma once

#include <arb_mat.h>

#include <cstddef>

namespace regulus::verifier {

/// An owned arb_mat_t.
class BallMatrix {
 public:
  BallMatrix(std::size_t rows, std::size_t columns) {
    arb_mat_init(value_, slong(rows), slong(columns));
  }
  BallMatrix(const BallMatrix&) = delete;
  BallMatrix& operator=(const BallMatrix&) = delete;
  ~BallMatrix() { arb_mat_clear(value_); }
  [[nodiscard]] arb_mat_struct* get() noexcept { return value_; }
  [[nodiscard]] arb_ptr at(std::size_t i, std::size_t j) noexcept {
    return arb_mat_entry(value_, i, j);
  }

 private:
  arb_mat_t value_;
};

}  // namespace regulus::verifier
