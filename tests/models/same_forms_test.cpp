// SPDX-License-Identifier: GPL-3.0-or-later
// The forms of a question depend on the model file alone. GiNaC orders sums by serial numbers of
// symbols and by addresses, which are others each time a file is read.
#include <gtest/gtest.h>

#include <filesystem>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/model/file/model_file.hpp"
#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

void append(std::string& text, const Expressions& forms) {
  for (const Expression& e : forms) text += to_string(e) + "\n";
}

/// Returns what the matrix and the motion are read as; nothing for a place to solve at.
std::string forms_of(const Model& model, const Motion& motion) {
  if (!motion.legs.empty() || !motion.tool.empty()) return {};
  FormulationOptions options;
  options.matrix_derivatives = options.left_product = options.derivatives = false;
  options.right_product = false;
  const Formulation f = formulate(model, motion, options);
  std::string text;
  for (const Expressions* forms : {&f.natural_matrix, &f.matrix, &f.must_be_defined,
                                   &f.motion_must_be_defined, &f.constraints, &f.pose})
    append(text, *forms);
  return text;
}

TEST(FormsOfShippedModels, AreTheSameEachTimeTheFileIsRead) {
  int motions = 0;
  for (const auto& file : std::filesystem::directory_iterator(kModels)) {
    if (file.path().extension() != ".toml") continue;
    std::vector<std::string> first;
    for (int time = 0; time < 4; ++time) {
      const Model model = load_model(file.path());
      if (model.closure) break;
      for (std::size_t m = 0; m < model.motions.size(); ++m) {
        const std::string text = forms_of(model, model.motions[m]);
        if (time == 0)
          first.push_back(text);
        else
          EXPECT_TRUE(text == first[m]) << model.name << " " << model.motions[m].name;
      }
    }
    motions += static_cast<int>(first.size());
  }
  EXPECT_GT(motions, 80);
}

}  // namespace
}  // namespace regulus::detail::test
