// SPDX-License-Identifier: Apache-2.0
// The quantities of one row and their products, bounded together. PROOF.md, "The test", 2.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/touched_rows.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostEnds = 3;
constexpr std::size_t kNone = std::size_t(-1);

using Numbers = std::vector<double>;

double norm(const Numbers& x) {
  return inflate(std::sqrt(inflate(std::inner_product(x.begin(), x.end(), x.begin(), 0.0))));
}

}  // namespace

void TouchedRows::find_couplings() {
  pair_balls();
  for (std::size_t slot = 0; slot < order(); ++slot)
    if (Coupling coupling = find_coupling(slot); !coupling.ends.empty())
      couplings_.push_back(std::move(coupling));
}

/// Returns the place in products_; kNone if there are none.
std::size_t TouchedRows::products_between(std::size_t a, std::size_t b) const {
  for (std::size_t p = 0; p < products_.size(); ++p)
    if (products_[p].first == std::max(a, b) && products_[p].second == std::min(a, b)) return p;
  return kNone;
}

void TouchedRows::pair_balls() {
  for (Products& products : products_) {
    Group &a = groups_[products.first], &b = groups_[products.second];
    if (&a == &b || !a.ball || !b.ball || a.is_coupled || b.is_coupled) continue;
    a.is_coupled = b.is_coupled = products.is_coupled = true;
  }
}

/// Takes the quantities with most products as ends.
TouchedRows::Coupling TouchedRows::find_coupling(std::size_t slot) {
  Coupling coupling{slot, {}, {}, {}};
  const auto is_free = [&](std::size_t g) {
    return groups_[g].slot == slot && !groups_[g].ball && !groups_[g].is_coupled;
  };
  const auto partners = [&](std::size_t g) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < groups_.size() && is_free(g); ++k)
      count += k != g && is_free(k) && products_between(g, k) != kNone;
    return count;
  };
  while (coupling.ends.size() < kMostEnds) {
    std::size_t best = 0;
    for (std::size_t g = 1; g < groups_.size(); ++g)
      if (partners(g) > partners(best)) best = g;
    if (groups_.empty() || partners(best) == 0) break;
    coupling.ends.push_back(best);
    groups_[best].is_coupled = true;
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (!is_free(g)) continue;
    for (const std::size_t end : coupling.ends) {
      const std::size_t p = products_between(end, g);
      if (p == kNone) continue;
      if (!groups_[g].is_coupled) coupling.followers.push_back(g);
      groups_[g].is_coupled = products_[p].is_coupled = true;
      coupling.products.push_back(p);
    }
  }
  return coupling;
}

TouchedRows::Effects TouchedRows::effects(const Directions& y) const {
  const auto estimate = [&](const Coefficient& k) {
    Estimate x{0.0, 0.0};
    for (std::size_t s = 0; s < order(); ++s) {
      const double middle = std::fabs(y.middle[s]), b = std::fabs(k.b[s]);
      x.middle += k.b[s] * y.middle[s];
      x.radius += b * (y.radius[s] + kRounding * middle) + k.S[s] * (middle + y.radius[s]);
    }
    return x;
  };
  Effects result;
  for (const Group& group : groups_) {
    result.groups.emplace_back();
    for (const std::size_t k : group.members)
      result.groups.back().push_back(estimate(quantities_[k].coefficient));
  }
  for (const Products& products : products_) {
    result.products.emplace_back();
    for (const Product& product : products.members)
      result.products.back().push_back(estimate(product.coefficient));
  }
  return result;
}

