// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/headers.hpp"
#include "codegen/kernel/cpp/literal.hpp"
#include "regulus/floating_point_flags.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kEveryProcessor = "portable";

std::string enumerator(Isa isa) {
  switch (isa) {
    case Isa::kAvx512:
      return "kAvx512";
    case Isa::kAvx2:
      return "kAvx2";
    case Isa::kPortable:
      break;
  }
  return "kPortable";
}

/// Writes the part for each instruction set; if only one family of processors has the set, inside a
/// condition.
template <class Part>
std::string for_each_isa(const KernelSubject& subject, Part part) {
  std::string special;
  std::string everywhere;
  for (const Isa isa : subject.isas)
    (name(isa) == kEveryProcessor ? everywhere : special) += part(isa);
  if (special.empty()) return everywhere;
  return "#if defined(__x86_64__)\n" + special + "#endif\n" + everywhere;
}

std::string declarations(const KernelSubject& subject) {
  return for_each_isa(subject, [&](Isa isa) {
    return fmt::format(
        "extern const regulus_kernel {0}_kernel_{1};\n"
        "unsigned {0}_self_test_{1}(const double*, const double*, double*, const void*);\n",
        subject.name, name(isa));
  });
}

std::string table(const KernelSubject& subject) {
  return for_each_isa(subject, [&](Isa isa) {
    return fmt::format("    {{regulus::Isa::{2}, &{0}_kernel_{1}, {0}_self_test_{1}}},\n",
                       subject.name, name(isa), enumerator(isa));
  });
}

std::string all_bounds(const KernelSubject& subject, double Interval::*bound) {
  return bound_list(subject.parameters, bound) + bound_list(subject.uncertain, bound);
}

/// "bounds->x, bounds->y".
std::string members(const KernelSubject& subject, const std::string& of) {
  std::string text;
  for (const SubjectQuantity& parameter : subject.parameters)
    text += (text.empty() ? "" : ", ") + of + "->" + parameter.field;
  return text;
}

constexpr const char* kDispatch = R"(#include "{0}.h"

#include <cstdio>
#include <optional>
#include <string>

#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/self_test.hpp"

extern "C" {{
{1}}}

namespace {{

/// A kernel as it was compiled for one instruction set, and what the same compilation made of
/// operations whose results are known.
struct Build {{
  regulus::Isa isa;
  const regulus_kernel* kernel;
  regulus_function self_test;
}};

// Fastest first; every processor has the last.
const Build kBuilds[] = {{
{2}}};

const Build& best_build() noexcept {{
  const Build* build = kBuilds;
  while (build != kBuilds + sizeof kBuilds / sizeof *kBuilds - 1 && !regulus::supported(build->isa))
    ++build;
  return *build;
}}

// Of every variable of the kernel, outward: motion parameters, then uncertain quantities.
const double kLowerBounds[] = {{
{3}}};
const double kUpperBounds[] = {{
{4}}};

}}  // namespace

extern "C" {{

const {0}_parameters {0}_lower = {{
{5}}};
const {0}_parameters {0}_upper = {{
{6}}};
{7}
const regulus_kernel* {0}_best_kernel(void) {{ return best_build().kernel; }}

const char* {0}_isa(void) {{ return regulus::name(best_build().isa).data(); }}

regulus_checker* {0}_checker_new(unsigned max_boxes, char* fault, size_t fault_size) {{
  const Build& build = best_build();
  if (const auto failure = regulus::check_self_test(build.self_test, build.isa)) {{
    if (fault != nullptr)
      std::snprintf(fault, fault_size, "the rounding self-test failed: %s", failure->c_str());
    return nullptr;
  }}
  return regulus_checker_new(build.kernel, kLowerBounds, kUpperBounds, {8}, max_boxes, fault,
                             fault_size);
}}

regulus_check_verdict {0}_check(regulus_checker* checker,
    const {0}_parameters* lower, const {0}_parameters* upper,
    regulus_check_report* report) {{
  const double from[] = {{{9}}};
  const double to[] = {{{10}}};
  return regulus_check(checker, from, to, report);
}}

}}  // extern "C"
)";

std::string flags_of(Isa isa) {
  std::string text;
  for (const char* flag : kFloatingPointFlags) text += std::string(" ") + flag;
  for (const char* flag : compile_flags(isa)) text += std::string(" ") + flag;
  return text;
}

}  // namespace

std::string dispatch_source(const KernelSubject& subject) {
  const std::string alpha = subject.alpha > 0 ? fmt::format("const double {}_alpha = {};\n",
                                                            subject.name, literal(subject.alpha))
                                              : "";
  return file_head(subject) +
         fmt::format(kDispatch, subject.name, declarations(subject), table(subject),
                     all_bounds(subject, &Interval::lo), all_bounds(subject, &Interval::hi),
                     bound_list(subject.parameters, &Interval::lo),
                     bound_list(subject.parameters, &Interval::hi), alpha, literal(subject.alpha),
                     members(subject, "lower"), members(subject, "upper"));
}

std::string isa_source(const KernelSubject& subject, Isa isa) {
  return file_head(subject) + labelled_comment("Flags", "-std=c++20 -O2" + flags_of(isa)) +
         fmt::format(
             "#define regulus_self_test {0}_self_test_{1}\n"
             "#include \"runtime/kernel/self_test_program.hpp\"\n"
             "#define {0}_kernel {0}_kernel_{1}\n"
             "#include \"{0}_kernel.inc\"\n",
             subject.name, name(isa));
}

}  // namespace regulus::detail
