// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/arb_oracle.hpp"

#include <arb_mat.h>

#include <exception>
#include <utility>
#include <vector>

namespace regulus::detail {
namespace {

constexpr long kFirstBits = 106;

/// An owned arb_mat_t.
class BallMatrix {
 public:
  BallMatrix(int rows, int columns) { arb_mat_init(value_, rows, columns); }
  BallMatrix(const BallMatrix&) = delete;
  BallMatrix& operator=(const BallMatrix&) = delete;
  ~BallMatrix() { arb_mat_clear(value_); }
  [[nodiscard]] arb_mat_struct* get() noexcept { return value_; }

 private:
  arb_mat_t value_;
};

/// FLINT keeps memory for each thread, which its end must give back.
struct MemoryOfThread {
  ~MemoryOfThread() { flint_cleanup(); }
};

Ball determinant(const std::vector<Ball>& entries, int size, long bits) {
  BallMatrix matrix(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      arb_set(arb_mat_entry(matrix.get(), i, j), entries[std::size_t(i * size + j)].get());
  Ball result;
  arb_mat_det(result.get(), matrix.get(), bits);
  return result;
}

}  // namespace

ArbOracle::ArbOracle(BallProgram matrix, int size, long max_bits)
    : matrix_(std::move(matrix)), size_(size), max_bits_(max_bits) {}

std::optional<Interval> ArbOracle::enclose_with(std::span<const Interval> point, long bits) const {
  std::vector<Ball> inputs;
  for (const Interval& x : point) inputs.emplace_back(x, bits);
  const auto entries = evaluate(matrix_, inputs, bits);
  if (!entries) return std::nullopt;
  return determinant(*entries, size_, bits).enclosure();
}

void ArbOracle::note_bits(long bits) noexcept {
  long most = bits_;
  while (bits > most && !bits_.compare_exchange_weak(most, bits)) {
  }
}

// If memory is exhausted, the result is not known.
std::optional<Interval> ArbOracle::enclose(std::span<const Interval> point) noexcept try {
  thread_local const MemoryOfThread given_back;
  std::optional<Interval> enclosure;
  for (long bits = kFirstBits; bits <= max_bits_; bits *= 2) {
    enclosure = enclose_with(point, bits);
    note_bits(bits);
    if (enclosure && (enclosure->lo > 0 || enclosure->hi < 0)) break;
  }
  return enclosure;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace regulus::detail
