// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/rival_boost.hpp"

namespace regulus::detail::bench {

std::unique_ptr<Rival> make_boost_unprotected(const Sample& sample) {
  namespace lib = boost::numeric::interval_lib;
  using Policies =
      lib::policies<lib::save_state_nothing<BoostRounding>, lib::checking_base<double>>;
  using Type = boost::numeric::interval<double, Policies>;
  using Scope = lib::save_state<BoostRounding>;
  return std::make_unique<StraightRival<BoostArithmetic<Type, Scope>>>(sample);
}

}  // namespace regulus::detail::bench
