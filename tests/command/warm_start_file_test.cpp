// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the data kept between runs: the key covers whatever decides the forms; the text loses nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "codegen/question/engine/build_id.hpp"
#include "codegen/question/engine/forms_key.hpp"
#include "codegen/question/engine/symbolic_stages.hpp"
#include "codegen/question/engine/warm_start.hpp"
#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

const char* const kFormsModel = R"toml(regulus = 1
name = "small"
[pose]
x = "cm"
y = "cm"
[geometry]
r = {value = 4, tolerance = 0.05, group = "platform"}
[matrix]
rows = [["x", "r*y"], ["0", "r"]]
[motion.m]
x = [0.1, 2]
y = [0.1, 2]
)toml";

struct FormsQuestion {
  std::string text = kFormsModel;
  ModelOptions model{"a.toml", "m", {}, {}, ""};
  FormulationOptions functions;
  Isa isa = Isa::kPortable;
  std::string program = "program", compiler = "compiler";

  void replace(const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  }
  [[nodiscard]] std::string key() const {
    SymbolicStages stages(text, model, functions);
    return forms_key(stages.natural_formulation(), !stages.request().motion.alpha.is_zero(),
                     functions, isa, program, compiler);
  }
};

TEST(FormsKey, ChangesWithWhateverDecidesTheForms) {
  const std::function<void(FormsQuestion&)> changes[] = {
      [](FormsQuestion& q) { q.replace("r*y", "r*y^2"); },
      [](FormsQuestion& q) { q.replace("r*y", "2*r*y"); },
      [](FormsQuestion& q) { q.replace("value = 4", "value = 4.5"); },
      [](FormsQuestion& q) { q.model.ranges = {"x=10:20"}; },
      [](FormsQuestion& q) { q.model.tolerances = {"platform=0"}; },
      [](FormsQuestion& q) { q.model.tolerances = {"platform=1"}; },
      [](FormsQuestion& q) { q.model.alpha = std::string(1, '3'); },
      [](FormsQuestion& q) { q.functions.matrix ^= true; },
      [](FormsQuestion& q) { q.functions.matrix_derivatives ^= true; },
      [](FormsQuestion& q) { q.functions.left_product ^= true; },
      [](FormsQuestion& q) { q.functions.derivatives ^= true; },
      [](FormsQuestion& q) { q.functions.right_product ^= true; },
      [](FormsQuestion& q) { q.functions.determinant ^= true; },
      [](FormsQuestion& q) { q.functions.determinant_budget += 1; },
      [](FormsQuestion& q) { q.functions.forming_budget += 1; },
      [](FormsQuestion& q) { q.functions.expansion = ExpansionForm::kAtNominal; },
      [](FormsQuestion& q) { q.functions.expansion = ExpansionForm::kAtBox; },
      [](FormsQuestion& q) { q.functions.rows ^= true; },
      [](FormsQuestion& q) { q.functions.columns = ColumnSearch::kFirstOrder; },
      [](FormsQuestion& q) { q.functions.columns = ColumnSearch::kSecondOrder; },
      [](FormsQuestion& q) { q.functions.scaling ^= true; },
      [](FormsQuestion& q) { q.functions.threshold ^= true; },
      [](FormsQuestion& q) { q.functions.counts_occurrences ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.rewrite ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.horner ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.trigonometric ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.nesting.factor ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.nesting.complete_squares ^= true; },
      [](FormsQuestion& q) { q.functions.rewriting.weights["x"] = 2; },
      [](FormsQuestion& q) { q.isa = Isa::kAvx2; },
      [](FormsQuestion& q) { q.isa = Isa::kAvx512; },
      [](FormsQuestion& q) { q.program = "another program"; },
      [](FormsQuestion& q) { q.compiler = "another compiler"; },
      [](FormsQuestion& q) { q.program = "programc", q.compiler = "ompiler"; },
  };
  std::set<std::string> keys{FormsQuestion{}.key()};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    FormsQuestion question;
    changes[i](question);
    EXPECT_TRUE(keys.insert(question.key()).second) << "change " << i;
  }
}

TEST(FormsKey, DoesNotDependOnNamesOfFilesOrOnRemarks) {
  FormsQuestion other;
  other.model.path = "b.toml";
  other.replace("name = \"small\"", "name = \"another\" # a remark");
  EXPECT_EQ(other.key(), FormsQuestion{}.key());
}

TEST(ProgramIdentity, HoldsTheBuildOfTheProgramAndOfItsLibraries) {
  const std::string identity = build_id();
  EXPECT_EQ(identity, build_id());
  EXPECT_GE(std::count(identity.begin(), identity.end(), '\n'), 3);
  EXPECT_GE(identity.find('\n'), 32U) << identity;
}

