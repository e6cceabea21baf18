// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the data kept between runs: the key covers the whole question; the text loses nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>

#include "codegen/question/engine/build_id.hpp"
#include "codegen/question/engine/warm_start.hpp"
#include "tests/support/cached_command.hpp"
#include "tests/support/random_source.hpp"

namespace regulus {
namespace {

struct Question {
  std::string text = "x = 0.25";
  ModelOptions model{"a.toml", "small", {"x=0:1", "y=0:1"}, {"base=0.1"}, "2"};
  FormulationOptions functions;
  Isa isa = Isa::kPortable;
  std::string program = "program", compiler = "compiler";

  [[nodiscard]] std::string key() const {
    return warm_start_key(text, model, functions, isa, program, compiler);
  }
};

TEST(PreparedProblemKey, ChangesWithEveryPartOfTheQuestion) {
  const std::function<void(Question&)> changes[] = {
      [](Question& q) { q.text = "x = 0.26"; },
      [](Question& q) { q.model.motion = "large"; },
      [](Question& q) { q.model.ranges = {"x=0:1"}; },
      [](Question& q) { q.model.ranges = {"x=0:1y=0:1"}; },
      [](Question& q) {
        q.model.ranges = {"y=0:1", "x=0:1"};
      },
      [](Question& q) {
        q.model.ranges = {"x=0:1", "y=0:1", "base=0.1"}, q.model.tolerances = {};
      },
      [](Question& q) { q.model.tolerances = {"base=0.2"}; },
      [](Question& q) { q.model.tolerances = {}; },
      [](Question& q) { q.model.alpha = std::string(1, '3'); },
      [](Question& q) { q.model.alpha = ""; },
      [](Question& q) { q.functions.matrix ^= true; },
      [](Question& q) { q.functions.matrix_derivatives ^= true; },
      [](Question& q) { q.functions.left_product ^= true; },
      [](Question& q) { q.functions.derivatives ^= true; },
      [](Question& q) { q.functions.right_product ^= true; },
      [](Question& q) { q.functions.determinant ^= true; },
      [](Question& q) { q.functions.determinant_budget += 1; },
      [](Question& q) { q.functions.forming_budget += 1; },
      [](Question& q) { q.functions.expansion = ExpansionForm::kAtNominal; },
      [](Question& q) { q.functions.expansion = ExpansionForm::kAtBox; },
      [](Question& q) { q.functions.rows ^= true; },
      [](Question& q) { q.functions.columns = ColumnSearch::kFirstOrder; },
      [](Question& q) { q.functions.columns = ColumnSearch::kSecondOrder; },
      [](Question& q) { q.functions.rewriting.rewrite ^= true; },
      [](Question& q) { q.functions.rewriting.horner ^= true; },
      [](Question& q) { q.functions.rewriting.trigonometric ^= true; },
      [](Question& q) { q.functions.rewriting.nesting.factor ^= true; },
      [](Question& q) { q.functions.rewriting.nesting.complete_squares ^= true; },
      [](Question& q) { q.functions.rewriting.weights["x"] = 2; },
      [](Question& q) { q.isa = Isa::kAvx2; },
      [](Question& q) { q.isa = Isa::kAvx512; },
      [](Question& q) { q.program = "another program"; },
      [](Question& q) { q.compiler = "another compiler"; },
      [](Question& q) { q.program = "programc", q.compiler = "ompiler"; },
  };
  std::set<std::string> keys{Question{}.key()};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Question question;
    changes[i](question);
    EXPECT_TRUE(keys.insert(question.key()).second) << "change " << i;
  }
}

TEST(PreparedProblemKey, DoesNotDependOnWhereTheModelLies) {
  Question moved;
  moved.model.path = "b.toml";
  EXPECT_EQ(moved.key(), Question{}.key());
}

TEST(ProgramIdentity, HoldsTheBuildOfTheProgramAndOfItsLibraries) {
  const std::string identity = build_id();
  EXPECT_EQ(identity, build_id());
  EXPECT_GE(std::count(identity.begin(), identity.end(), '\n'), 3);
  EXPECT_GE(identity.find('\n'), 32U) << identity;
}

WarmStart example() {
  WarmStart p;
  p.labels.model = "roböt \"1\"\n";
  p.labels.model_sha256 = std::string(64, 'e');
  p.labels.motion = "small";
  p.labels.rows = 7;
  p.labels.columns = 6;
  p.labels.constraints = 2;
  p.labels.detail = FormDetail::kSmallParts;
  p.labels.pose = {{"x", "cm"}, {"phi", "rad"}};
  p.labels.twist = {{TwistComponent::Kind::kLinear, "vx", "cm"},
                    {TwistComponent::Kind::kAngular, "wz", "rad"}};
  p.labels.variables = {{"t", "1", VariableKind::kMotion},
                        {"b_1", "cm", VariableKind::kGeometry, true},
                        {"error_x", "cm", VariableKind::kControl}};
  p.variety.outer = {{-0.0, 0x1.8p-900}, {0.1, 0.3}, {-1e300, 1e300}};
  p.variety.inner = {Interval{0.0, 0.0}, std::nullopt, Interval{-1, 1}};
  p.variety.alpha = {1.0 / 3, std::nextafter(1.0 / 3, 1.0)};
  p.program_key = std::string(64, '7');
  p.identity = "0123456789abcdef";
  return p;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const Interval& a, const Interval& b) {
  EXPECT_TRUE(same_bits(a.lo, b.lo) && same_bits(a.hi, b.hi)) << a.lo << ' ' << a.hi;
}

TEST(WarmStart, IsReadBackAsItWas) {
  const WarmStart before = example();
  const auto after = read_warm_start(to_text(before));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->labels.model, before.labels.model);
  EXPECT_EQ(after->labels.twist.at(1).kind, TwistComponent::Kind::kAngular);
  EXPECT_EQ(after->labels.variables.at(2).kind, VariableKind::kControl);
  EXPECT_TRUE(after->labels.variables.at(1).is_idle);
  EXPECT_FALSE(after->labels.variables.at(2).is_idle);
  EXPECT_EQ(to_text(*after), to_text(before));
  EXPECT_EQ(after->program_key, before.program_key);
  EXPECT_EQ(after->identity, before.identity);
  expect_same(after->variety.alpha, before.variety.alpha);
  ASSERT_EQ(after->variety.outer.size(), 3U);
  ASSERT_EQ(after->variety.inner.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_same(after->variety.outer[k], before.variety.outer[k]);
    ASSERT_EQ(after->variety.inner[k].has_value(), before.variety.inner[k].has_value());
    if (before.variety.inner[k]) expect_same(*after->variety.inner[k], *before.variety.inner[k]);
  }
}

