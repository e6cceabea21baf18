// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/degrees.hpp"

#include <algorithm>
#include <array>

#include "codegen/model/ginac_text.hpp"

namespace regulus::inline model {
namespace {

/// Just above 2π; a note needs no proof.
GiNaC::numeric one_turn() { return {62832, 10000}; }

bool is_plain(const GiNaC::ex& e) { return e.info(GiNaC::info_flags::rational); }

}  // namespace

GiNaC::ex one_degree() { return GiNaC::Pi / 180; }

bool is_in_degrees(std::string_view unit) noexcept { return unit == "deg" || unit == "°"; }

bool is_like_degrees(std::string_view unit) noexcept {
  constexpr std::array<std::string_view, 6> kOthers = {"degree", "degrees", "Deg",
                                                       "DEG",    "Degree",  "Degrees"};
  return std::ranges::find(kOthers, unit) != kOthers.end();
}

std::vector<std::string> notes_about_angles(const Motion& motion, MatrixKind kind) {
  const int turns = kind == MatrixKind::kInverse ? 1 : 4;
  std::vector<std::string> notes;
  for (const MotionParameter& p : motion.parameters) {
    if (p.unit != "rad" || !is_plain(p.range.lo) || !is_plain(p.range.hi)) continue;
    const GiNaC::ex width = p.range.hi - p.range.lo;
    if (!(GiNaC::ex_to<GiNaC::numeric>(width) > GiNaC::numeric(turns) * one_turn())) continue;
    const std::string lo = formula_text(p.range.lo), hi = formula_text(p.range.hi);
    notes.push_back(p.name + " ranges over " + formula_text(width) +
                    " rad, more than a turn; if degrees are meant, write [\"" + lo + "deg\", \"" +
                    hi + "deg\"]");
  }
  return notes;
}

}  // namespace regulus::model
