// SPDX-License-Identifier: GPL-3.0-or-later
// K·A with symbols for the parts of rotary legs is K·A: the oracle is A itself, multiplied by K in
// intervals. Its derivatives obey the mean value theorem.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "runtime/interval/arithmetic.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/lanes.hpp"
#include "tests/property/formulation/random_legs.hpp"

namespace regulus::detail::rotary_product {

using Random = test::RandomSource;
using test::random_robot;
using Box = std::vector<Interval>;

class RotaryKernel {
 public:
  RotaryKernel(const Model& model, const Motion& motion, ExpansionForm form)
      : formulation_(formulate(model, motion, options(form))),
        module_(lower(formulation_)),
        kernel_(select(module_), best_isa()),
        variety_(enclose_variety(model, motion, formulation_.variables)) {}

  [[nodiscard]] const regulus_kernel& kernel() const { return *kernel_.get(); }
  [[nodiscard]] const Box& range() const { return variety_.outer; }
  [[nodiscard]] std::size_t variables() const { return kernel().variables; }
  [[nodiscard]] std::size_t m() const { return kernel().rows; }
  [[nodiscard]] std::size_t n() const { return kernel().columns; }

  /// True if K·A was formed with a crank that is turned by an angle.
  [[nodiscard]] bool uses_angles() const {
    for (const Function& f : module_.functions)
      if (f.name == "left_product" || f.name == "nominal_product")
        for (const Node& node : f.program.nodes)
          if (node.op == Op::kAtan2) return true;
    return false;
  }

  /// Empty where the function is undefined.
  [[nodiscard]] Box values(regulus_function f, std::size_t outputs, const Box& box) const {
    AlignedBuffer in(2 * kLanes * box.size()), out(2 * kLanes * outputs), K(kLanes * m() * n());
    for (std::size_t e = 0; e < m() * n(); ++e) std::fill_n(K.get() + point_at(e, 0), kLanes, k(e));
    for (std::size_t v = 0; v < box.size(); ++v) {
      std::fill_n(in.get() + lower_at(v, 0), kLanes, box[v].lo);
      std::fill_n(in.get() + upper_at(v, 0), kLanes, box[v].hi);
    }
    Box result;
    if (CheckedKernel(kernel()).call(f, in.get(), K.get(), out.get()) != 0) return result;
    for (std::size_t e = 0; e < outputs; ++e)
      result.emplace_back(out[lower_at(e, 0)], out[upper_at(e, 0)]);
    return result;
  }

  /// An entry of K.
  [[nodiscard]] static double k(std::size_t e) {
    return 0.25 * static_cast<double>((5 * e) % 7) - 0.625;
  }

  /// K·A from A; empty where it is undefined.
  [[nodiscard]] Box product_of(const Box& box) const {
    const Box A = values(kernel().matrix, m() * n(), box);
    Box result;
    if (A.empty()) return result;
    for (std::size_t i = 0; i < n(); ++i)
      for (std::size_t j = 0; j < n(); ++j) {
        Interval entry(0.0);
        for (std::size_t l = 0; l < m(); ++l)
          entry = entry + Interval(k(i * m() + l)) * A[l * n() + j];
        result.push_back(entry);
      }
    return result;
  }

 private:
  static FormulationOptions options(ExpansionForm form) {
    FormulationOptions options;
    options.expansion = form;
    return options;
  }

  Formulation formulation_;
  Module module_;
  machine::MachineKernel kernel_;
  Variety variety_;
};

inline double magnitude(const Box& values) {
  double most = 0;
  for (const Interval& x : values) most = std::max(most, mag(x));
  return most;
}

/// Tests entries against others that enclose the same numbers.
inline void expect_same(const Box& found, const Box& expected, const char* what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t e = 0; e < found.size(); ++e)
    EXPECT_FALSE(certain_disjoint(found[e], expected[e]))
        << what << ' ' << e << ": [" << found[e].lo << ", " << found[e].hi << "] and ["
        << expected[e].lo << ", " << expected[e].hi << ']';
}

