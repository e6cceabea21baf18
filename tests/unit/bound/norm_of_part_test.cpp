// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/norm_of_part.hpp"

#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"

namespace regulus::detail::test {
namespace {

/// Two velocities and an angular velocity.
Model model() {
  return parse_model(R"toml(regulus = 1
name = "cart"
[pose]
x = "m"
y = "m"
a = "rad"
[matrix]
rows = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
[motion.m]
x = 0
y = 0
a = 0
)toml",
                     "model.toml");
}

ComponentBound freedom(std::size_t column, int attained) {
  ComponentBound c;
  c.component.kind = QuantityKind::kError;
  c.component.column = column;
  c.attained = end_at(attained);
  c.place.emplace().pose = "place " + std::to_string(column);
  return c;
}

ComponentBound norm_of(PosePart part) {
  ComponentBound c = freedom(0, 3);
  c.component.part = part;
  return c;
}

TEST(NormOfAPart, IsAtLeastWhatItsFreedomsAttain) {
  const std::vector<ComponentBound> others = {freedom(0, 2), freedom(1, 5), freedom(2, 7)};
  ComponentBound norm = norm_of(PosePart::kLinear);
  raise_by_freedoms(norm, others, model());
  EXPECT_EQ(norm.attained->approx, 5);
  EXPECT_EQ(norm.place->pose, "place 1");
  ComponentBound unknown = norm_of(PosePart::kAngular);
  unknown.attained.reset();
  raise_by_freedoms(unknown, others, model());
  EXPECT_EQ(unknown.attained->approx, 7);
}

TEST(NormOfAPart, KeepsALargerValueOfItsOwn) {
  ComponentBound norm = norm_of(PosePart::kLinear);
  raise_by_freedoms(norm, std::vector<ComponentBound>{freedom(0, 2), freedom(1, 3)}, model());
  EXPECT_EQ(norm.attained->approx, 3);
  EXPECT_EQ(norm.place->pose, "place 0");
}

TEST(NormOfAPart, IsNotUsedForAFreedom) {
  ComponentBound one = freedom(0, 1);
  raise_by_freedoms(one, std::vector<ComponentBound>{freedom(1, 9)}, model());
  EXPECT_EQ(one.attained->approx, 1);
}

}  // namespace
}  // namespace regulus::detail::test
