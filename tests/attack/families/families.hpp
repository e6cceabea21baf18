// SPDX-License-Identifier: GPL-3.0-or-later
// The families of hostile models. Each makes a model from a seed and states the truth about it.
#pragma once

#include <span>
#include <string_view>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::detail::attack {

struct Family {
  const char* name;
  const char* description;
  Attack (*make)(std::uint64_t seed);
};

[[nodiscard]] std::span<const Family> families();

/// Returns nullptr if there is no family of that name.
[[nodiscard]] const Family* find_family(std::string_view name);

// Roots: roots.cpp
Attack singular_in_the_interior(std::uint64_t seed);
Attack singular_on_an_edge(std::uint64_t seed);
Attack singular_at_a_corner(std::uint64_t seed);
Attack double_root(std::uint64_t seed);
Attack regular_by_a_margin(std::uint64_t seed);
Attack linear_margin(std::uint64_t seed);
Attack expanded_polynomial(std::uint64_t seed);
Attack identity(std::uint64_t seed);
// Poses without a value: undefined.cpp
Attack pole(std::uint64_t seed);
Attack removable(std::uint64_t seed);
Attack branch_cut(std::uint64_t seed);
Attack sign_jump(std::uint64_t seed);
Attack rational_exponent(std::uint64_t seed);
// The question of the model: questions.cpp
Attack threshold(std::uint64_t seed);
Attack row_scale(std::uint64_t seed);
Attack constraint(std::uint64_t seed);
Attack empty_variety(std::uint64_t seed);
Attack trajectory(std::uint64_t seed);
// Way-points: ways.cpp
Attack way(std::uint64_t seed);
// Tolerances: tolerances.cpp
Attack tolerance_box(std::uint64_t seed);
Attack tolerance_ball(std::uint64_t seed);
Attack control_error(std::uint64_t seed);
// Numbers: numbers.cpp
Attack literal(std::uint64_t seed);
Attack thin(std::uint64_t seed);
Attack huge_or_subnormal(std::uint64_t seed);
Attack badly_scaled(std::uint64_t seed);
Attack refused(std::uint64_t seed);
// Equations: closures.cpp
Attack closure(std::uint64_t seed);
Attack closure_along_way(std::uint64_t seed);
// All solutions: systems.cpp, mechanisms.cpp
Attack solved_polynomials(std::uint64_t seed);
Attack solved_turns(std::uint64_t seed);
Attack solved_planar_platform(std::uint64_t seed);
Attack solved_arm(std::uint64_t seed);
Attack solved_hexapod(std::uint64_t seed);
// Shapes: shapes.cpp, hexapods.cpp
Attack rectangular(std::uint64_t seed);
Attack composition(std::uint64_t seed);
Attack hexapod_singular(std::uint64_t seed);
Attack hexapod_regular(std::uint64_t seed);
Attack hexapod_tolerance(std::uint64_t seed);

}  // namespace regulus::detail::attack
