// SPDX-License-Identifier: GPL-3.0-or-later
// K·M of the sample, one box after the other, by arithmetic that is not the kernels'.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "tests/bench/kernel/subject.hpp"

namespace regulus::bench {

class Rival {
 public:
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;
  virtual ~Rival() = default;

  /// K·M of every box of the sample, into the same place.
  virtual void pass() = 0;

  /// K·M of one box. Of plain doubles: the values at its midpoint.
  [[nodiscard]] virtual std::vector<Interval> entries(std::size_t box) = 0;
};

struct NamedRival {
  std::string key;  ///< in the JSON
  std::string name;
  std::string explanation;
  bool encloses = true;
  std::unique_ptr<Rival> rival;
  std::string absent;  ///< why there is no rival; empty if there is one
};

/// Everyone the suite knows, also those whose library was not there when it was built.
[[nodiscard]] std::vector<NamedRival> make_rivals(const Sample& sample);

// One file each.
[[nodiscard]] std::unique_ptr<Rival> make_boost_default(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_boost_unprotected(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_mpfi(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_scalar_interval(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_plain_scalar(const Sample& sample);
[[nodiscard]] std::unique_ptr<Rival> make_plain_vectorised(const Sample& sample);

}  // namespace regulus::bench
