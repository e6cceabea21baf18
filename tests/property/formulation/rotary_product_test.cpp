// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/formulation/rotary_product.hpp"

#include "tests/support/trials.hpp"

namespace regulus::detail::rotary_product {
namespace {

/// K·A at nominal values of what touches one row.
void compare_nominal(const Model& model, const Motion& motion, Random& random, Count& count) {
  const RotaryKernel f(model, motion, ExpansionForm::kAtNominal);
  const regulus_expansion& x = *f.kernel().expansion;
  expect_own_rows(f);
  if (x.nominal == nullptr) return;
  for (int trial = 0; trial < 6; ++trial) {
    Box point;
    for (std::size_t v = 0; v < f.variables(); ++v)
      point.push_back(touches_one_row(f, v)
                          ? Interval(x.nominal[2 * v], x.nominal[2 * v + 1])
                          : Interval(random.between(f.range()[v].lo, f.range()[v].hi)));
    const Box expected = f.product_of(point);
    const Box found = f.values(x.product, f.n() * f.n(), point);
    if (expected.empty() || found.empty()) continue;
    ++count.nominal;
    expect_same(found, expected, "K·A at nominal values");
  }
}

TEST(RotaryProductProperty, IsTheNumericProductOfRandomRobotsWithCranks) {
  Count count;
  compare_random("RUS", test::trials(1, 3), 11, count);
  EXPECT_GE(count.points, test::trials(3, 10));
  EXPECT_GE(count.boxes, test::trials(1, 5));
  EXPECT_GE(count.steps, test::trials(8, 25));
  EXPECT_GE(count.second_steps, test::trials(8, 25));
}

TEST(RotaryProductProperty, IsTheNumericProductOfRandomRobotsInThePlane) {
  Count count;
  compare_random("RRR", 40, 12, count);
  EXPECT_GE(count.points, 100);
  EXPECT_GE(count.second_steps, 100);
  EXPECT_GE(count.turned, 20);
}

TEST(RotaryProductProperty, IsTheNumericProductOfTheModels) {
  Count count;
  Random random(14);
  for (const auto& [file, motion] :
       {std::pair("hexapod_6rus", "work"), std::pair("hexapod_6rus", "orbit"),
        std::pair("delta", "work"), std::pair("planar_3rrr", "regular"),
        std::pair("planar_3rrr", "circle")}) {
    Model model = load_model(std::string(REGULUS_SOURCE_DIR "/models/") + file + ".toml");
    compare(model, find_motion(model, motion), random, count);
  }
  EXPECT_GE(count.points, 50);
  EXPECT_GE(count.second_steps, 100);
  EXPECT_GE(count.turned, 4);
}

/// A matrix that a person writes may have a crank whose k is any function: here the derivatives of k
/// are 1, 2 and those of y·z, and its root is 1/W or a multiple of it.
TEST(RotaryProductProperty, HoldsForCranksThatAMatrixWritesOut) {
  Count count;
  Random random(17);
  for (const std::string k : {"z", "2*z", "-z", "y*z", "(z + 1/2*x)", "(x^2 + y^2 + z)/3"})
    for (const std::string sign : {"+", "-"}) {
      const std::string w = "sqrt(x^2 + y^2 - " + k + "^2)";
      const std::string other = sign == "+" ? "-" : "+";
      const std::string text =
          "regulus = 1\nname = \"crank\"\n[pose]\nx = \"m\"\ny = \"m\"\nz = \"m\"\n"
          "[matrix]\nrows = [[\"(" +
          k + "*x " + sign + " " + w + "*y)/(x^2 + y^2)\", \"(" + k + "*y " + other + " " + w +
          "*x)/(x^2 + y^2)\"], [\"-(x^2 + z)\", \"1 + y*z\"]]\n"
          "[motion.work]\nx = [1, 1.2]\ny = [1, 1.2]\nz = [0.3, 0.5]\n";
      const Model model = parse_model(text, "crank.toml");
      compare(model, find_motion(model, "work"), random, count);
    }
  EXPECT_GE(count.points, 100);
  EXPECT_GE(count.second_steps, 100);
}

TEST(RotaryProductProperty, HoldsForUncertainLengths) {
  Count count;
  Random random(15);
  Model planar = load_model(REGULUS_SOURCE_DIR "/models/planar_3rrr.toml");
  for (const char* groups : {"links", "base,platform", "base,links"}) {
    set_tolerance(planar, groups, "0.05");
    compare(planar, find_motion(planar, "regular"), random, count);
    compare_nominal(planar, find_motion(planar, "regular"), random, count);
  }
  EXPECT_GE(count.points, 20);
  EXPECT_GE(count.steps, 50);
  EXPECT_GE(count.nominal, 10);
}

TEST(RotaryProductProperty, HoldsForUncertainHexapods) {
  Count count;
  Random random(16);
  Model model = load_model(REGULUS_SOURCE_DIR "/models/hexapod_6rus.toml");
  set_tolerance(model, "cranks,base", "0.05");
  compare_nominal(model, find_motion(model, "work"), random, count);
  EXPECT_GE(count.nominal, 3);
}

}  // namespace
}  // namespace regulus::detail::rotary_product
