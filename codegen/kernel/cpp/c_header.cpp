// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/headers.hpp"

namespace regulus::detail {
namespace {

std::string fields(const KernelSubject& subject) {
  std::string text;
  for (const SubjectQuantity& parameter : subject.parameters)
    text +=
        fmt::format("  double {};  // {}\n", parameter.field, comment_text(in_words(parameter)));
  return text;
}

std::string threshold(const KernelSubject& subject) {
  if (subject.alpha == 0) return "";
  return comment_lines(
             "", fmt::format("The threshold of |det J^-1|, rounded up: {:.6g}.", subject.alpha)) +
         fmt::format("extern const double {}_alpha;\n\n", subject.name);
}

}  // namespace

std::string c_header(const KernelSubject& subject) {
  const std::string& name = subject.name;
  const auto line = [&](const std::string& text) { return comment_lines("", text); };
  std::string text = file_head(subject) + "//\n";
  text += claim_comment(subject);
  text += fmt::format(
      "#ifndef REGULUS_GENERATED_{0}_H\n"
      "#define REGULUS_GENERATED_{0}_H\n\n"
      "#include \"runtime/embedded/checker.h\"\n\n"
      "#ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n",
      name);
  text += line("A value of each motion parameter, or one bound of each.");
  text += fmt::format("typedef struct {0}_parameters {{\n{1}}} {0}_parameters;\n\n", name,
                      fields(subject));
  text += line("Their ranges, outward: pieces lie between them.");
  text += fmt::format("extern const {0}_parameters {0}_lower, {0}_upper;\n\n", name);
  text += threshold(subject);
  text += line(
      "As regulus_checker_new, with the kernel for the best instruction set of this processor, "
      "after a test that it rounds outward here.");
  text += fmt::format(
      "regulus_checker* {}_checker_new(unsigned max_boxes, char* fault, size_t fault_size);\n\n",
      name);
  text += line(
      "As regulus_check: the piece between two bounds of each motion parameter, or one pose with "
      "lower = upper.");
  text += fmt::format(
      "regulus_check_verdict {0}_check(regulus_checker* checker,\n"
      "    const {0}_parameters* lower, const {0}_parameters* upper,\n"
      "    regulus_check_report* report);\n\n",
      name);
  text += line("The kernel itself, and its instruction set: avx512, avx2 or portable.");
  text += fmt::format(
      "const regulus_kernel* {0}_best_kernel(void);\nconst char* {0}_isa(void);\n\n", name);
  return text + "#ifdef __cplusplus\n}\n#endif\n\n#endif\n";
}

}  // namespace regulus::detail
