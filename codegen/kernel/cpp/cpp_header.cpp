// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "codegen/kernel/cpp/headers.hpp"
#include "codegen/kernel/cpp/literal.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kChecker =
    R"(/// Decides pieces of the motion; one thread at a time may use it.
class Checker {{
 public:
  /// Memory is in proportion to max_boxes, the most boxes of one check: 1 to 1048576.
  /// Throws std::runtime_error that says what is wrong.
  explicit Checker(unsigned max_boxes = 256) {{
    char fault[120] = "";
    checker_.reset({0}_checker_new(max_boxes, fault, sizeof fault));
    if (!checker_) throw std::runtime_error(fault);
  }}

  /// The piece between two bounds of each motion parameter. Does not allocate or lock.
  [[nodiscard]] regulus_check_report check(const Parameters& lower,
                                           const Parameters& upper) noexcept {{
    regulus_check_report report;
    {0}_check(checker_.get(), &lower, &upper, &report);
    return report;
  }}

  /// One value of each.
  [[nodiscard]] regulus_check_report check(const Parameters& at) noexcept {{ return check(at, at); }}

  /// The instruction set that is used: avx512, avx2 or portable.
  [[nodiscard]] static const char* isa() noexcept {{ return {0}_isa(); }}

 private:
  struct Free {{
    void operator()(regulus_checker* checker) const noexcept {{ regulus_checker_free(checker); }}
  }};
  std::unique_ptr<regulus_checker, Free> checker_;
}};
)";

}  // namespace

std::string cpp_header(const KernelSubject& subject) {
  std::string text = file_head(subject) + "//\n";
  text += claim_comment(subject);
  text += fmt::format(
      "#pragma once\n\n#include <memory>\n#include <stdexcept>\n\n#include \"{0}.h\"\n\n"
      "namespace {1} {{\n\n",
      subject.name, subject.name_space);
  text += fmt::format(
      "/// A value of each motion parameter, or one bound of each.\n"
      "using Parameters = ::{0}_parameters;\n\n"
      "/// Their ranges, outward: pieces lie between them.\n"
      "inline constexpr Parameters kLower = {{\n{1}}};\n"
      "inline constexpr Parameters kUpper = {{\n{2}}};\n\n",
      subject.name, bound_list(subject.parameters, &Interval::lo),
      bound_list(subject.parameters, &Interval::hi));
  if (subject.alpha > 0)
    text += fmt::format(
        "/// The threshold of |det J⁻¹|, rounded up.\ninline constexpr double kAlpha = {};\n\n",
        literal(subject.alpha));
  text += fmt::format(kChecker, subject.name);
  return text + fmt::format("\n}}  // namespace {}\n", subject.name_space);
}

}  // namespace regulus::detail
