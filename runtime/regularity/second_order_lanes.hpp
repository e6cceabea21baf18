// SPDX-License-Identifier: Apache-2.0
// The sums of second_order.hpp, with the vectors of the instruction set of the including file.
// Included by backend_*.cpp only; elementary/lanes.hpp says what may be used here.
//
// Rounding. Signed sums are computed to nearest; each errs by at most γ times the sum of its terms'
// magnitudes (Higham, Accuracy and Stability of Numerical Algorithms, §3.1), where γ = 68·2^-50
// exceeds what 64 terms need by a factor of more than four, which covers the rounding of the
// magnitudes, too. Those are not summed one by one: over all pairs they factor, Σ_pq
// r_pr_q|D_p||D_q| = (Σ_p r_p|D_p|)². Sums of magnitudes become upper bounds by raise().
#pragma once

#include "runtime/regularity/pack_lanes.hpp"
#include "runtime/regularity/second_order_pairs_lanes.hpp"
#include "runtime/regularity/second_order_plan.hpp"
#include "runtime/regularity/second_order_terms_lanes.hpp"

namespace regulus::detail::second_order {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

class Bounding : PairBounding {
 public:
  REGULUS_LANE_INLINE Bounding(const SecondOrderPlan& plan, const SecondOrderInput& input,
                               const SecondOrderWork& work) noexcept
      : PairBounding(plan, input, work), s_(plan.slots), wides_(plan.wides), moving_(plan.moving) {}

  REGULUS_LANE_INLINE void run(PointMatrix T) noexcept {
    read_center();
    for (unsigned w = 0; w < wides_; ++w) read_wide(plan_.wide[w], w);
    for (double* sum : {w_.sum_d.x, w_.sum_D.x}) raise({sum}, n_ * n_, kManyTerms);
    raise({w_.sum_DK.x}, n_ * s_, kManyTerms);
    add_pairs();
    bound_defect();
    for (unsigned g = 0; g < plan_.groups; ++g) {
      const PlanRange& members = plan_.group[g].members;
      members.size() == 1 ? bound_single(members.begin) : bound_ball(plan_.group[g]);
    }
    if (s_ > 0) bound_rows();
    assemble(packs_of(T));
  }

 private:
  /// Reads K₀ at the touched rows, and e; sets all sums to zero.
  REGULUS_LANE_INLINE void read_center() noexcept {
    for (unsigned i = 0; i < n_; ++i)
      for (unsigned j = 0; j < s_; ++j) {
        const Pack k = Pack::load(in_.K.data() + (i * plan_.rows + plan_.touched[j]) * kLanes);
        PackArray{w_.K.x}.put(i * s_ + j, k);
        PackArray{w_.abs_K.x}.put(i * s_ + j, magnitude(k));
      }
    for (unsigned i = 0; i < n_; ++i)
      for (unsigned j = 0; j < n_; ++j) {
        const unsigned e = i * n_ + j;
        const Pack one = Pack::of(i == j ? 1.0 : 0.0);
        const Pack lo = Pack::load(in_.product.data() + 2 * e * kLanes);
        const Pack hi = Pack::load(in_.product.data() + (2 * e + 1) * kLanes);
        PackArray{w_.e.x}.put(e,
                              raised(larger(magnitude(lo - one), magnitude(hi - one)), kOneTerm));
      }
    for (double* sum : {w_.sum_d.x, w_.sum_D.x, w_.magnitude_of_B.x}) clear({sum}, n_ * n_);
    for (double* sum : {w_.weight.x, w_.weight_of_g.x, w_.rest.x, w_.same_row.x, w_.sum_DK.x})
      clear({sum}, n_ * s_);
    clear({w_.R_of_wide.x}, (1 + moving_) * s_ * s_);
  }

