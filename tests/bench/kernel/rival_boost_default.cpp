// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/rival_boost.hpp"

namespace regulus::detail::bench {

std::unique_ptr<Rival> make_boost_default(const Sample& sample) {
  namespace lib = boost::numeric::interval_lib;
  using Policies = lib::policies<lib::save_state<BoostRounding>, lib::checking_strict<double>>;
  using Type = boost::numeric::interval<double, Policies>;
  return std::make_unique<StraightRival<BoostArithmetic<Type, NoScope>>>(sample);
}

}  // namespace regulus::detail::bench
