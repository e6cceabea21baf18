// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/degrees.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A model of one angle phi, with these texts in the places that angles have.
std::string model_text(const std::string& unit, const std::string& entry, const std::string& range,
                       const std::string& rest = "") {
  return "regulus = 1\nname = \"m\"\n[pose]\nx = \"m\"\nphi = \"" + unit +
         "\"\n[matrix]\nrows = [[\"x\", \"" + entry +
         "\"], [\"1\", \"x\"]]\n[motion.a]\nx = [1, 2]\n" + "phi = " + range + "\n" + rest;
}

Motion motion_of(const std::string& text) { return parse_model(text, "m").motions.at(0); }

std::string lower_end(const std::string& unit, const std::string& end) {
  const Motion motion = motion_of(model_text(unit, "cos(phi)", "[" + end + ", \"100*deg\"]"));
  return formula_text(motion.parameters.at(1).range.lo);
}

std::string refusal_of(const std::string& text) try {
  static_cast<void>(parse_model(text, "m"));
  return "";
} catch (const InputError& error) {
  return error.what();
}

TEST(Degrees, AreTheNumbersOfAPoseParameterInDegrees) {
  for (const char* end : {"10", "\"10\"", "\"10deg\"", "\"10°\"", "\"10 deg\"", "\"10*deg\"",
                          "\"deg*10\"", "\"20*sin(30*deg)\""})
    EXPECT_EQ(lower_end("deg", end), "10") << end;
}

TEST(Degrees, AreExactPartsOfPiInRadians) {
  for (const char* end : {"\"10deg\"", "\"10°\"", "\"10*deg\"", "\"pi/18\""})
    EXPECT_EQ(lower_end("rad", end), "(1/18)*pi") << end;
}

TEST(Degrees, MakeTheNameTheAngleItselfInExpressions) {
  const Model model = parse_model(model_text("deg", "sin(2*phi) + phi/deg", "[1, 2]"), "m");
  EXPECT_EQ(formula_text(model.matrix(0, 1)), "phi + sin((1/90)*phi*pi)");
}

TEST(Degrees, HoldForExpressionsErrorsAndOverrides) {
  const std::string text =
      model_text("deg", "cos(phi)", "\"3*x + 20*cos(60*deg)\"", "error = { phi = \"0.5deg\" }\n");
  Model model = parse_model(text, "m");
  Motion& motion = model.motions.at(0);
  EXPECT_EQ(formula_text(motion.pose.at(1)), "10 + 3*x");
  EXPECT_EQ(formula_text(motion.error.at(1)), "1/2");
  Motion box = motion_of(model_text("deg", "cos(phi)", "[1, 2]"));
  set_range(model, box, "phi", "-5*deg:7°");
  EXPECT_EQ(formula_text(box.parameters.at(1).range.lo), "-5");
  EXPECT_EQ(formula_text(box.parameters.at(1).range.hi), "7");
}

TEST(Degrees, AreRefusedWhereRadiansMayBeMeant) {
  EXPECT_THAT(refusal_of(model_text("deg", "phi", "[1, 2]")), HasSubstr("write phi/deg"));
  EXPECT_THAT(refusal_of(model_text("deg", "sqrt(phi)", "[1, 2]")), HasSubstr("write phi/deg"));
  EXPECT_THAT(refusal_of(model_text("deg", "x", "[1, 2]", "constraints = [\"phi - 1\"]\n")),
              HasSubstr("write phi/deg"));
  EXPECT_THAT(refusal_of(model_text("deg", "cos(phi)", "[0, \"pi/2\"]")), HasSubstr("write 180"));
  EXPECT_THAT(refusal_of(model_text("deg", "cos(phi)", "\"atan(x)\"")), HasSubstr("gives radians"));
  EXPECT_THAT(refusal_of(model_text("degrees", "cos(phi)", "[0, 1]")),
              HasSubstr("m:5: the unit 'degrees'"));
}

TEST(Degrees, GiveASixLeggedPlatformTheSameMatrix) {
  const std::string anchors =
      "base = [[1,0,0],[2,0,0],[3,0,0],[0,1,0],[0,2,0],[0,3,0]]\n"
      "platform = [[1,0,0],[2,0,0],[3,0,0],[0,1,0],[0,2,0],[0,3,0]]\n"
      "[motion.a]\nx = 0\ny = 0\nz = 1\npsi = 0\ntheta = 0\nphi = 0\n";
  const std::string head = "regulus = 1\nname = \"m\"\n[gough]\norientation = \"euler-zxz\"\n";
  const Model radians = parse_model(head + anchors, "m");
  const Model degrees = parse_model(head + "angle_unit = \"deg\"\n" + anchors, "m");
  EXPECT_EQ(degrees.pose.at(3).unit, "deg");
  GiNaC::exmap same;
  for (std::size_t i = 0; i < radians.pose.size(); ++i) {
    const GiNaC::ex scale = i < 3 ? GiNaC::ex(1) : one_degree();
    same[degrees.pose[i].symbol] = radians.pose[i].symbol / scale;
  }
  for (std::size_t g = 0; g < radians.geometry.size(); ++g)
    same[degrees.geometry[g].symbol] = radians.geometry[g].symbol;
  for (unsigned i = 0; i < 6; ++i)
    for (unsigned j = 0; j < 6; ++j)
      EXPECT_TRUE((degrees.matrix(i, j).subs(same) - radians.matrix(i, j)).expand().is_zero());
}

