// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

constexpr Family kFamilies[] = {
    {"interior", "a root in the interior", singular_in_the_interior},
    {"edge", "a root on an edge", singular_on_an_edge},
    {"corner", "a root at a corner", singular_at_a_corner},
    {"double", "a root that is touched", double_root},
    {"margin", "a square and a margin of 1e-6 to 1e-300", regular_by_a_margin},
    {"linear", "a root beside an end, inside or outside", linear_margin},
    {"polynomial", "multiplied out, its roots known", expanded_polynomial},
    {"identity", "0 at every pose, or a constant", identity},
    {"pole", "a denominator that vanishes, or nearly", pole},
    {"removable", "no value where simplification would give one", removable},
    {"branch", "ends and cuts of elementary functions", branch_cut},
    {"jump", "signs that change without a root", sign_jump},
    {"power", "rational exponents", rational_exponent},
    {"threshold", "alpha at the extremum of |det|", threshold},
    {"scale", "row scales at 0 and near it", row_scale},
    {"constraint", "what constraints leave: pieces, points", constraint},
    {"empty", "constraints that exclude everything", empty_variety},
    {"trajectory", "parametric motions", trajectory},
    {"way", "a determinant beside 0 at one way-point", way},
    {"tolerance", "tolerances at the critical value", tolerance_box},
    {"ball", "balls that touch a singular plane", tolerance_ball},
    {"error", "control errors at the critical value", control_error},
    {"literal", "the last digit decides", literal},
    {"thin", "points and motions of one step", thin},
    {"huge", "ranges of 2^60, subnormal ranges", huge_or_subnormal},
    {"scaled", "rows and columns times powers of two", badly_scaled},
    {"refused", "not a model", refused},
    {"closure", "branches of equations, their folds and flat places", closure},
    {"closure_way", "the same along way-points, with errors", closure_along_way},
    {"rectangular", "more rows than columns", rectangular},
    {"composition", "dense products with one singular factor", composition},
    {"hexapod", "six legs with a planted singular pose", hexapod_singular},
    {"hexapod_regular", "six legs whose determinant is a product of planes", hexapod_regular},
    {"hexapod_tolerance", "six legs, singular within the tolerance", hexapod_tolerance},
    {"solve_system", "all solutions of polynomials with planted roots", solved_polynomials},
    {"solve_turns", "all angles of equations with planted ones", solved_turns},
    {"solve_planar", "all poses of three legs, counted by a resultant", solved_planar_platform},
    {"solve_arm", "all postures of arms of special geometry", solved_arm},
    {"solve_hexapod", "all poses of six legs of special geometry", solved_hexapod},
};

}  // namespace

std::span<const Family> families() { return kFamilies; }

const Family* find_family(std::string_view name) {
  for (const Family& family : kFamilies)
    if (name == family.name) return &family;
  return nullptr;
}

}  // namespace regulus::detail::attack