  /// Reads D_p, adds Σ_p r_p|d_p|, and computes D_pK₀ to nearest. Leaves both 0 if K does not move.
  REGULUS_LANE_INLINE void read_wide(const SecondOrderPlan::Wide& wide, unsigned index) noexcept {
    const Pack radius_of_p = radius(wide.variable);
    if (index >= moving_) {
      for (unsigned k = wide.first.begin; k < wide.first.end; ++k)
        PackArray{w_.sum_d.x}.add_fused(plan_.entries[k].place,
                                        largest_of(in_.first, plan_.entries[k].at), radius_of_p);
      return;
    }
    const PackArray D = derivative(index);
    clear(D, n_ * n_);
    for (unsigned k = wide.first.begin; k < wide.first.end; ++k) {
      const SecondOrderPlan::Entry& entry = plan_.entries[k];
      const Middle d = middle_of(in_.first, entry.at);
      const unsigned e = entry.place;
      D.put(e, d.middle);
      PackArray{w_.sum_d.x}.add_fused(e, d.distance, radius_of_p);
      PackArray{w_.sum_D.x}.add_fused(e, magnitude(d.middle), radius_of_p);
    }
    const PackArray DK = PackArray{w_.DK.x} + index * n_ * s_;
    for_each_block(
        n_, s_,
        [&]<unsigned kRows, unsigned kAtOnce>(unsigned i,
                                              unsigned j) __attribute__((always_inline)) {
          Block<kRows, kAtOnce> sum;
          sum.add_product(rows_of(index, i), PackArray{w_.K.x} + j, s_);
          sum.for_each([&](unsigned r, unsigned c, const Pack& x) __attribute__((always_inline)) {
            const unsigned e = (i + r) * s_ + j + c;
            DK.put(e, x);
            PackArray{w_.sum_DK.x}.add_fused(e, magnitude(x), radius_of_p);
          });
        });
  }

  /// P ≥ |E|: the result of add_pairs (with the radii of B_pq), plus
  ///
  ///     e + Σr|d| + Σr|D|·(e + Σr|d| + ½Σrr|B|) + γ(Σr|D|·Σr|D| + ½Σrr|B|).
  REGULUS_LANE_INLINE void bound_defect() noexcept {
    const PackArray P{w_.P.x}, sum{w_.linear.x}, rounding{w_.rounding.x}, D{w_.sum_D.x};
    for (unsigned e = 0; e < n_ * n_; ++e) {
      const Pack linear = PackArray{w_.e.x}[e] + PackArray{w_.sum_d.x}[e];
      const Pack magnitude_of_B = raised(PackArray{w_.magnitude_of_B.x}[e], kManyTerms);
      P.add(e, linear);
      sum.put(e, raised(linear + magnitude_of_B, kFewTerms));
      rounding.put(e, magnitude_of_B);
    }
    for (unsigned i = 0; i < n_; ++i) {
      add_row_product(D + i * n_, {nullptr, n_, sum, n_}, n_, P + i * n_);
      add_row_product(D + i * n_, {nullptr, n_, D, n_}, n_, rounding + i * n_);
    }
    for (unsigned e = 0; e < n_ * n_; ++e)
      P.put(e, raised(P[e] + raised(rounding[e], kManyTerms) * Pack::of(kSecondOrderGamma),
                      kManyTerms));
  }

  /// Reads w̄_k and g_kp, entry by entry; adds the remainder of the row to `rest`, and calls
  /// add_slope(column, |g_kp|, r_pΔ).
  template <typename AddSlope>
  REGULUS_LANE_INLINE void read_row_variable(const SecondOrderPlan::RowVariable& u,
                                             const Pack& range, AddSlope&& add_slope) noexcept {
    const PackArray rest = PackArray{w_.rest.x} + u.slot * n_,
                    same_row = PackArray{w_.same_row.x} + u.slot * n_;
    for (unsigned k = u.first.begin; k < u.first.end; ++k) {
      const SecondOrderPlan::Entry& entry = plan_.entries[k];
      const Middle x = middle_of(in_.row_first, entry.at);
      PackArray{w_.center.x}.put(k - u.first.begin, x.middle);
      rest.add_fused(entry.column, x.distance, range);
    }
    for (unsigned p = 0; p < moving_; ++p) {
      const PlanRange& mixed = plan_.mixed[u.mixed + p];
      const Pack weight = PackArray{w_.weight_of_value.x}[1 + p];
      for (unsigned k = mixed.begin; k < mixed.end; ++k) {
        const SecondOrderPlan::Entry& entry = plan_.entries[k];
        const Middle g = middle_of(in_.row_second, entry.at);
        PackArray{w_.slope.x}.put(p * n_ + k - mixed.begin, g.middle);
        rest.add_fused(entry.column, g.distance, weight);
        add_slope(entry.column, magnitude(g.middle), weight);
      }
    }
    for (unsigned p = moving_; p < wides_; ++p)
      add_magnitudes(plan_.mixed[u.mixed + p], PackArray{w_.weight_of_value.x}[1 + p], rest);
    for (unsigned o = u.same_row.begin; o < u.same_row.end; ++o) {
      const SecondOrderPlan::SameRow& other = plan_.same_rows[o];
      add_magnitudes(other.second, product_ru(radius(other.variable), range), same_row);
    }
  }

