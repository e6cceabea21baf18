// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/root_list.hpp"

#include <algorithm>
#include <array>

namespace regulus::detail {

namespace {

/// Arcs in the family of systems, and how carefully they are followed.
const std::array<TrackerOptions, 4> kArcs{
    {{{0.6, 0.8}, 1e-5}, {{-0.28, -0.96}, 1e-6}, {{0.352, -0.936}, 1e-7}, {{-0.8, 0.6}, 1e-7}}};

/// Scales each group so that patch·z = 1.
std::vector<Complex> onto_patch(std::vector<Complex> z, std::span<const std::size_t> groups,
                                std::span<const double> patch) {
  std::size_t first = 0;
  for (const std::size_t width : groups) {
    Complex sum;
    for (std::size_t i = first; i < first + width; ++i) sum += z[i] * Complex(patch[i]);
    const Complex factor = inverse(sum);
    for (std::size_t i = first; i < first + width; ++i) z[i] = z[i] * factor;
    first += width;
  }
  return z;
}

}  // namespace

std::vector<RootBox> follow_roots(const Homotopy& homotopy,
                                  std::span<const std::vector<Complex>> starts,
                                  const RootQuery& query) {
  std::vector<RootBox> roots;
  const auto add = [&](std::vector<Complex> near) {
    const auto root =
        certify_root(query.system, onto_patch(std::move(near), homotopy.groups(), query.patch));
    const auto is_other = [&](const RootBox& known) { return certain_disjoint(*root, known); };
    if (root && query.counts(*root) && std::ranges::all_of(roots, is_other)) roots.push_back(*root);
  };
  for (const TrackerOptions& arc : kArcs) {
    const std::size_t before = roots.size();
    for (const auto& start : starts)
      if (auto end = track(homotopy, start, arc)) add(std::move(*end));
    const bool is_first = &arc == kArcs.data();
    if (roots.size() >= starts.size() || (!is_first && roots.size() == before)) break;
  }
  return roots;
}

}  // namespace regulus::detail
