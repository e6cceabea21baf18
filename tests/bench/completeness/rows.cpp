// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/completeness/rows.hpp"

#include <fmt/format.h>

#include "tests/property/api/planted_singularity.hpp"

namespace regulus::detail::bench {
namespace {

constexpr int kRobots = 100;

Row percent_row(std::string name, int count, int of, double least, std::string explanation) {
  Row row;
  row.name = std::move(name);
  row.value = 100.0 * count / of;
  row.unit = std::string("%");
  row.target = value_at_least(least);
  row.explanation = std::move(explanation);
  return row;
}

Row found_row(const char* what, const test::Found& found) {
  return percent_row(what, found.singular, found.robots, 99,
                     fmt::format("SINGULARITY, of {} models", found.robots));
}

template <class Plant>
test::Found find_in_all_motions(std::uint64_t seed) {
  test::Found all;
  for (const char* motion : {"pose", "box", "path"})
    for (const bool alpha : {false, true}) {
      const test::Found found =
          test::find_plants<Plant>(seed++, kRobots / 5, 0.0, 0.99, motion, alpha);
      all.robots += found.robots;
      all.singular += found.singular;
    }
  return all;
}

Row decided_row(const char* shape, const char* motion, std::uint64_t seed) {
  const test::Decided decided = test::decide_hexapods(seed, kRobots, shape, motion);
  return percent_row(fmt::format("random hexapods, {}, anchors in {}", motion, shape),
                     decided.certified + decided.refuted, kRobots, 98,
                     fmt::format("{} NO SINGULARITY and {} SINGULARITY of {}", decided.certified,
                                 decided.refuted, kRobots));
}

}  // namespace

Section completeness_rows() {
  Section section{"completeness",
                  "Random models that are decided",
                  "A singularity is planted at a known pose and for known uncertain values, up to "
                  "99 % of the way to the ends of their ranges. The other hexapods have tolerances "
                  "from 1 to 27 mm, at radii of 100 to 200 mm. At most 2000 boxes.",
                  {}};
  for (const char* motion : {"pose", "box", "path"})
    section.rows.push_back(found_row(fmt::format("planted, hexapods, {}", motion).c_str(),
                                     test::find_planted(14, kRobots, 0.5, 0.99, motion)));
  section.rows.push_back(
      found_row("planted, planar platforms", find_in_all_motions<test::RandomPlanarPlatform>(41)));
  section.rows.push_back(
      found_row("planted, matrices", find_in_all_motions<test::RandomMatrixModel>(51)));
  for (const char* shape : {"box", "ball"})
    for (const char* motion : {"pose", "box"})
      section.rows.push_back(decided_row(shape, motion, 16));
  return section;
}

}  // namespace regulus::detail::bench