  /// Adds the largest magnitudes of second derivatives of a row to its sums.
  REGULUS_LANE_INLINE void add_magnitudes(const PlanRange& second, const Pack& weight,
                                          PackArray sums) noexcept {
    for (unsigned k = second.begin; k < second.end; ++k) {
      const SecondOrderPlan::Entry& entry = plan_.entries[k];
      sums.add_fused(entry.column, largest_of(in_.row_second, entry.at), weight);
    }
  }

  /// w̄_kᵀK₀ or, for each p, (g_kpᵀ − w̄_kᵀD_p)K₀, at the touched rows: value(0 or 1 + p, slot). The
  /// latter is 0 if K does not move.
  template <typename Value>
  REGULUS_LANE_INLINE void multiply_row_variable(const SecondOrderPlan::RowVariable& u,
                                                 Value&& value) noexcept {
    const PackArray center{w_.center.x};
    Rows rows{plan_.columns_of_entries + u.first.begin, u.first.size(), {w_.K.x}, s_};
    for_each_block(
        s_, [&]<unsigned kAtOnce>(unsigned j) __attribute__((always_inline)) {
          Pack sum[kAtOnce];
          for (Pack& x : sum) x = Pack::of(0.0);
          add_products<kAtOnce>(center, rows, j, sum);
          for (unsigned c = 0; c < kAtOnce; ++c) value(0, j + c, sum[c]);
        });
    for (unsigned p = 0; p < moving_; ++p) {
      const PlanRange& mixed = plan_.mixed[u.mixed + p];
      const Rows moved{plan_.columns_of_entries + mixed.begin, mixed.size(), {w_.K.x}, s_};
      rows.matrix = PackArray{w_.DK.x} + p * n_ * s_;
      for_each_block(
          s_, [&]<unsigned kAtOnce>(unsigned j) __attribute__((always_inline)) {
            Pack sum[kAtOnce];
            for (Pack& x : sum) x = Pack::of(0.0);
            add_products<kAtOnce>(PackArray{w_.slope.x} + p * n_, moved, j, sum);
            subtract_products<kAtOnce>(center, rows, j, sum);
            for (unsigned c = 0; c < kAtOnce; ++c) value(1 + p, j + c, sum[c]);
          });
    }
  }

  /// Stores Δ, then r_pΔ for each p.
  REGULUS_LANE_INLINE void weigh(const Pack& range) noexcept {
    const PackArray weight{w_.weight_of_value.x};
    weight.put(0, range);
    for (unsigned p = 0; p < wides_; ++p)
      weight.put(1 + p, product_ru(radius(plan_.wide[p].variable), range));
  }

