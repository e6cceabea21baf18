// SPDX-License-Identifier: GPL-3.0-or-later
// Makes kernels of a given size with random operations, in the form of emitted kernels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

namespace regulus::detail::test {

inline constexpr int kRandomVariables = 6;
inline constexpr int kRandomPoints = 36;
inline constexpr int kRandomOutputs = 36;
inline constexpr const char* kRandomKernelSymbol = "random_kernel";

class RandomKernelText {
 public:
  RandomKernelText(int operations, std::uint64_t seed) : random_(seed) {
    constexpr int kOperationsPerPart = 200;
    for (int left = operations; left > 0; left -= kOperationsPerPart)
      write_part(std::min(left, kOperationsPerPart));
    write_kernel();
  }

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  /// Returns an interval that is already known: a variable, or an earlier value of the part.
  std::string value(int values) {
    const int pick = number(kRandomVariables + values);
    return pick < kRandomVariables ? "v_" + std::to_string(pick)
                                   : "t_" + std::to_string(pick - kRandomVariables);
  }
  std::string entry() { return "point(points, " + std::to_string(number(kRandomPoints)) + ")"; }

  std::string operation(int values) {
    const std::string x = value(values), y = value(values);
    if (number(6) == 0) return rarer_operation(x, y);
    switch (number(12)) {
      case 0:
        return x + " + " + y;
      case 1:
        return x + " - " + y;
      case 2:
        return "checked(" + x + " * " + y + ", undefined)";
      case 3:
        return entry() + " * " + x;
      case 4:
        return entry() + " + " + entry();
      case 5:
        return x + " - " + entry();
      case 6:
        return "checked(mul_add(" + entry() + ", " + x + ", " + y + "), undefined)";
      case 7:
        return "-" + x;
      case 8:
        return "checked(sqr(P(0.125) * " + x + "), undefined)";
      case 9:
        return "constant(0x1.5555555555555p-2, 0x1.5555555555556p-2) * " + x;
      case 10:
        if (number(5) != 0) return x + " - " + y;
        return "div(" + x + ", " + y + ", undefined)";
      default:
        return number(8) == 0 ? "sin(" + x + ")" : "P(-3.5) * " + x;
    }
  }

  /// Returns a function, two adjacent operators, or a sign.
  std::string rarer_operation(const std::string& x, const std::string& y) {
    switch (number(14)) {
      case 0:
        return "checked(pow(" + x + " * P(0x1p-3), " + std::to_string(2 + number(6)) +
               "), undefined)";
      case 1:
        return "sqrt(abs(" + x + "), undefined)";
      case 2:
        return "atan2(" + x + ", " + y + ", undefined)";
      case 3:
        return "atan(" + x + ") - asin(P(0.03125) * sin(" + y + "), undefined)";
      case 4:
        return "checked(" + x + " - " + y + " * P(0.5) - " + entry() + " * " + entry() +
               ", undefined)";
      case 5:
        return "checked(-(" + x + " + " + y + ") * -" + entry() + ", undefined)";
      case 6:
        return "checked(" + x + " - (" + y + " - " + entry() + "), undefined)";
      case 7:
        return "checked(mul_add(" + x + ", " + y + ", thin(-" + entry() + ")), undefined)";
      case 8:
        return "checked(mul_add(" + x + ", " + entry() + ", -" + y + "), undefined)";
      case 9:
        return "mul_add(" + entry() + ", P(-3.0), constant(-0.0, 0x1p-1074))";
      case 10:
        return "cos(" + x + ") - P(2.0)";
      case 11:
        return "checked(exact_mul_add(P(78.0), " + entry() + ", -" + entry() + ") * " + x +
               ", undefined)";
      case 12:
        return "point_of(thin(exact_sub(" + entry() + ", exact_mul(P(-0.5), " + entry() +
               ")))) + exact_add(" + entry() + ", P(1.0))";
      default:
        return "exp(sin(" + x + "), undefined)";
    }
  }

  void write_part(int operations) {
    text_ +=
        "__attribute__((noinline)) unsigned part_" + std::to_string(parts_++) +
        "(const double* boxes, const double* points, double* out) {\n  unsigned undefined = 0;\n";
    for (int v = 0; v < kRandomVariables; ++v)
      text_ += "  const I v_" + std::to_string(v) + " = load(boxes, " + std::to_string(v) + ");\n";
    for (int t = 0; t < operations; ++t) {
      text_ += "  const I t_" + std::to_string(t) + " = " + operation(t) + ";\n";
      if (t % 5 == 4 || t + 1 == operations)
        text_ += "  store(out, " + std::to_string(outputs_++ % kRandomOutputs) + ", t_" +
                 std::to_string(t) + ");\n";
    }
    text_ += "  return undefined;\n}\n";
  }

  void write_kernel() {
    std::string calls;
    for (int p = 0; p < parts_; ++p)
      calls += "  undefined |= part_" + std::to_string(p) + "(boxes, points, out);\n";
    text_ =
        std::string(kPrologue) + text_ +
        "unsigned matrix(const double* boxes, const double* points, double* out, const void*) {\n"
        "  unsigned undefined = 0;\n" +
        calls +
        "  return undefined;\n}\n}  // namespace\nextern \"C\" {\nextern const regulus_kernel " +
        kRandomKernelSymbol + ";\nconst regulus_kernel " + kRandomKernelSymbol +
        " = {REGULUS_KERNEL_ABI, kRounding, 6, 6, 6, 6, 0, 0, matrix, nullptr, nullptr,\n"
        "    nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, "
        "\"random\"};\n}\n";
  }

  int number(int below) { return static_cast<int>(random_() % static_cast<std::uint64_t>(below)); }

  static constexpr const char* kPrologue = R"(
#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/pack.hpp"
namespace {
using namespace regulus::pack;
)";

  std::mt19937_64 random_;
  std::string text_;
  int parts_ = 0;
  int outputs_ = 0;
};

}  // namespace regulus::detail::test