ReportLabels labels() {
  ReportLabels labels;
  labels.rows = 7;
  labels.columns = 6;
  labels.constraints = 2;
  labels.pose = {{"x", "cm"}, {"phi", "rad"}};
  labels.variables = {{"t", "1", VariableKind::kMotion},
                      {"b_1", "cm", VariableKind::kGeometry, true},
                      {"error_x", "cm", VariableKind::kControl}};
  return labels;
}

WarmStart example_of_forms() {
  WarmStart p;
  p.detail = FormDetail::kSmallParts;
  p.program_key = std::string(64, '7');
  p.identity = "0123456789abcdef";
  return p;
}

TEST(WarmStart, IsReadBackAsItWas) {
  const WarmStart before = example_of_forms();
  const auto after = read_warm_start(to_text(before));
  ASSERT_TRUE(after);
  EXPECT_EQ(to_text(*after), to_text(before));
  EXPECT_EQ(after->detail, before.detail);
  EXPECT_EQ(after->program_key, before.program_key);
  EXPECT_EQ(after->identity, before.identity);
  EXPECT_FALSE(after->matrix);
}

TEST(WarmStart, IsNotReadFromAnythingElse) {
  const std::string text = to_text(example_of_forms());
  ASSERT_TRUE(read_warm_start(text));
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(read_warm_start(text.substr(0, size))) << size;
  const auto with = [&text](const std::string& from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return other.replace(at, from.size(), to);
  };
  EXPECT_FALSE(read_warm_start(with("\"format\":9", "\"format\":8")));
  EXPECT_FALSE(read_warm_start(with("\"format\":9", "\"format\":10")));
  EXPECT_FALSE(read_warm_start(with(std::string(64, '7'), "../" + std::string(61, '7'))));
  EXPECT_FALSE(read_warm_start(text + ' '));
  const std::string detail = "\"detail\":" + std::to_string(int(FormDetail::kSmallParts));
  EXPECT_FALSE(read_warm_start(with(detail, detail + ".0")));
  EXPECT_FALSE(read_warm_start(with(detail, "\"detail\":1e300")));
  EXPECT_FALSE(read_warm_start(with("\"matrix\"", "\"other\"")));
}

/// Returns a warm start for x + 1/3, the only entry of a matrix in three variables.
WarmStart square_example() {
  WarmStart p = example_of_forms();
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
}

/// After a change of format, a fuzzer finds nothing from the old seeds.
TEST(WarmStart, IsWhatTheFuzzerStartsFrom) {
  int seeds = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(REGULUS_SOURCE_DIR "/tests/fuzz/corpus/warm_start")) {
    EXPECT_TRUE(read_warm_start(file_contents(file.path()))) << file.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 2);
}

TEST(WarmStart, FitsAQuestionAndAKernelOfItsSizesOnly) {
  machine::PackKernel kernel;
  kernel.identity = example_of_forms().identity;
  kernel.variables = 3;
  kernel.motion_variables = 1;
  kernel.rows = 7;
  kernel.columns = 6;
  kernel.constraints = 2;
  kernel.pose_parameters = 2;
  EXPECT_TRUE(fits(example_of_forms(), kernel, labels()));
  for (std::uint32_t machine::PackKernel::*member :
       {&machine::PackKernel::variables, &machine::PackKernel::motion_variables,
        &machine::PackKernel::rows, &machine::PackKernel::columns,
        &machine::PackKernel::constraints, &machine::PackKernel::pose_parameters}) {
    machine::PackKernel other = kernel;
    ++(other.*member);
    EXPECT_FALSE(fits(example_of_forms(), other, labels()));
  }
  EXPECT_FALSE(fits(square_example(), kernel, labels()));
  ReportLabels square = labels();
  square.rows = square.columns = 1;
  kernel.rows = kernel.columns = 1;
  EXPECT_TRUE(fits(square_example(), kernel, square));
  EXPECT_FALSE(fits(example_of_forms(), kernel, square));
  const auto expect_misfit = [&](auto change) {
    WarmStart other = square_example();
    change(*other.matrix);
    EXPECT_FALSE(fits(other, kernel, square));
  };
  expect_misfit([](BallProgram& matrix) { matrix.inputs = 2; });
  expect_misfit([](BallProgram& matrix) { matrix.outputs.push_back(2); });
  kernel.identity.back() = 'x';
  EXPECT_FALSE(fits(square_example(), kernel, square));
}

}  // namespace
}  // namespace regulus::detail::test
