// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::expect_refused;
using test::kExample;

const test::RefusedChange kRefusedModels[] = {
    {"TomlSyntaxErrorGivesItsLine", "y = [4, 5]", "y = [4, 5", 35, "not TOML", "TOML"},
    {"DuplicateKeyOfATableIsASyntaxError", "a2 = 10", "a2 = 10\na2 = 11", 12, "not TOML", "TOML"},
    {"InvalidUtf8IsASyntaxError", "made up", "made \xff up", 3, "not TOML", "TOML"},
    {"EmptyFile", "", "", 1, "no version", "must begin with: regulus = 1"},
    {"AnotherFormatVersion", "regulus = 1", "regulus = 2", 1, "the integer 2 for regulus",
     "version 1"},
    {"FormatVersionOfAnotherType", "regulus = 1", "regulus = \"1\"", 1, "the string '1'",
     "version 1"},
    {"MissingName", "name = \"example\"", "", 1, "no 'name'", "'name'"},
    {"NameOfAnotherType", "name = \"example\"", "name = 7", 2, "the integer 7 for name",
     "a string"},
    {"ControlCharacterInAName", "\"example\"", "\"a\\nb\"", 2, "'a\\x0ab'", "control characters"},
    {"BackslashInAUnitWhichCouldContinueAComment", "x = \"cm\"", "x = \"cm\\\\\"", 6, "for pose.x",
     "control characters or \\"},
    {"UnknownKeyAtTheTopSuggestsTheNearest", "source =", "sorce =", 3, "unknown key 'sorce'",
     "'source'"},
    {"UnknownKeyFarFromAnyListsTheKnown", "source =", "zzzzzzzz =", 3, "unknown key 'zzzzzzzz'",
     "geometry"},
    {"UnknownTable", "[let]", "[lets]", 17, "unknown key 'lets'", "'let'"},
    {"UnknownKeyInMatrix", "row_scale =", "row_scales =", 30, "unknown key 'matrix.row_scales'",
     "'row_scale'"},
    {"UnknownKeyInAGeometryConstant", "{ value = 4, tolerance", "{ value = 4, tolerence", 13,
     "unknown key 'geometry.r.tolerence'", "'tolerance'"},
    {"MissingPose", "", "regulus = 1\nname = \"a\"\n", 1, "no 'pose'", "'pose'"},
    {"MissingMatrix", "", "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n", 1, "no 'matrix'",
     "'matrix'"},
    {"MissingMotions", "", "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[1]]\n",
     1, "no 'motion'", "'motion'"},
    {"NoMotionInTheTable", "",
     "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[1]]\n[motion]\n", 7,
     "no motion", "[motion.NAME]"},
    {"EmptyPose", "", "regulus = 1\nname = \"a\"\n[pose]\n", 3, "empty [pose]", "pose parameter"},
    {"PoseThatIsNotATable", "", "regulus = 1\nname = \"a\"\npose = 3\n", 3,
     "the integer 3 for pose", "a table"},
    {"UnitThatIsNotAString", "x = \"cm\"", "x = 3", 6, "the integer 3 for pose.x", "a string"},
    {"PoseParameterThatIsAKeyOfMotions", "x = \"cm\"", "alpha = \"cm\"", 6,
     "'alpha', which is a key of motions", "another name"},
    {"ReservedNamePi", "x = \"cm\"", "pi = \"cm\"", 6, "the name 'pi' is reserved", "another name"},
    {"ReservedNameOfAFunction", "half = 0.5", "atan2 = 0.5", 21, "the name 'atan2' is reserved",
     "another name"},
    {"ReservedNameOfAPreconditionerEntry", "half = 0.5", "k_1_12 = 0.5", 21,
     "the name 'k_1_12' is reserved", "another name"},
    {"KeyThatIsNotAName", "half = 0.5", "\"x; system(0)\" = 0.5", 21, "key 'x; system(0)' in let",
     "a letter, then letters, digits and underscores"},
    {"KeyThatStartsWithAnUnderscore", "half = 0.5", "_half = 0.5", 21, "key '_half'",
     "a letter, then"},
    {"KeyOfOtherLetters", "half = 0.5", "\"h\u00e4lf\" = 0.5", 21, "key 'hälf'", "a letter, then"},
    {"KeyThatIsTooLong", "half = 0.5", std::string(65, 'a') + " = 0.5", 21, "key 'aaa",
     "at most 64"},
    {"NameDeclaredInTwoSections", "half = 0.5", "a2 = 0.5", 21,
     "'a2' is declared twice, as geometry.a2 (line 11) and as let.a2", "choose another name"},
    {"NameThatAPointAlreadyGives", "a2 = 10", "p1_2 = 10", 14, "'p1_2' is declared twice",
     "choose another name"},
    {"UndeclaredNameSuggestsTheNearest", "\"x - a2\", \"y\", \"c\"", "\"x - a3\", \"y\", \"c\"", 26,
     "undeclared name 'a3' (character 5 of 'x - a3') in matrix.rows[2][1]", "did you mean 'a2'?"},
    {"PointUsedWithoutACoordinate", "p1_1*x", "p1*x", 27, "undeclared name 'p1'",
     "did you mean 'p1_1'?"},
    {"CycleOfSubExpressionsIsNamed", "c = \"cos(phi)\"",
     "c = \"d + 1\"\nd = \"2*e1\"\ne1 = \"sin(c)\"", 19, "in a cycle: c -> d -> e1 -> c",
     "must not use itself"},
    {"SubExpressionThatUsesItself", "half = 0.5", "half = \"half\"", 21, "in a cycle: half -> half",
     "must not use itself"},
    {"MistakeInAnUnusedSubExpression", "half = 0.5", "half = 0.5\nunused = \"1 +\"", 22,
     "the end (character 4", "a number, a name or '('"},
    {"RaggedRows", "[\"x - a2\", \"y\", \"c\"]", "[\"x - a2\", \"y\"]", 26,
     "2 entries in matrix.rows[2]", "3, as in the first row"},
    {"FewerRowsThanColumns", "",
     "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[1, 2]]\n", 6,
     "1 rows of 2 entries", "as many rows as columns"},
    {"EmptyMatrix", "", "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = []\n", 6,
     "0 rows of 0 entries", "1 to 64"},
    {"RowThatIsNotAList", "",
     "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [\"x\"]\n", 6,
     "the string 'x' for matrix.rows[1]", "a row: a list of entries"},
    {"EntryOfAnotherType", "[1, 2.5,", "[true, 2.5,", 28, "a boolean for matrix.rows[4][1]",
     "a finite number, or an expression"},
    {"RowScaleOfAnotherLength", "\"1/rho_2\", 2, \"1/3\"]", "\"1/rho_2\", 2]", 30,
     "3 factors in matrix.row_scale", "4, one per row"},
    {"RowScaleZero", "\"1/rho_2\", 2, \"1/3\"]", "\"1/rho_2\", 0, \"1/3\"]", 30,
     "not positive in matrix.row_scale[3]", "a positive row scale"},
    {"RowScaleNegative", "\"1/rho_2\", 2, \"1/3\"]", "\"1/rho_2\", 2, \"1 - sqrt(2)\"]", 30,
     "not positive in matrix.row_scale[4]", "a positive row scale"},
    {"GeometryNaN", "a2 = 10", "a2 = nan", 11, "nan for geometry.a2", "a finite number"},
    {"GeometryInfinite", "a2 = 10", "a2 = -inf", 11, "an infinite number for geometry.a2",
     "a finite number"},
    {"GeometryThatUsesAPoseParameter", "a2 = 10", "a2 = \"2*x\"", 11, "undeclared name 'x'",
     "a constant"},
    {"NegativeTolerance", "tolerance = 0.05", "tolerance = -0.05", 13,
     "the negative number -0.05 in geometry.r.tolerance", "a number ≥ 0"},
    {"NegativeIrrationalTolerance", "tolerance = 0.05", "tolerance = \"1 - sqrt(2)\"", 13,
     "negative number", "a number ≥ 0"},
    {"RadiusOfASingleNumber", "{ value = 4, tolerance", "{ value = 4, radius", 13,
     "a radius for the single number geometry.r", "a list of coordinates"},
    {"ToleranceAndRadius", "radius = 0.05", "radius = 0.05, tolerance = 1", 14,
     "both a tolerance and a radius", "one of them"},
    {"GeometryWithoutAValue", "{ value = 4, tolerance", "{ tolerance", 13,
     "no 'value' in geometry.r", "'geometry.r.value'"},
    {"EmptyPoint", "[3, 7, 0]", "[]", 14, "0 coordinates in geometry.p1", "1 to 16"},
    {"GroupThatIsNotAName", "group = \"platform\"", "group = \"a,b\"", 13, "the name 'a,b'",
     "a letter, then"},
};

class RefusedModel : public testing::TestWithParam<test::RefusedChange> {};
TEST_P(RefusedModel, IsToldWithItsLine) { expect_refused(GetParam(), kExample); }
INSTANTIATE_TEST_SUITE_P(Each, RefusedModel, testing::ValuesIn(kRefusedModels),
                         test::name_of_change);

TEST(ModelRefusal, FileOfMoreThanFourMegabytes) {
  const std::string big = test::kExample + std::string(kLargestModelFile, '#');
  EXPECT_THROW((void)parse_model(big, "m.toml"), InputError);
}

TEST(ModelRefusal, FileThatIsMissingIsAFileError) {
  EXPECT_THROW((void)load_model("/nonexistent/model.toml"), FileError);
}

TEST(ModelRefusal, DirectoryIsAFileError) {
  EXPECT_THROW((void)load_model(std::string(REGULUS_SOURCE_DIR)), FileError);
}

}  // namespace
}  // namespace regulus::detail
