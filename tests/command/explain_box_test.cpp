// SPDX-License-Identifier: GPL-3.0-or-later
// explain --box: what it prints encloses the values of the matrix and of its determinant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kMatrixOfBox =
    "regulus = 1\nname = \"small\"\n[pose]\nx = \"m\"\ny = \"m\"\n"
    "[matrix]\nrows = [[\"x + y^2\", \"y\"], [\"-y\", \"1 + x\"]]\n"
    "[motion.m]\nx = [1, 2]\ny = [0, 1]\n[motion.wide]\nx = [-3, 2]\ny = [-1, 1]\n";

class ExplainBox : public testing::Test {
 protected:
  ExplainBox() { write_file(model_, kMatrixOfBox); }

  [[nodiscard]] json evaluation(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {kCommand, "explain", model_, "m", "--box", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return json::parse(run_command(words).output)["evaluation"];
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "model.toml";
};

std::array<double, 4> matrix_at(double x, double y) { return {x + y * y, y, -y, 1 + x}; }

bool holds(const json& bounds, double value) {
  const double slack = 1e-12 * (1 + std::fabs(value));
  return bounds[0].get<double>() <= value + slack && value - slack <= bounds[1].get<double>();
}

/// Every value at a pose of the box is in what was printed.
void expect_enclosures(const json& box, double x, double y) {
  const std::array<double, 4> M = matrix_at(x, y);
  for (std::size_t e = 0; e < 4; ++e) EXPECT_TRUE(holds(box["matrix"][e], M[e])) << e;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double entry =
          box["K"][2 * i].get<double>() * M[j] + box["K"][2 * i + 1].get<double>() * M[2 + j];
      EXPECT_TRUE(holds(box["product"][2 * i + j], entry)) << i << j;
      EXPECT_TRUE(holds(box["numeric_product"][2 * i + j], entry)) << i << j;
    }
  for (const json& bound : box["determinants"])
    EXPECT_TRUE(holds(bound["bounds"], M[0] * M[3] - M[1] * M[2])) << bound;
}

TEST_F(ExplainBox, EnclosesTheMatrixAndItsDeterminantByEachMethod) {
  const json box = evaluation({});
  EXPECT_EQ(box["box"]["x"], json({1.0, 2.0}));
  EXPECT_GE(box["determinants"].size(), 8U) << "methods, entries, expansions";
  for (const double x : {1.0, 1.25, 2.0})
    for (const double y : {0.0, 0.4, 1.0}) expect_enclosures(box, x, y);
}

TEST_F(ExplainBox, MultipliesByTheInverseAtTheMiddle) {
  const json box = evaluation({});
  const std::array<double, 4> M = matrix_at(1.5, 0.5);
  const double determinant = M[0] * M[3] - M[1] * M[2];
  EXPECT_NEAR(box["K"][0].get<double>(), M[3] / determinant, 1e-6);
  EXPECT_NEAR(box["K"][1].get<double>(), -M[1] / determinant, 1e-6);
}

TEST_F(ExplainBox, NeverSaysThatAMatrixIsRegularWhereItIsNot) {
  // det = 0 at x = -1, y = 0.
  const json box = evaluation({"--range", "x=-3:2", "--range", "y=-1:1"});
  for (const json& bound : box["determinants"]) {
    EXPECT_NE(bound["rohn"], true) << bound;
    EXPECT_TRUE(holds(bound["bounds"], 0)) << bound;
  }
}

TEST_F(ExplainBox, PrintsTheSameForPeople) {
  const std::string text = run_command({kCommand, "explain", model_, "m", "--box"}).output;
  for (const char* line : {"M(B), the matrix with natural entries", "multiplied symbolically",
                           "The determinant of M over the box", "x in [1, 2]"})
    EXPECT_THAT(text, HasSubstr(line));
}

}  // namespace
}  // namespace regulus::detail::test
