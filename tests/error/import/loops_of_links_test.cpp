// SPDX-License-Identifier: GPL-3.0-or-later
// Robots with loops that no [closure] can be made of.
#include <gmock/gmock.h>

#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Two bars on a base, of these lengths, whose ends meet.
std::string two_bars(const std::string& right, const std::string& type = "continuous") {
  return R"(<robot name="bars"><link name="base"/><link name="a"/><link name="a_end"/>
  <link name="b"/><link name="b_end"/><link name="flag"/>
  <joint name="left" type=")" +
         type + R"("><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="a_tip" type="fixed"><parent link="a"/><child link="a_end"/>
    <origin xyz="0 0.5 0"/></joint>
  <joint name="right" type="continuous"><parent link="base"/><child link="b"/>
    <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="b_tip" type="fixed"><parent link="b"/><child link="b_end"/>
    <origin xyz="0 )" +
         right + R"( 0"/></joint>
  <joint name="wave" type="continuous"><parent link="base"/><child link="flag"/>
    <axis xyz="0 0 1"/></joint></robot>)";
}

ImportOptions cut() {
  ImportOptions options;
  options.cuts = {"a_end=b_end"};
  options.actuated = {"left"};
  return options;
}

std::string input_error(const std::string& text, const ImportOptions& options) {
  try {
    (void)import_robot(text, "r.urdf", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string usage_error(const std::string& text, const ImportOptions& options) {
  try {
    (void)import_robot(text, "r.urdf", options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RefusedLoops, ThatCannotBeClosedAreNamedWithTheGap) {
  EXPECT_THAT(input_error(two_bars("0.3"), cut()),
              AllOf(HasSubstr("connect of 'a_end' and 'b_end' cannot be closed"),
                    HasSubstr("open by 0.2"), HasSubstr("('left', 'right')")));
}

TEST(RefusedLoops, WithoutAMotorSayHowManyAreNeeded) {
  ImportOptions options = cut();
  options.actuated.clear();
  const std::string arms = R"(<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
    <link name="c"/><link name="end"/>
    <joint name="j1" type="continuous"><parent link="base"/><child link="a"/></joint>
    <joint name="j2" type="continuous"><parent link="a"/><child link="b"/>
      <origin xyz="0 1 0"/></joint>
    <joint name="j3" type="continuous"><parent link="b"/><child link="c"/>
      <origin xyz="0 0 1"/></joint>
    <joint name="j4" type="continuous"><parent link="c"/><child link="end"/>
      <origin xyz="0 -1 0"/></joint>
    <joint name="goal" type="fixed"><parent link="base"/><child link="place"/>
      <origin xyz="0 0 1"/></joint></robot>)";
  options.cuts.clear();
  options.welds = {"end=place"};
  EXPECT_THAT(usage_error(arms, options),
              AllOf(HasSubstr("the loops leave 1 freedom"), HasSubstr("--actuated JOINT,JOINT")));
}

TEST(RefusedLoops, AtASingularStartAreCounted) {
  // Both bars in line: the toggle of the rigid triangle.
  std::string text = two_bars("0.5");
  EXPECT_THAT(input_error(text, cut()), AllOf(HasSubstr("2 equations"), HasSubstr("rank")));
}

TEST(RefusedLoops, NameTheJointThatIsNotOfAKnownType) {
  EXPECT_THAT(input_error(two_bars("0.5", "planar"), cut()),
              HasSubstr("joint 'left' of a loop has the type 'planar'"));
}

TEST(RefusedLoops, SayWhatIsWrongWithAt) {
  ImportOptions options = cut();
  options.at = {"nowhere=1"};
  EXPECT_THAT(usage_error(two_bars("0.5"), options),
              HasSubstr("--at: 'nowhere=1' is no JOINT=VALUE"));
}

TEST(RefusedLoops, NeedLinksThatTheFileHas) {
  ImportOptions options = cut();
  options.cuts = {"a_end=nowhere"};
  EXPECT_THAT(usage_error(two_bars("0.5"), options),
              HasSubstr("--cut: there is no link or joint 'nowhere'"));
}

TEST(RefusedLoops, OfAListSayTheLine) {
  struct Case {
    const char* list;
    const char* message;
  };
  for (const Case& c :
       {Case{"\nclosed_loop: [[a_end, b_end]\n", "r.yaml:2: a bracket does not end"},
        Case{"closed_loop: [[a_end]]\n", "a closed loop is no pair of frames"},
        Case{"closed_loop: [[a_end, x]]\n", "no link or joint 'x'"},
        Case{"closed_loop: [[a_end, b_end]]\ntype: [5d]\n", "the type '5d'"},
        Case{"closed_loop: [[a_end, b_end]]\ntype: [3d, 3d]\n", "2 types of 1 closed loops"},
        Case{"closed_loop: [[a_end, b_end]]\nname_mot: [m]\n", "no joint 'm'"},
        Case{"closed_loop: [[a_end b_end]]\njoint_name: [left]\njoint_type: [X]",
             "a closed loop is no pair"},
        Case{"closed_loop: ['a_end, b_end]]", "a quotation does not end"}}) {
    ImportOptions options;
    options.list = c.list;
    options.list_file = "r.yaml";
    EXPECT_THAT(input_error(two_bars("0.5"), options), HasSubstr(c.message)) << c.list;
  }
}

TEST(RefusedLoops, OptionsForThemAreForThemAlone) {
  ImportOptions options;
  options.closure = true;
  EXPECT_THAT(usage_error("<robot name='r'><link name='a'/></robot>", options),
              HasSubstr("are for robots with loops"));
}

}  // namespace
}  // namespace regulus::detail
