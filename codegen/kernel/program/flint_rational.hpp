// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmpq.h>

#include <optional>
#include <string>

namespace cln {
class cl_RA;
}

namespace regulus::detail {

/// An owned fmpq_t. Several threads may read it at once, because reading or copying it writes
/// nothing. (The reference count of a CLN number is not atomic.)
class FlintRational {
 public:
  FlintRational() noexcept { fmpq_init(value_); }
  FlintRational(const FlintRational& other) : FlintRational() { fmpq_set(value_, other.value_); }
  FlintRational(FlintRational&& other) noexcept : FlintRational() {
    fmpq_swap(value_, other.value_);
  }
  FlintRational& operator=(FlintRational other) noexcept {
    fmpq_swap(value_, other.value_);
    return *this;
  }
  ~FlintRational() { fmpq_clear(value_); }

  /// Requires  a number of the calling thread.
  explicit FlintRational(const cln::cl_RA& value);

  /// "-5/3": numerator and denominator, decimal, in lowest terms.
  [[nodiscard]] std::string text() const;
  /// Returns nullopt unless text() wrote the text.
  [[nodiscard]] static std::optional<FlintRational> read(const std::string& text);

  [[nodiscard]] const fmpq* get() const noexcept { return value_; }

 private:
  fmpq_t value_;
};

}  // namespace regulus::detail