  /// Bounds one uncertain quantity that is not a coordinate of a ball.
  REGULUS_LANE_INLINE void bound_single(unsigned index) noexcept {
    const SecondOrderPlan::RowVariable& u = plan_.row_variables[index];
    const Pack range = radius(u.variable);
    weigh(range);
    const PackArray weight_of_g = PackArray{w_.weight_of_g.x} + u.slot * n_;
    read_row_variable(
        u,
        range, [&](unsigned column, const Pack& g, const Pack& by) __attribute__((always_inline)) {
          weight_of_g.add_fused(column, g, by);
        });
    const PackArray weight{w_.weight_of_value.x};
    for (unsigned k = u.first.begin; k < u.first.end; ++k)
      (PackArray{w_.weight.x} + u.slot * n_)
          .add_fused(plan_.entries[k].column, magnitude(PackArray{w_.center.x}[k - u.first.begin]),
                     range);
    const PackArray R = PackArray{w_.R_of_wide.x} + u.slot * s_,
                    own = PackArray{w_.R_of_row.x} + index * s_;
    const PackArray forms = PackArray{w_.forms.x} + index * s_;
    if (plan_.weighs_row_variables) clear(own, s_);
    multiply_row_variable(
        u, [&](unsigned p, unsigned j, const Pack& x) __attribute__((always_inline)) {
          R.add_fused(p * s_ * s_ + j, magnitude(x), weight[p]);
          if (p == 0) forms.put(j, x);
          if (plan_.weighs_row_variables) own.add_fused(j, magnitude(x), weight[p]);
        });
  }

  /// The coordinates of a point in a ball: ρ·(Σx²)^½ instead of Δ·Σ|x|, by Cauchy and Schwarz. By
  /// Minkowski's inequality, it also holds for the weights and for the additions for rounding.
  REGULUS_LANE_INLINE void bound_ball(const SecondOrderPlan::Group& group) noexcept {
    const PackArray R{w_.group_R.x}, lower{w_.group_lower.x};
    clear(R, (1 + moving_) * s_);
    clear(lower, (1 + moving_) * n_);
    Pack range = Pack::of(0.0);
    for (unsigned k = group.members.begin; k < group.members.end; ++k)
      range = larger(range, radius(plan_.row_variables[k].variable));
    weigh(range);
    for (unsigned k = group.members.begin; k < group.members.end; ++k) {
      const SecondOrderPlan::RowVariable& u = plan_.row_variables[k];
      read_row_variable(u, range, [](unsigned, const Pack&, const Pack&) {});
      add_squares(plan_, u.first, {w_.center.x}, lower);
      for (unsigned p = 0; p < moving_; ++p)
        add_squares(plan_, plan_.mixed[u.mixed + p], PackArray{w_.slope.x} + p * n_,
                    lower + (1 + p) * n_);
      const PackArray forms = PackArray{w_.forms.x} + k * s_;
      multiply_row_variable(
          u, [&](unsigned p, unsigned j, const Pack& x) __attribute__((always_inline)) {
            R.add_fused(p * s_ + j, x, x);
            if (p == 0) forms.put(j, x);
          });
      if (plan_.weighs_row_variables) clear(PackArray{w_.R_of_row.x} + k * s_, s_);
    }
    take_roots(R, (1 + moving_) * s_);
    take_roots(lower, (1 + moving_) * n_);
    add_ball(group.slot);
  }

  REGULUS_LANE_INLINE void add_ball(unsigned slot) noexcept {
    const PackArray R{w_.group_R.x}, lower{w_.group_lower.x}, weight{w_.weight_of_value.x};
    for (unsigned p = 0; p <= moving_; ++p) {
      const PackArray weights = PackArray{p == 0 ? w_.weight.x : w_.weight_of_g.x} + slot * n_;
      for (unsigned j = 0; j < n_; ++j) weights.add_fused(j, lower[p * n_ + j], weight[p]);
      for (unsigned j = 0; j < s_; ++j)
        PackArray{w_.R_of_wide.x}.add_fused((p * s_ + slot) * s_ + j, R[p * s_ + j], weight[p]);
    }
  }

