// SPDX-License-Identifier: GPL-3.0-or-later
// Computes K·M of the sample, one box after the other, by another arithmetic than the kernels use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "tests/bench/kernel/subject.hpp"

namespace regulus::detail::bench {

class Rival {
 public:
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;
  virtual ~Rival() = default;

  /// Computes K·M of every box of the sample, always into the same place.
  virtual void pass() = 0;

  /// Returns K·M of one box; with plain doubles, the values at its midpoint.
  [[nodiscard]] virtual std::vector<Interval> entries(std::size_t box) = 0;
};

struct NamedRival {
  std::string key;  ///< its name in the JSON
  std::string name;
  std::string explanation;
  bool encloses = true;
  std::unique_ptr<Rival> rival;
  std::string absent;  ///< why there is no rival; empty if there is one
};

/// Returns all rivals, also those whose library was missing at build time.
[[nodiscard]] std::vector<NamedRival> make_rivals(const Sample& sample);

// Each of these has its own file.
[[nodiscard]] std::unique_ptr<Rival> make_boost_default(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_boost_unprotected(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_mpfi(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_scalar_interval(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_plain_scalar(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_plain_vectorised(const Sample& sample);

}  // namespace regulus::detail::bench
