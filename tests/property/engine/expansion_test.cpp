// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel's expansion obeys the mean value theorem: if one variable moves by h, an entry changes
// by h times a value of the listed derivative, or not at all if none is listed.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
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
#include "tests/support/random_source.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using Random = test::RandomSource;
using Box = std::vector<Interval>;

double between(Random& random, const Interval& range) {
  const double part = static_cast<double>(random.below(1 << 20)) / (1 << 20);
  return std::clamp(range.lo + part * (range.hi - range.lo), range.lo, range.hi);
}

class ExpansionOf {
 public:
  ExpansionOf(const Model& model, const Motion& motion, ExpansionForm form)
      : formulation_(formulate(model, motion, options(form))),
        kernel_(select(lower(formulation_)), best_isa()),
        variety_(enclose_variety(model, motion, formulation_.variables)) {}

  [[nodiscard]] const regulus_kernel& kernel() const { return *kernel_.get(); }
  [[nodiscard]] const regulus_expansion& expansion() const { return *kernel().expansion; }
  [[nodiscard]] const Box& range() const { return variety_.outer; }

  [[nodiscard]] Box values(regulus_function f, std::size_t outputs, const Box& box) const {
    if (f == nullptr) return {};
    AlignedBuffer in(2 * kLanes * box.size()), out(2 * kLanes * outputs);
    AlignedBuffer K(kLanes * kernel().rows * kernel().columns);
    for (std::size_t e = 0; e < kernel().rows * kernel().columns; ++e)
      std::fill_n(K.get() + point_at(e, 0), kLanes, 0.25 * static_cast<double>(e % 7) - 0.625);
    for (std::size_t k = 0; k < box.size(); ++k) {
      std::fill_n(in.get() + lower_at(k, 0), kLanes, box[k].lo);
      std::fill_n(in.get() + upper_at(k, 0), kLanes, box[k].hi);
    }
    EXPECT_EQ(CheckedKernel(kernel()).call(f, in.get(), K.get(), out.get()), 0U);
    Box result;
    for (std::size_t e = 0; e < outputs; ++e)
      result.emplace_back(out[lower_at(e, 0)], out[upper_at(e, 0)]);
    return result;
  }

  /// Listed derivatives over a box, by place; `second` −1 for first derivatives.
  using Places = std::map<std::array<int, 4>, Interval>;
  [[nodiscard]] Places listed(const regulus_derivatives& d, const Box& box) const {
    const Box all = values(d.function, d.count, box);
    Places result;
    for (unsigned i = 0; i < d.count; ++i) {
      const regulus_derivative& at = d.list[i];
      const int second = at.second == REGULUS_FIRST_ORDER ? -1 : static_cast<int>(at.second);
      result[{static_cast<int>(at.row), static_cast<int>(at.column), static_cast<int>(at.first),
              second}] = all[i];
    }
    return result;
  }

  /// Returns zero if nothing is listed.
  static Interval at(const Places& places, std::array<int, 4> place) {
    const auto found = places.find(place);
    return found == places.end() ? Interval(0.0) : found->second;
  }

 private:
  static FormulationOptions options(ExpansionForm form) {
    FormulationOptions options;
    options.right_product = false;
    options.expansion = form;
    return options;
  }

  Formulation formulation_;
  machine::MachineKernel kernel_;
  Variety variety_;
};

bool possible(const Interval& change, const Interval& step, const Interval& derivative) {
  return !certain_disjoint(change, step * derivative);
}