  /// Adds second order, and the rounding of R and of D_pK₀: |fl(D_pK₀) − D_pK₀| ≤ γ|D_p||K₀|.
  REGULUS_LANE_INLINE void bound_rows() noexcept {
    for (double* sum : {w_.weight.x, w_.weight_of_g.x, w_.rest.x, w_.same_row.x})
      raise({sum}, s_ * n_, kManyTerms);
    const PackArray slack{w_.K.x}, sum_DK{w_.sum_DK.x};  // K₀ is not needed any more
    clear(slack, n_ * s_);
    for (unsigned i = 0; i < n_; ++i)
      add_row_product(PackArray{w_.sum_D.x} + i * n_, {nullptr, n_, {w_.abs_K.x}, s_}, s_,
                      slack + i * s_);
    for (unsigned e = 0; e < n_ * s_; ++e) {
      const Pack magnitude_of_DK = raised(slack[e], kManyTerms);
      sum_DK.put(e, raised(sum_DK[e] + magnitude_of_DK * Pack::of(kSecondOrderGamma), kFewTerms));
      slack.put(e,
                raised(magnitude_of_DK + PackArray{w_.abs_K.x}[e], kFewTerms));  // |K₀| + Σr|D||K₀|
    }
    for (unsigned i = 0; i < s_; ++i) bound_row(i);
  }

  /// Bounds row i of R: the parts of u, of each wide variable, and the remainder.
  REGULUS_LANE_INLINE void bound_row(unsigned i) noexcept {
    const PackArray row = PackArray{w_.moving.x} + i * s_, slack{w_.K.x},
                    rounding{w_.weight_of_row.x};
    const PackArray g = PackArray{w_.weight_of_g.x} + i * n_,
                    weight = PackArray{w_.weight.x} + i * n_;
    clear(rounding, s_);
    for (unsigned j = 0; j < s_; ++j) {
      Pack sum = Pack::of(0.0);
      for (unsigned p = 1; p <= moving_; ++p)
        sum = sum + PackArray{w_.R_of_wide.x}[(p * s_ + i) * s_ + j];
      row.put(j, sum);
    }
    add_row_product(g, {nullptr, n_, {w_.sum_DK.x}, s_}, s_, row);
    add_row_product(g, {nullptr, n_, slack, s_}, s_, rounding);
    add_row_product(weight, {nullptr, n_, slack, s_}, s_, rounding);
    for (unsigned j = 0; j < s_; ++j)
      row.put(j,
              raised(row[j] + raised(rounding[j], kManyTerms) * Pack::of(2.0 * kSecondOrderGamma),
                     kManyTerms));
    for (unsigned j = 0; j < s_; ++j) {
      const unsigned e = i * s_ + j;
      PackArray{w_.R.x}.put(e, raised(row[j] + PackArray{w_.R_of_wide.x}[e], kManyTerms));
    }
  }

  REGULUS_LANE_INLINE void assemble(PackArray T) noexcept {
    const unsigned order = n_ + s_;
    const PackArray P{w_.P.x};
    for (unsigned i = 0; i < n_; ++i) {
      for (unsigned j = 0; j < n_; ++j) T.put(i * order + j, P[i * n_ + j]);
      for (unsigned j = 0; j < s_; ++j)
        T.put(i * order + n_ + j,
              raised(PackArray{w_.abs_K.x}[i * s_ + j] + PackArray{w_.sum_DK.x}[i * s_ + j],
                     kFewTerms));
    }
    for (unsigned i = 0; i < s_; ++i) {
      const PackArray row = T + (n_ + i) * order;
      for (unsigned j = 0; j < n_; ++j)
        row.put(j, PackArray{w_.rest.x}[i * n_ + j] + PackArray{w_.same_row.x}[i * n_ + j]);
      add_row_product(PackArray{w_.weight.x} + i * n_, {nullptr, n_, P, n_}, n_, row);
      add_row_product(PackArray{w_.weight_of_g.x} + i * n_, {nullptr, n_, P, n_}, n_, row);
      raise(row, n_, kManyTerms);
      for (unsigned j = 0; j < s_; ++j) row.put(n_ + j, PackArray{w_.R.x}[i * s_ + j]);
    }
  }

  const unsigned s_, wides_, moving_;
};

inline void bound(const SecondOrderPlan& plan, const SecondOrderInput& input,
                  const SecondOrderWork& work, PointMatrix T) noexcept {
  Bounding(plan, input, work).run(T);
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::second_order
