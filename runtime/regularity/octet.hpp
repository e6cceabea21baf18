// SPDX-License-Identifier: Apache-2.0
// Matrices whose entries are eight doubles, one for each box of a batch, in point layout.
#pragma once

#include <cmath>
#include <vector>

#include "regulus/regularity/lanes.hpp"

namespace regulus {

/// On a cache line of its own: a store that crosses lines cannot be forwarded to the next load.
struct alignas(64) Octet {
  double value[kLanes];

  double& operator[](std::size_t lane) noexcept { return value[lane]; }
  double operator[](std::size_t lane) const noexcept { return value[lane]; }
};

inline void add(Octet& sum, const Octet& a) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) sum[l] += a[l];
}
inline void add_product(Octet& sum, const Octet& a, const Octet& b) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) sum[l] += a[l] * b[l];
}
inline void subtract_product(Octet& sum, const Octet& a, const Octet& b) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) sum[l] -= a[l] * b[l];
}
/// sum += |a|·b
inline void add_magnitude(Octet& sum, const Octet& a, const Octet& b) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) sum[l] += std::fabs(a[l]) * b[l];
}

/// Row-major; its size is fixed when it is made.
class OctetMatrix {
 public:
  OctetMatrix() = default;
  OctetMatrix(std::size_t rows, std::size_t columns)
      : columns_(columns), entries_(rows * columns) {}

  Octet& operator()(std::size_t i, std::size_t j) noexcept { return entries_[i * columns_ + j]; }
  const Octet& operator()(std::size_t i, std::size_t j) const noexcept {
    return entries_[i * columns_ + j];
  }
  [[nodiscard]] std::size_t rows() const noexcept {
    return columns_ == 0 ? 0 : entries_.size() / columns_;
  }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }

  void clear() noexcept {
    for (Octet& x : entries_) x = {};
  }
  /// Entries, each the floating-point value of a sum of at most `terms` products of magnitudes,
  /// become upper bounds of the sums.
  void raise(std::size_t terms) noexcept {
    const double factor = raise_factor(terms);
    for (Octet& x : entries_)
      for (std::size_t l = 0; l < kLanes; ++l) x[l] = raise_ru(x[l], factor);
  }
  /// Entries become their square roots, to nearest.
  void root() noexcept {
    for (Octet& x : entries_)
      for (std::size_t l = 0; l < kLanes; ++l) x[l] = std::sqrt(x[l]);
  }
  void load(const double* points) noexcept {
    for (std::size_t e = 0; e < entries_.size(); ++e)
      std::memcpy(entries_[e].value, points + point_at(e, 0), sizeof(Octet));
  }
  void load_magnitudes(const OctetMatrix& other) noexcept {
    for (std::size_t e = 0; e < entries_.size(); ++e)
      for (std::size_t l = 0; l < kLanes; ++l) entries_[e][l] = std::fabs(other.entries_[e][l]);
  }
  void scale(double factor) noexcept {
    for (Octet& x : entries_)
      for (std::size_t l = 0; l < kLanes; ++l) x[l] *= factor;
  }
  void add(const OctetMatrix& other) noexcept {
    for (std::size_t e = 0; e < entries_.size(); ++e) regulus::add(entries_[e], other.entries_[e]);
  }
  /// this += |other|·factor
  void add_magnitudes(const OctetMatrix& other, const Octet& factor) noexcept {
    for (std::size_t e = 0; e < entries_.size(); ++e)
      add_magnitude(entries_[e], other.entries_[e], factor);
  }
  /// this += a·b
  void add_product(const OctetMatrix& a, const OctetMatrix& b) noexcept {
    for (std::size_t i = 0; i < a.rows(); ++i)
      for (std::size_t j = 0; j < b.columns(); ++j) {
        OctetSum sum;
        for (std::size_t k = 0; k < b.rows(); ++k) sum.add_product(a(i, k).value, b(k, j).value);
        Octet total;
        sum.store(total.value);
        regulus::add((*this)(i, j), total);
      }
  }

 private:
  std::size_t columns_ = 0;
  std::vector<Octet> entries_;
};

}  // namespace regulus