/// Counts what was compared, so that a test that compares nothing fails.
struct Count {
  int points = 0, boxes = 0, steps = 0, second_steps = 0, turned = 0, nominal = 0;
};

using Places = std::map<std::array<unsigned, 4>, Interval>;

inline Places listed(const RotaryKernel& f, const regulus_derivatives& d, const Box& box) {
  Places result;
  if (d.count == 0) return result;
  const Box all = f.values(d.function, d.count, box);
  for (unsigned i = 0; i < all.size(); ++i)
    result[{d.list[i].row, d.list[i].column, d.list[i].first, d.list[i].second}] = all[i];
  return result;
}

inline Interval at(const Places& places, std::array<unsigned, 4> place) {
  const auto found = places.find(place);
  return found == places.end() ? Interval(0.0) : found->second;
}

/// The kernel's K·A at points and over boxes.
inline void compare_products(const RotaryKernel& f, const Box& point, const Box& box,
                             Count& count) {
  const regulus_kernel& kernel = f.kernel();
  const Box expected = f.product_of(point);
  if (expected.empty() || kernel.left_product == nullptr) return;
  const std::size_t n = f.n();
  const Box left = f.values(kernel.left_product, n * n, point);
  if (!left.empty()) {
    ++count.points;
    expect_same(left, expected, "K·A at a point");
    for (const Interval& x : left)
      EXPECT_LE(x.hi - x.lo, 1e-8 * (1 + magnitude(expected))) << "a wide enclosure of a point";
  }
  const Box over = f.values(kernel.left_product, n * n, box);
  if (over.empty()) return;
  ++count.boxes;
  expect_same(over, expected, "K·A over a box");
}

inline bool touches_one_row(const RotaryKernel& f, std::size_t v) {
  return f.kernel().expansion->row_of_variable[v] >= 0;
}

/// ∂_v∂_w(K·A) of quantities that touch several rows.
inline void compare_second(const RotaryKernel& f, const Places& second, std::size_t v,
                           const Interval& step, const Box& before, const Box& after) {
  const std::size_t n = f.n();
  for (std::size_t w = 0; w < f.variables(); ++w) {
    if (touches_one_row(f, v) || touches_one_row(f, w)) continue;
    for (std::size_t e = 0; e < n * n; ++e) {
      const Interval slope = at(second, {unsigned(e / n), unsigned(e % n), unsigned(std::min(v, w)),
                                         unsigned(std::max(v, w))});
      EXPECT_FALSE(certain_disjoint(after[w * n * n + e] - before[w * n * n + e], step * slope))
          << "derivative of entry " << e << " by " << w << " and " << v;
    }
  }
}

/// ∂_v A of a quantity that touches one row, and how it changes along another variable.
inline void compare_rows(const RotaryKernel& f, const Places& first, const Places& second,
                         std::size_t v, const Interval& step, const Box& point, const Box& moved) {
  const std::size_t m = f.m(), n = f.n();
  const Box before = f.values(f.kernel().matrix, m * n, point);
  const Box after = f.values(f.kernel().matrix, m * n, moved);
  const Places first_before = listed(f, f.kernel().expansion->row_first, point);
  const Places first_after = listed(f, f.kernel().expansion->row_first, moved);
  for (unsigned i = 0; i < m; ++i)
    for (unsigned j = 0; j < n; ++j) {
      if (touches_one_row(f, v)) {
        const Interval slope = at(first, {i, j, unsigned(v), REGULUS_FIRST_ORDER});
        EXPECT_FALSE(certain_disjoint(after[i * n + j] - before[i * n + j], step * slope))
            << "A(" << i << ',' << j << ") by " << v;
      }
      for (unsigned w = 0; w < f.variables(); ++w) {
        if (!touches_one_row(f, w)) continue;
        const std::array<unsigned, 4> place{i, j, w, REGULUS_FIRST_ORDER};
        const Interval slope =
            at(second, {i, j, std::min(w, unsigned(v)), std::max(w, unsigned(v))});
        EXPECT_FALSE(
            certain_disjoint(at(first_after, place) - at(first_before, place), step * slope))
            << "derivative of A(" << i << ',' << j << ") by " << w << " and " << v;
      }
    }
}

