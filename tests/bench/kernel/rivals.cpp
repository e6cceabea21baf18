// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/rival.hpp"

namespace regulus::detail::bench {
namespace {

using Maker = std::unique_ptr<Rival> (*)(const Sample&);

// CMakeLists.txt finds the libraries; a rival is compiled only if its library exists.
#if defined(REGULUS_BENCH_BOOST)
constexpr Maker kBoostUnprotected = make_boost_unprotected, kBoostDefault = make_boost_default;
#else
constexpr Maker kBoostUnprotected = nullptr, kBoostDefault = nullptr;
#endif
#if defined(REGULUS_BENCH_MPFI)
constexpr Maker kMpfi = make_mpfi;
#else
constexpr Maker kMpfi = nullptr;
#endif

struct Known {
  const char* key;
  const char* name;
  const char* explanation;
  bool encloses;
  Maker make;
  const char* package;
};

constexpr Known kKnown[] = {
    {"boost_unprotected", "Boost.Interval, unprotected",
     "save_state_nothing<rounded_transc_opp>, checking_base: the rounding mode is saved, set "
     "upward "
     "and restored once outside all boxes",
     true, kBoostUnprotected, "libboost-dev"},
    {"boost_default", "Boost.Interval, default",
     "save_state<rounded_transc_opp>, checking_strict, the default with the sine and cosine it "
     "lacks: the rounding mode is saved, set and restored in each operation",
     true, kBoostDefault, "libboost-dev"},
    {"mpfi", "MPFI, 53 bits", "mpfi_t; mixed operations with a double where MPFI has them", true,
     kMpfi, "libmpfi-dev"},
    {"scalar_interval", "this project's scalar Interval",
     "regulus::Interval: to nearest plus a proved outward step, one box at a time, no vectors",
     true, make_scalar_interval, ""},
    {"plain_scalar", "plain double, scalar", "no enclosure; -O2, vectorisation switched off", false,
     make_plain_scalar, ""},
    {"plain_vectorised", "plain double, -O3 -march=native",
     "no enclosure; what the compiler vectorises by itself, a·b + c fused", false,
     make_plain_vectorised, ""},
};

}  // namespace

std::vector<NamedRival> make_rivals(const Sample& sample) {
  std::vector<NamedRival> rivals;
  for (const Known& known : kKnown) {
    NamedRival& rival = rivals.emplace_back();
    rival.key = known.key;
    rival.name = known.name;
    rival.explanation = known.explanation;
    rival.encloses = known.encloses;
    if (known.make)
      rival.rival = known.make(sample);
    else
      rival.absent = std::string("was built without ") + known.package;
  }
  return rivals;
}

}  // namespace regulus::detail::bench