TEST(WarmStart, KeepsEveryBoundToTheLastBit) {
  test::RandomSource random(20070601);
  for (int i = 0; i < 2000; ++i) {
    WarmStart before = example();
    double bound = std::bit_cast<double>(random.next());
    if (!std::isfinite(bound)) continue;
    before.variety.outer[0] = {std::min(bound, 0.0), std::max(bound, 0.0)};
    const auto after = read_warm_start(to_text(before));
    ASSERT_TRUE(after);
    expect_same(after->variety.outer[0], before.variety.outer[0]);
  }
}

TEST(WarmStart, IsNotReadFromAnythingElse) {
  const std::string text = to_text(example());
  ASSERT_TRUE(read_warm_start(text));
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(read_warm_start(text.substr(0, size))) << size;
  const auto with = [&text](const std::string& from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return other.replace(at, from.size(), to);
  };
  EXPECT_FALSE(read_warm_start(with("\"format\":8", "\"format\":7")));
  EXPECT_FALSE(read_warm_start(with("\"format\":8", "\"format\":9")));
  EXPECT_FALSE(read_warm_start(with(std::string(64, '7'), "../" + std::string(61, '7'))));
  EXPECT_FALSE(read_warm_start(text + ' '));
  EXPECT_FALSE(read_warm_start(with("\"rows\":7", "\"rows\":7.0")));
  EXPECT_FALSE(read_warm_start(with("\"rows\":7", "\"rows\":1e300")));
  EXPECT_FALSE(read_warm_start(with("\"inner\"", "\"other\"")));
  EXPECT_FALSE(read_warm_start(with("0x1.8p-900", "-0x1p+0"))) << "bounds in wrong order";
  EXPECT_FALSE(read_warm_start(with("0x1.8p-900", "nan")));
  EXPECT_FALSE(read_warm_start(with("0x1.8p-900", "0x1.8p-900 ")));
}