/// Steps from a point along each variable: differences are steps times a value of the derivative.
inline void compare_derivatives(const RotaryKernel& f, const Box& point, const Box& box,
                                Count& count) {
  const regulus_kernel& kernel = f.kernel();
  if (kernel.left_derivatives == nullptr || kernel.left_product == nullptr) return;
  const std::size_t n = f.n(), variables = f.variables();
  const Box before = f.product_of(point);
  const Box D_before = f.values(kernel.left_derivatives, variables * n * n, point);
  const Box D = f.values(kernel.left_derivatives, variables * n * n, box);
  if (before.empty() || D_before.empty() || D.empty()) return;
  const Places second = listed(f, kernel.expansion->second, box);
  const Places row_first = listed(f, kernel.expansion->row_first, box);
  const Places row_second = listed(f, kernel.expansion->row_second, box);
  for (std::size_t v = 0; v < variables; ++v) {
    Box moved = point;
    moved[v] = Interval(point[v].lo < mid(box[v]) ? box[v].hi : box[v].lo);
    const Interval step = moved[v] - point[v];
    const Box after = f.product_of(moved);
    if (after.empty()) continue;
    ++count.steps;
    for (std::size_t e = 0; e < n * n; ++e)
      EXPECT_FALSE(certain_disjoint(after[e] - before[e], step * D[v * n * n + e]))
          << "entry " << e << " by variable " << v;
    const Box D_after = f.values(kernel.left_derivatives, variables * n * n, moved);
    if (D_after.empty() || second.empty()) continue;
    ++count.second_steps;
    compare_second(f, second, v, step, D_before, D_after);
    if (!row_first.empty() && !row_second.empty())
      compare_rows(f, row_first, row_second, v, step, point, moved);
  }
}

/// A search refuses a kernel that lists a derivative of another row.
inline void expect_own_rows(const RotaryKernel& f) {
  const regulus_expansion& x = *f.kernel().expansion;
  for (const regulus_derivatives* list : {&x.row_first, &x.row_second})
    for (unsigned i = 0; i < list->count; ++i) {
      const regulus_derivative& d = list->list[i];
      for (const unsigned v : {d.first, d.second})
        if (v < f.variables() && touches_one_row(f, v)) {
          EXPECT_EQ(x.row_of_variable[v], static_cast<int>(d.row)) << v;
        }
    }
}

inline void compare(const Model& model, const Motion& motion, Random& random, Count& count) {
  const RotaryKernel f(model, motion, ExpansionForm::kAtBox);
  expect_own_rows(f);
  count.turned += f.uses_angles();
  for (int trial = 0; trial < 12; ++trial) {
    Box point, box;
    const double part = random.one_in(2) ? 0.01 : 0.2;
    for (const Interval& range : f.range()) {
      const double x = random.between(range.lo, range.hi), half = part * (range.hi - range.lo);
      box.emplace_back(std::max(range.lo, x - half * random.unit()),
                       std::min(range.hi, x + half * random.unit()));
      point.emplace_back(std::clamp(x, box.back().lo, box.back().hi));
    }
    compare_products(f, point, box, count);
    compare_derivatives(f, point, box, count);
  }
}

inline void compare_random(const std::string& type, int robots, std::uint64_t seed, Count& count) {
  Random random(seed);
  for (int i = 0; i < robots; ++i) {
    const Model model = random_robot(type, random);
    compare(model, find_motion(model, "work"), random, count);
    if (::testing::Test::HasFailure()) break;
  }
}

}  // namespace regulus::detail::rotary_product