double TouchedRows::bound_of_row(std::size_t slot, const Effects& x, double sign) const {
  double most = 0.0;
  const auto is_alone = [this](const Group& group) {
    return !group.is_coupled || (group.ball && !is_ball(group));
  };
  for (std::size_t p = 0; p < products_.size(); ++p) {
    const Products& products = products_[p];
    const Group &a = groups_[products.first], &b = groups_[products.second];
    if (a.slot != slot) continue;
    if (are_coupled_balls(products)) {
      most += bound_of_balls(products, x, x.products[p], sign);
    } else if (!products.is_coupled || a.ball || b.ball) {
      most += bound_of(products, x.products[p]);
      // Its partner's ball has been cut.
      for (const std::size_t g : {products.first, products.second})
        if (products.is_coupled && is_ball(groups_[g])) most += bound_of(groups_[g], x.groups[g]);
    }
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (groups_[g].slot == slot && is_alone(groups_[g])) most += bound_of(groups_[g], x.groups[g]);
  for (const Coupling& coupling : couplings_)
    if (coupling.slot == slot) most += bound_of(coupling, x, sign);
  return inflate(most);
}

/// Bounds max over δ of Σ_e δ_ex_e + Σ_f δ_f(x_f + sign·Σ_e δ_ex_ef): it is attained where each δ is
/// at an end of its range, and the best δ_f are then known by the signs.
double TouchedRows::bound_of(const Coupling& coupling, const Effects& x, double sign) const {
  const std::size_t ends = coupling.ends.size(), followers = coupling.followers.size();
  double rest = 0.0, size = 0.0;
  const auto scaled = [&](const Estimate& estimate, double weight) {
    rest += weight * estimate.radius;
    size += weight * std::fabs(estimate.middle);
    return weight * estimate.middle;
  };
  Numbers of_end(ends), of_follower(followers), Z(followers * ends, 0.0);
  const auto load = [&](const std::vector<std::size_t>& groups, Numbers& numbers) {
    for (std::size_t k = 0; k < groups.size(); ++k)
      numbers[k] = scaled(x.groups[groups[k]].front(), spread(groups_[groups[k]], 0));
  };
  load(coupling.ends, of_end);
  load(coupling.followers, of_follower);
  const auto place_of = [](const std::vector<std::size_t>& list, std::size_t a, std::size_t b) {
    const auto is_one = [&](std::size_t g) { return g == a || g == b; };
    return std::size_t(std::find_if(list.begin(), list.end(), is_one) - list.begin());
  };
  for (const std::size_t p : coupling.products) {
    const std::size_t a = products_[p].first, b = products_[p].second;
    const double weight = spread(groups_[a], 0) * spread(groups_[b], 0);
    Z[place_of(coupling.followers, a, b) * ends + place_of(coupling.ends, a, b)] =
        sign * scaled(x.products[p].front(), weight);
  }
  double most = 0.0;
  for (std::size_t choice = 0; choice < std::size_t{1} << ends; ++choice) {
    const auto end = [&](std::size_t e) { return (choice >> e & 1U) != 0 ? 1.0 : -1.0; };
    double sum = 0.0;
    for (std::size_t e = 0; e < ends; ++e) sum += end(e) * of_end[e];
    for (std::size_t f = 0; f < followers; ++f) {
      double of_this = of_follower[f];
      for (std::size_t e = 0; e < ends; ++e) of_this += end(e) * Z[f * ends + e];
      sum += std::fabs(of_this);
    }
    most = std::max(most, sum);
  }
  return size <= kLargest ? most + rest + kRounding * size : HUGE_VAL;
}

/// Bounds max of sᵀx + tᵀy + tᵀZs over |s| ≤ 1, |t| ≤ 1. With h = Zᵀy, q = |y|² + ‖Z‖₂² and any c > 0,
/// |y + Zs| ≤ ½c|y + Zs|² + 1/(2c) ≤ ½cq + c·hᵀs + 1/(2c), so it is at most |x + ch| + ½cq + 1/(2c).
double TouchedRows::bound_of_balls(const Products& products, const Effects& x,
                                   const std::vector<Estimate>& of_products, double sign) const {
  const std::size_t groups[] = {products.second, products.first};
  Numbers numbers[2], radii[2];
  for (int g = 0; g < 2; ++g)
    for (const Estimate& estimate : x.groups[groups[g]]) {
      const double reach = variety_.reach[*groups_[groups[g]].ball];
      numbers[g].push_back(reach * estimate.middle);
      radii[g].push_back(reach * estimate.radius);
    }
  auto& [s, t] = numbers;
  Numbers Z(s.size() * t.size(), 0.0), radius_of_Z;
  const double weight =
      variety_.reach[*groups_[groups[0]].ball] * variety_.reach[*groups_[groups[1]].ball] * sign;
  for (std::size_t k = 0; k < of_products.size(); ++k) {
    const Product& product = products.members[k];
    Z[product.first * s.size() + product.second] = weight * of_products[k].middle;
    radius_of_Z.push_back(std::fabs(weight) * of_products[k].radius);
  }
  const double rest = norm(radii[0]) + norm(radii[1]) + norm(radius_of_Z);
  const double of_Z = spectral_norm(Z, t.size(), s.size()), of_s = norm(s), of_t = norm(t);
  const double apart = of_s + of_t + of_Z;
  Numbers h(s.size(), 0.0), shifted(s.size());
  for (std::size_t j = 0; j < t.size(); ++j)
    for (std::size_t i = 0; i < s.size(); ++i) h[i] += Z[j * s.size() + i] * t[j];
  const double q = inflate(of_t * of_t + of_Z * of_Z);
  double together = apart, c = 1.0 / std::sqrt(q);
  for (int step = 0; step < 3 && c > 0.0 && c < kLargest; ++step) {
    for (std::size_t i = 0; i < s.size(); ++i) shifted[i] = s[i] + c * h[i];
    const double length = norm(shifted), size = of_s + c * norm(Z) * of_t;
    together = std::min(together, inflate(length + 0.5 * c * q + 0.5 / c) + kRounding * size);
    // The derivative in c is 0 there.
    const double slope = std::inner_product(h.begin(), h.end(), shifted.begin(), 0.0) / length;
    c = 1.0 / std::sqrt(q + 2.0 * slope);
  }
  return std::min(apart, together) + rest;
}

}  // namespace regulus::verifier