/// Returns a warm start for x + 1/3, the only entry of a matrix in three variables.
WarmStart square_example() {
  WarmStart p = example();
  p.labels.rows = p.labels.columns = 1;
  BallProgram& matrix = p.matrix.emplace();
  matrix.inputs = 3;
  matrix.nodes = {{Op::kInput, 0, 0, 0}, {Op::kConstant, 0, 0, 0}, {Op::kAdd, 0, 1, 0}};
  matrix.constants.push_back(FlintRational::read("1/3").value());
  matrix.outputs = {2};
  return p;
}

TEST(WarmStart, KeepsTheMatrixForMoreDigits) {
  const auto after = read_warm_start(to_text(square_example()));
  ASSERT_TRUE(after && after->matrix);
  EXPECT_EQ(after->matrix->inputs, 3U);
  ASSERT_EQ(after->matrix->nodes.size(), 3U);
  EXPECT_EQ(after->matrix->nodes[2].op, Op::kAdd);
  EXPECT_EQ(after->matrix->nodes[2].b, 1U);
  EXPECT_EQ(after->matrix->constants.at(0).text(), "1/3");
  EXPECT_EQ(after->matrix->outputs, std::vector<NodeId>{2});
}

TEST(WarmStart, IsNotReadWithAMatrixThatCannotBeEvaluated) {
  const auto expect_refusal = [](auto change) {
    WarmStart damaged = square_example();
    change(damaged);
    EXPECT_FALSE(read_warm_start(to_text(damaged)));
  };
  EXPECT_TRUE(read_warm_start(to_text(square_example())));
  expect_refusal([](auto& p) { p.matrix->nodes[2].b = 2; });
  expect_refusal([](auto& p) { p.matrix->nodes[1].index = 1; });
  expect_refusal([](auto& p) { p.matrix->nodes[0].index = 3; });
  expect_refusal([](auto& p) { p.matrix->nodes[0].op = Op::kPoint; });
  expect_refusal([](auto& p) { p.matrix->nodes[0].op = Op(200); });
  expect_refusal([](auto& p) { p.matrix->outputs[0] = 3; });
  expect_refusal([](auto& p) { p.matrix->outputs.push_back(2); });
  expect_refusal([](auto& p) { p.matrix->inputs = 2; });
  expect_refusal([](auto& p) { p.matrix.reset(); });
  expect_refusal([](auto& p) { p.labels.rows = 2; });
}

/// After a change of format, a fuzzer finds nothing from the old seeds.
TEST(WarmStart, IsWhatTheFuzzerStartsFrom) {
  int seeds = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(REGULUS_SOURCE_DIR "/tests/fuzz/corpus/warm_start")) {
    EXPECT_TRUE(read_warm_start(test::file_contents(file.path()))) << file.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 2);
}

TEST(WarmStart, FitsAKernelOfItsSizesOnly) {
  machine::PackKernel kernel;
  kernel.identity = example().identity;
  kernel.variables = 3;
  kernel.motion_variables = 1;
  kernel.rows = 7;
  kernel.columns = 6;
  kernel.constraints = 2;
  kernel.pose_parameters = 2;
  EXPECT_TRUE(fits(example(), kernel));
  for (std::uint32_t machine::PackKernel::*member :
       {&machine::PackKernel::variables, &machine::PackKernel::motion_variables,
        &machine::PackKernel::rows, &machine::PackKernel::columns,
        &machine::PackKernel::constraints, &machine::PackKernel::pose_parameters}) {
    machine::PackKernel other = kernel;
    ++(other.*member);
    EXPECT_FALSE(fits(example(), other));
  }
  kernel.identity.back() = 'x';
  EXPECT_FALSE(fits(example(), kernel));
}

}  // namespace
}  // namespace regulus
