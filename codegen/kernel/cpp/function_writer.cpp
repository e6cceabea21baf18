// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/function_writer.hpp"

#include <algorithm>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/part_printer.hpp"
#include "codegen/kernel/cpp/value_names.hpp"

namespace regulus::detail {
namespace {

/// Returns an unnamed parameter if nothing reads it, to avoid compiler warnings.
std::string parameter(const std::string& type, const std::string& name, bool used) {
  return used ? type + " __restrict " + name : type;
}

/// Returns the head of a function up to its brace; `last` is the fourth parameter.
std::string head(const std::string& name, const PartPrinter::Usage& usage,
                 const std::string& last) {
  const std::string start = "unsigned " + name + "(";
  const std::string indent = ",\n" + std::string(start.size(), ' ');
  return start + parameter("const double*", "boxes", usage.boxes) + indent +
         parameter("const double*", "points", usage.points) + indent +
         parameter("double*", "out", usage.out) + ", " + last + ") {\n";
}

std::string body(const PartPrinter& printer) {
  return "  unsigned undefined = 0;\n" + printer.declarations() + printer.statements() +
         "  return undefined;\n}\n";
}

std::string part_name(const Function& function, std::size_t part) {
  return function.name + "_" + std::to_string(part + 1);
}

/// Returns the function of the ABI for several parts; `shared` has the values that they exchange.
std::string caller(const Function& function, const SelectedFunction& selected) {
  std::string text = "unsigned " + function.name +
                     "(const double* boxes, const double* points, double* out, const void*) {\n";
  // At least one, since an array must have an element.
  text += "  I shared[" + std::to_string(std::max(selected.code.slots, 1U)) + "];\n";
  text += "  unsigned undefined = 0;\n";
  for (std::size_t part = 0; part < selected.code.part_ends.size(); ++part)
    text += "  undefined |= " + part_name(function, part) + "(boxes, points, out, shared);\n";
  return text + "  return undefined;\n}\n";
}

}  // namespace

std::string write_function(const Module& module, const Function& function,
                           const SelectedFunction& selected, WorkMeter& meter) {
  ValueNames names(function.program);
  std::string text = comment_lines("", function.title.empty() ? function.name : function.title);
  std::uint32_t written = 0;
  for (std::uint32_t part = 0; part < selected.code.part_ends.size(); ++part) {
    meter.spend(selected.code.part_ends[part] - written);
    written = selected.code.part_ends[part];
    PartPrinter printer(module, function, selected, names, part);
    printer.print();
    if (selected.code.part_ends.size() == 1)
      return text + head(function.name, printer.usage(), "const void*") + body(printer);
    text += "__attribute__((noinline))\n" +
            head(part_name(function, part), printer.usage(),
                 parameter("I*", "shared", printer.usage().shared)) +
            body(printer) + "\n";
  }
  return text + caller(function, selected);
}

}  // namespace regulus::detail
