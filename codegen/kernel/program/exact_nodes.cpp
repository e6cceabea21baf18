// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/exact_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "runtime/kernel/abi.hpp"

namespace regulus::detail {
namespace {

constexpr std::uint64_t kLargest = std::uint64_t{1} << 53;
constexpr int kFinestScale = 128;

/// A multiple of g·2^-scale for the grid g of a row of K, at most `size` times that.
struct OnGrid {
  std::size_t row;
  int scale;
  std::uint64_t size;
};
using Place = std::optional<OnGrid>;

Place scaled(Place place, std::uint64_t factor, int finer) {
  if (!place || place->scale + finer > kFinestScale || factor == 0 ||
      place->size > kLargest / factor)
    return std::nullopt;
  return OnGrid{place->row, place->scale + finer, place->size * factor};
}

/// The same values as multiples of a finer step.
Place at_scale(const OnGrid& place, int scale) {
  const int finer = scale - place.scale;
  return finer > 53 ? std::nullopt : scaled(place, std::uint64_t{1} << finer, finer);
}

Place sum(const Place& a, const Place& b) {
  if (!a || !b || a->row != b->row) return std::nullopt;
  const int scale = std::max(a->scale, b->scale);
  const Place x = at_scale(*a, scale);
  const Place y = at_scale(*b, scale);
  if (!x || !y || x->size + y->size > kLargest) return std::nullopt;
  return OnGrid{a->row, scale, x->size + y->size};
}

/// Returns the product with a double, p·2^-q with p odd or a multiple of 2.
Place product(const Place& a, double coefficient) {
  if (!a || !std::isfinite(coefficient) || coefficient == 0.0) return std::nullopt;
  int exponent = 0;
  double p = std::fabs(std::frexp(coefficient, &exponent));
  while (p != std::floor(p)) {
    p *= 2;
    --exponent;
  }
  if (exponent > 53) return std::nullopt;
  const Place multiple = scaled(a, static_cast<std::uint64_t>(p), exponent < 0 ? -exponent : 0);
  return exponent > 0 ? scaled(multiple, std::uint64_t{1} << exponent, 0) : multiple;
}

}  // namespace

std::vector<bool> exact_nodes(const Program& program, const KnownValues<Interval>& known,
                              std::size_t row_length) {
  std::vector<Place> places(program.nodes.size());
  const auto thin = [&](NodeId id) { return known[id] && known[id]->lo == known[id]->hi; };
  for (NodeId id = 0; row_length > 0 && id < program.nodes.size(); ++id) {
    const Node& n = program.nodes[id];
    if (known[id]) continue;
    if (n.op == Op::kPoint)
      places[id] = OnGrid{n.index / row_length, 0, std::uint64_t{1} << REGULUS_POINT_BITS};
    else if (n.op == Op::kNegate)
      places[id] = places[n.a];
    else if (n.op == Op::kAdd || n.op == Op::kSubtract)
      places[id] = sum(places[n.a], places[n.b]);
    else if (n.op == Op::kMultiply && thin(n.a))
      places[id] = product(places[n.b], known[n.a]->lo);
    else if (n.op == Op::kMultiply && thin(n.b))
      places[id] = product(places[n.a], known[n.b]->lo);
  }
  std::vector<bool> exact;
  for (const Place& place : places) exact.push_back(place.has_value());
  return exact;
}

}  // namespace regulus::detail
