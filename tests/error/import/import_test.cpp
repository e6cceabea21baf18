// SPDX-License-Identifier: GPL-3.0-or-later
// Robot files that are refused, and what is said then.
#include "codegen/model/import/import.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/support/errors.hpp"

namespace regulus::detail::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string input_error(const std::string& text, const ImportOptions& options = {}) {
  try {
    (void)import_robot(text, "r.urdf", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string usage_error(const std::string& text, const ImportOptions& options = {}) {
  try {
    (void)import_robot(text, "r.urdf", options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& inside = "<axis xyz='0 0 1'/>",
                  const std::string& type = "revolute") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>\n";
}

std::string robot(const std::string& joints) {
  return "<robot name='r'>\n<link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n" +
         joints + "</robot>";
}

TEST(ImportRefusal, NamesTheLineOfWhatIsNotXml) {
  EXPECT_THAT(input_error("<robot>\n<link name='a'>\n</robot>"),
              AllOf(StartsWith("r.urdf:"), HasSubstr("not XML")));
  EXPECT_THAT(input_error(""), HasSubstr("not XML"));
  EXPECT_THAT(input_error("regulus = 1\n"), Not(HasSubstr("XML_ERROR")));
  EXPECT_THAT(input_error("regulus = 1\n"), HasSubstr("a model in TOML needs no import"));
  EXPECT_THAT(input_error("<html></html>"), StartsWith("r.urdf:1: the root element is <html>"));
}

TEST(ImportRefusal, SaysToExpandMacros) {
  EXPECT_THAT(input_error(robot(joint("j", "a", "b", "<origin xyz='0 0 ${height}'/>"))),
              AllOf(StartsWith("r.urdf:3: xyz of joint 'j'"), HasSubstr("xacro")));
}

TEST(ImportRefusal, NumbersThatAreNone) {
  for (const char* number : {"nan", "inf", "0x1p3", "1,5", "1e", "--1", "1e5000", "."})
    EXPECT_THAT(
        input_error(robot(joint("j", "a", "b", std::string("<origin xyz='0 0 ") + number + "'/>"))),
        HasSubstr("not a number"))
        << number;
  EXPECT_THAT(input_error(robot(joint("j", "a", "b", "<origin xyz='0 0'/>"))),
              HasSubstr("has 2 numbers; there must be 3"));
}

TEST(ImportRefusal, AnAxisOfZero) {
  EXPECT_THAT(input_error(robot(joint("j", "a", "b", "<axis xyz='0 0 1e-12'/>"))),
              HasSubstr("the axis of joint 'j' is zero"));
}

TEST(ImportRefusal, LimitsInTheWrongOrder) {
  EXPECT_THAT(input_error(robot(joint("j", "a", "b", "<limit lower='1' upper='-1'/>"))),
              HasSubstr("above the upper one"));
}

TEST(ImportRefusal, ALinkWithTwoParents) {
  EXPECT_THAT(input_error(robot(joint("i", "a", "c") + joint("j", "b", "c"))),
              HasSubstr("link 'c' is the child of two joints, 'i' and 'j'"));
}

TEST(ImportRefusal, ListsTheTipsToChooseFrom) {
  const std::string text =
      robot(joint("i", "a", "b") + joint("j", "b", "c") + joint("k", "b", "d"));
  EXPECT_THAT(usage_error(text),
              AllOf(HasSubstr("several links"), HasSubstr("c (2 joints), d (2 joints)"),
                    HasSubstr("--tip LINK")));
  EXPECT_EQ(usage_error(text, {.tip = "c"}), "");
  EXPECT_THAT(usage_error(text, {.tip = "cc"}), HasSubstr("the links are a, b, c, d"));
  EXPECT_THAT(usage_error(text, {.base = "d", .tip = "c"}), HasSubstr("no chain leads"));
}

TEST(ImportRefusal, ListsTheRootsToChooseFrom) {
  EXPECT_THAT(usage_error(robot(joint("i", "a", "b") + joint("j", "c", "d"))),
              AllOf(HasSubstr("several links have no parent: a, c"), HasSubstr("--base LINK")));
}

TEST(ImportRefusal, JointsThatAnArmCannotHave) {
  EXPECT_THAT(input_error(robot(joint("i", "a", "b", "", "floating"))),
              HasSubstr("joint 'i' of the arm has the type 'floating'"));
  const std::string off_the_arm = joint("k", "a", "d");
  for (const char* leader : {"j", "k", "nothing", ""})
    EXPECT_THAT(
        input_error(robot(joint("i", "a", "b") + off_the_arm +
                          joint("j", "b", "c",
                                "<axis xyz='1 0 0'/><mimic joint='" + std::string(leader) + "'/>")),
                    {.tip = "c"}),
        HasSubstr("joint 'j' of the arm follows joint '" + std::string(leader) + "'"));
}

TEST(ImportRefusal, ALoopThroughTheArm) {
  EXPECT_THAT(
      input_error(
          "<mujoco><worldbody><body name='a'><joint name='i'/><body name='b' pos='1 0 0'>"
          "<joint name='j'/></body></body></worldbody>\n"
          "<equality><connect body1='b' body2='world' anchor='1 0 0'/></equality></mujoco>"),
      AllOf(StartsWith("r.urdf:2:"),
            HasSubstr("2 equations, 2 passive joints, rank 1 at the start")));
}

TEST(ImportRefusal, APartThatMayStandForOthers) {
  EXPECT_THAT(input_error("<robot>\n<xacro:include filename='a.xacro'/></robot>"),
              AllOf(StartsWith("r.urdf:2:"), HasSubstr("expand the macros first")));
  EXPECT_THAT(input_error("<robot><xacro:arm prefix='left'/></robot>"),
              HasSubstr("<xacro:arm> may stand for links and joints"));
  EXPECT_THAT(input_error("version https://git-lfs.github.com/spec/v1\n"),
              HasSubstr("git lfs pull"));
  EXPECT_THAT(input_error("\xff\xfe<"), HasSubstr("save it in UTF-8"));
  EXPECT_THAT(input_error(robot(joint("i", "a", "b", "<origin xyz='0 1e101 0'/>"))),
              HasSubstr("'1e101', which is above 1e100"));
}

TEST(ImportRefusal, ADistanceThatIsNone) {
  EXPECT_THAT(usage_error(robot(joint("i", "a", "b")), {.snap = "x"}), HasSubstr("--snap"));
  EXPECT_THAT(usage_error(robot(joint("i", "a", "b")), {.snap = "1"}),
              HasSubstr("between 0 and 0.01"));
}

}  // namespace
}  // namespace regulus::detail::test
