// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace regulus::detail {

/// A fixed array of doubles on a 64-byte boundary, as kernels require; zero at first.
class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t size)
      : data_(static_cast<double*>(::operator new[](size * sizeof(double), kAlignment))) {
    std::uninitialized_fill_n(data_.get(), size, 0.0);
  }

  [[nodiscard]] double* get() noexcept { return data_.get(); }
  [[nodiscard]] const double* get() const noexcept { return data_.get(); }
  double& operator[](std::size_t i) noexcept { return data_.get()[i]; }
  const double& operator[](std::size_t i) const noexcept { return data_.get()[i]; }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(double* p) const noexcept { ::operator delete[](p, kAlignment); }
  };
  std::unique_ptr<double, Free> data_;
};

}  // namespace regulus::detail