TEST(Degrees, AreWhatAnOptionGivesTheAnglesOfAnArm) {
  const auto tolerance_of = [](const std::string& unit, const char* groups, const char* text) {
    Model model =
        parse_model("regulus = 1\nname = \"m\"\n[serial]\nunit = \"m\"\nangle_unit = \"" + unit +
                        "\"\nconvention = \"standard-dh\"\nlength_tolerance = 0\nangle_tolerance = "
                        "0\njoints = [{ name "
                        "= \"q1\", a = 1, alpha = 0.5 }, { name = \"q2\", a = 1 }]\n[motion.a]\nq1 "
                        "= 0\nq2 = 1\n",
                    "m");
    set_tolerance(model, groups, text);
    for (const GeometryParameter& g : model.geometry)
      if (g.group == "angles") return formula_text(g.tolerance);
    return std::string("none");
  };
  EXPECT_EQ(tolerance_of("deg", "angles", "0.5"), "(1/360)*pi");
  EXPECT_EQ(tolerance_of("deg", "angles", "0.5*deg"), "(1/360)*pi");
  EXPECT_EQ(tolerance_of("rad", "angles", "0.5"), "1/2");
  EXPECT_EQ(tolerance_of("rad", "angles", "0.5*deg"), "(1/360)*pi");
  EXPECT_THROW(tolerance_of("deg", "lengths,angles", "0.5"), InputError);
}

/// A constant of [geometry] is no angle of a joint, whatever the name of its group.
TEST(Degrees, AreNotTakenForAConstantOfAGroupWithThatName) {
  const auto model_of = [](const char* tolerances) {
    return parse_model(
        std::string(
            "regulus = 1\nname = \"m\"\n[geometry]\nk = { value = 1, tolerance = 0.01, group = "
            "\"angles\" }\n[serial]\nangle_unit = \"deg\"\nconvention = \"standard-dh\"\n") +
            tolerances +
            "joints = [{ name = \"q1\", a = \"k\", alpha = 90 }, { name = \"q2\", a = 1 }]\n"
            "[motion.a]\nq1 = 0\nq2 = 1\n",
        "m");
  };
  Model model = model_of("");
  set_tolerance(model, "angles", "0.5");
  EXPECT_EQ(formula_text(model.geometry.front().tolerance), "1/2");
  Model both = model_of("angle_tolerance = 0.5\n");
  EXPECT_THROW(set_tolerance(both, "angles", "0.5"), InputError);
  EXPECT_THROW(set_tolerance(both, "angles", GiNaC::ex(1)), InputError);
}

TEST(Degrees, AnAngleBeyondATurnGetsAWarningWithItsLine) {
  EXPECT_THAT(motion_of(model_text("rad", "phi", "[-15, 15]")).warnings,
              ElementsAre("m:10: motion.a.phi is 15 rad, more than a turn; if degrees are meant, "
                          "write \"15deg\""));
  EXPECT_THAT(motion_of(model_text("rad", "phi", "-90")).warnings,
              ElementsAre(HasSubstr("m:10: motion.a.phi is -90 rad")));
  EXPECT_THAT(motion_of(model_text("rad", "phi", "0", "error = { phi = 7 }")).warnings,
              ElementsAre(HasSubstr("m:11: motion.a.error.phi is 7 rad")));
  EXPECT_THAT(motion_of(model_text("rad", "phi", "[-6.2832, 6.28]")).warnings, IsEmpty());
  EXPECT_THAT(motion_of(model_text("rad", "phi", "[-5, 5]")).warnings,
              ElementsAre("m:10: motion.a.phi is [-5, 5] rad, wider than a turn; if degrees are "
                          "meant, write \"-5deg\" and \"5deg\""));
  for (const char* meant : {"[-4.71, 4.71]", "[-3.5001, 3.5]", "[-3.1, 3.1]", "[\"-5*deg\", 5]"})
    EXPECT_THAT(motion_of(model_text("rad", "phi", meant)).warnings, IsEmpty()) << meant;
  EXPECT_THAT(motion_of(model_text("rad", "phi", "[\"-720*deg\", 0]")).warnings,
              ElementsAre(testing::EndsWith("rad, more than a turn")));
  EXPECT_THAT(motion_of(model_text("deg", "cos(phi)", "[-15, 361]")).warnings,
              ElementsAre(testing::EndsWith("is 361 deg, more than a turn")));
  EXPECT_THAT(motion_of(model_text("deg", "cos(phi)", "[-360, 360]")).warnings, IsEmpty());
}

TEST(Degrees, ANumberBeyondATurnInACosineGetsAWarning) {
  const auto warnings = [](const std::string& entry) {
    return parse_model(model_text("rad", entry, "0"), "m").warnings;
  };
  EXPECT_THAT(
      warnings("2 + cos(135)"),
      ElementsAre("m:7: matrix.rows[1][2] has the angle 135 rad, more than a turn; if degrees "
                  "are meant, write 135deg"));
  for (const char* entry : {"sin(phi + 45)", "tan(-90 - phi)", "2*cos((phi + 30) - 0.1)"})
    EXPECT_THAT(warnings(entry), ElementsAre(HasSubstr("more than a turn"))) << entry;
  for (const char* entry :
       {"135 + cos(phi)", "cos(135deg)", "cos(30*deg + phi)", "cos(2*pi*phi*20)", "cos(6.28)",
        "cos(sqrt(100)*phi)", "cos(phi*(100 + phi))"})
    EXPECT_THAT(warnings(entry), IsEmpty()) << entry;
}

}  // namespace
}  // namespace regulus::detail