void expect_mean_values(const ExpansionOf& e, Random& random) {
  const regulus_expansion& x = e.expansion();
  const std::size_t n = e.kernel().columns, m = e.kernel().rows, variables = e.kernel().variables;
  Box from;
  for (const Interval& range : e.range()) from.emplace_back(between(random, range));
  for (std::size_t k = 0; k < variables; ++k) {
    const int v = static_cast<int>(k);
    Box to = from, hull = from;
    to[k] = Interval(between(random, e.range()[k]));
    hull[k] = {std::min(from[k].lo, to[k].lo), std::max(from[k].hi, to[k].hi)};
    const Interval step = to[k] - from[k];
    const bool of_row = x.row_of_variable[k] >= 0;
    const Box B0 = e.values(x.product, n * n, from), B1 = e.values(x.product, n * n, to);
    const auto first0 = e.listed(x.first, from), first1 = e.listed(x.first, to);
    const auto first = e.listed(x.first, hull), second = e.listed(x.second, hull);
    const Box A0 = e.values(e.kernel().matrix, m * n, from);
    const Box A1 = e.values(e.kernel().matrix, m * n, to);
    const auto row0 = e.listed(x.row_first, from), row1 = e.listed(x.row_first, to);
    const auto row = e.listed(x.row_first, hull), row_second = e.listed(x.row_second, hull);
    for (int i = 0; i < static_cast<int>(m); ++i)
      for (int j = 0; j < static_cast<int>(n); ++j) {
        const std::size_t at = static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j);
        if (of_row) {
          EXPECT_TRUE(possible(A1[at] - A0[at], step, e.at(row, {i, j, v, -1}))) << i << j << v;
          EXPECT_TRUE(i == x.row_of_variable[k] || !certain_disjoint(A1[at], A0[at]));
        }
        for (int w = 0; w < static_cast<int>(variables); ++w) {
          const auto pair = std::minmax(v, w);
          if (x.row_of_variable[static_cast<std::size_t>(w)] >= 0) {
            EXPECT_TRUE(possible(e.at(row1, {i, j, w, -1}) - e.at(row0, {i, j, w, -1}), step,
                                 e.at(row_second, {i, j, pair.first, pair.second})))
                << "row " << i << j << w << v;
          } else if (!of_row && i < static_cast<int>(n)) {
            EXPECT_TRUE(possible(e.at(first1, {i, j, w, -1}) - e.at(first0, {i, j, w, -1}), step,
                                 e.at(second, {i, j, pair.first, pair.second})))
                << "K·A " << i << j << w << v;
          }
        }
        if (!of_row && i < static_cast<int>(n)) {
          EXPECT_TRUE(possible(B1[at] - B0[at], step, e.at(first, {i, j, v, -1}))) << i << j << v;
        }
      }
  }
}

Model text_model(const std::string& text) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text;
  return load_model(path);
}

TEST(ExpansionProperty, HoldsForRobot1AtNominalValuesAndAtTheBox) {
  Model model = load_model(REGULUS_SOURCE_DIR "/models/robot_1.toml");
  set_tolerance(model, "base,platform", "0.1");
  Random random(7);
  for (const ExpansionForm form : {ExpansionForm::kAtNominal, ExpansionForm::kAtBox}) {
    const ExpansionOf e(model, find_motion(model, "T2_errors"), form);
    EXPECT_EQ(e.expansion().nominal != nullptr, form == ExpansionForm::kAtNominal);
    std::size_t of_rows = 0;
    for (std::size_t k = 0; k < e.kernel().variables; ++k)
      of_rows += e.expansion().row_of_variable[k] >= 0;
    EXPECT_EQ(of_rows, 36U);
    expect_mean_values(e, random);
  }
}

TEST(ExpansionProperty, HoldsWithoutUncertainQuantities) {
  const Model model = load_model(REGULUS_SOURCE_DIR "/models/robot_2.toml");
  const ExpansionOf e(model, find_motion(model, "table5_30"), ExpansionForm::kAtNominal);
  EXPECT_EQ(e.expansion().nominal, nullptr);
  EXPECT_EQ(e.expansion().product, e.kernel().left_product);
  EXPECT_EQ(e.expansion().row_first.count, 0U);
  Random random(8);
  expect_mean_values(e, random);
}

TEST(ExpansionProperty, HoldsForSharedQuantitiesAndTallMatrices) {
  const Model model = text_model(R"~(regulus = 1
name = "tall"
source = "a test"
[pose]
x = "1"
y = "1"
[geometry]
shared = { value = 1, tolerance = 0.1 }
a = { value = 2, tolerance = 0.2 }
b = { value = 3, tolerance = 0.3 }
c = { value = [1, 2], radius = 0.1 }
[matrix]
rows = [["x*shared + a*b*sin(y)", "a^2"], ["y*shared", "c_1*x + c_2*y^2*c_1"], ["sqrt(x + y)", "1"]]
[motion.box]
x = [1, 2]
y = [0.5, 1.5]
)~");
  const ExpansionOf e(model, find_motion(model, ""), ExpansionForm::kAtNominal);
  std::vector<int> rows(e.expansion().row_of_variable,
                        e.expansion().row_of_variable + e.kernel().variables);
  EXPECT_EQ(rows, (std::vector<int>{-1, -1, -1, 0, 0, 1, 1}));
  ASSERT_NE(e.expansion().ball_of_variable, nullptr);
  EXPECT_EQ(e.expansion().ball_of_variable[5], e.expansion().ball_of_variable[6]);
  Random random(9);
  for (int round = 0; round < 20; ++round) expect_mean_values(e, random);
}

}  // namespace
}  // namespace regulus::detail
