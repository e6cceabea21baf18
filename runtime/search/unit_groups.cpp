// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/unit_groups.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

/// Returns 2^-depth in units that keep the sum of a list of deep boxes away from 0.
double volume(std::uint32_t depth, std::uint32_t least) noexcept {
  return std::ldexp(1.0, -static_cast<int>(std::min(depth - least, 1000U)));
}

/// Returns the number of boxes, at least 1 and not all, whose volume is closest to half of it.
std::size_t first_half(std::span<const std::uint32_t> depths) noexcept {
  const std::uint32_t least = *std::min_element(depths.begin(), depths.end());
  double all = 0.0;
  for (const std::uint32_t depth : depths) all += volume(depth, least);
  double part = volume(depths[0], least);
  std::size_t count = 1;
  while (count + 1 < depths.size()) {
    const double next = volume(depths[count], least);
    if (part + next / 2 > all / 2) break;
    part += next;
    ++count;
  }
  return count;
}

void cut(std::span<const std::uint32_t> depths, std::size_t most, std::vector<std::size_t>& sizes) {
  if (most == 1 || depths.size() < 2) return sizes.push_back(depths.size());
  const std::size_t first = first_half(depths);
  cut(depths.first(first), most / 2, sizes);
  cut(depths.subspan(first), most - most / 2, sizes);
}

}  // namespace

std::vector<std::size_t> cut_into_groups(std::span<const std::uint32_t> depths, std::size_t most) {
  std::vector<std::size_t> sizes;
  if (!depths.empty()) cut(depths, most, sizes);
  return sizes;
}

}  // namespace regulus::detail
