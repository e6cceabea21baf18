// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/waiting_units.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail::cluster {

void WaitingUnits::insert(const Place& place, const Unit& unit) {
  const double width = approx_width(unit);
  if (widths_.try_emplace(place, width).second) by_width_.emplace(-width, place);
}

void WaitingUnits::erase(const Place& place) {
  const auto found = widths_.find(place);
  if (found == widths_.end()) return;
  by_width_.erase({-found->second, place});
  widths_.erase(found);
}

Place WaitingUnits::take_first() {
  auto first = widths_.extract(widths_.begin());
  by_width_.erase({-first.mapped(), first.key()});
  return std::move(first.key());
}

Place WaitingUnits::take_widest() {
  Place place = std::move(by_width_.extract(by_width_.begin()).value().second);
  widths_.erase(place);
  return place;
}

double approx_width(const Unit& unit) noexcept {
  constexpr std::uint32_t kDeepest = 1000;
  double width = 0.0;
  for (const std::uint32_t depth : unit.depths)
    width += std::ldexp(1.0, -static_cast<int>(std::min(depth, kDeepest)));
  return width;
}

}  // namespace regulus::detail::cluster
