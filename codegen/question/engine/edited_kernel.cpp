// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/edited_kernel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/print.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/question/engine/kernel_source.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/kernel/kernel_functions.hpp"
#include "runtime/machine/machine_kernel.hpp"

namespace regulus::detail {
namespace {

constexpr std::uint64_t kLargestText = std::uint64_t{64} << 20;
constexpr const char* kWriteAgain =
    "write it again by regulus explain MODEL MOTION --stage text, with the options of this run, "
    "and "
    "change the bodies of functions alone";

InputError unfit(const std::string& path, const std::string& why) {
  return InputError::statement(path, 0, why, kWriteAgain);
}

/// Returns the line of the compiler's first error in the text, and its words.
std::pair<int, std::string> first_error(std::string_view diagnostics) {
  constexpr std::string_view kFile = "kernel.cpp:", kError = "error: ";
  const std::size_t error = diagnostics.find(kError);
  if (error == std::string_view::npos) return {0, std::string(diagnostics)};
  const std::size_t begin = diagnostics.rfind('\n', error) + 1;  // npos + 1 is 0
  std::string_view line = diagnostics.substr(begin, diagnostics.find('\n', error) - begin);
  int number = 0;
  if (line.starts_with(kFile))
    std::from_chars(line.data() + kFile.size(), line.data() + line.size(), number);
  return {number, std::string(line.substr(error - begin + kError.size()))};
}

CompiledKernel compile_or_blame(const std::string& path, const std::string& source,
                                const CompileOptions& options) try {
  EmittedKernel text;
  text.source = source;
  text.symbol = EmitOptions{}.prefix + "_kernel";
  return compile(text, options);
} catch (const NoCompiler&) {
  throw;
} catch (const CompileError& error) {
  if (error.diagnostics().empty()) throw unfit(path, error.what());
  const auto [line, words] = first_error(error.diagnostics());
  throw InputError::statement(path, line, "the text does not compile: " + words, "mend it");
}

bool is_equal(const regulus_derivatives& a, const regulus_derivatives& b) {
  const auto same = [](const regulus_derivative& x, const regulus_derivative& y) {
    return x.row == y.row && x.column == y.column && x.first == y.first && x.second == y.second;
  };
  return a.count == b.count && std::equal(a.list, a.list + a.count, b.list, same);
}

template <class Number>
bool is_equal(const Number* a, const Number* b, std::size_t count) {
  if (a == nullptr || b == nullptr) return a == b;
  return std::equal(a, a + count, b);
}

using Lists = regulus_derivatives regulus_expansion::*;
constexpr std::array<Lists, 4> kLists = {&regulus_expansion::first, &regulus_expansion::second,
                                         &regulus_expansion::row_first,
                                         &regulus_expansion::row_second};

/// Returns true unless a list of one that the other lacks, or that has other places.
bool has_lists_of(const regulus_kernel& edited, const regulus_kernel& own) {
  if (own.expansion == nullptr || edited.expansion == nullptr)
    return own.expansion == edited.expansion;
  const regulus_expansion &a = *edited.expansion, &b = *own.expansion;
  return is_equal(a.row_of_variable, b.row_of_variable, own.variables) &&
         is_equal(a.ball_of_variable, b.ball_of_variable, own.variables) &&
         is_equal(a.nominal, b.nominal, 2 * std::size_t{own.variables}) &&
         (a.product != nullptr) == (b.product != nullptr) &&
         std::ranges::all_of(kLists, [&](Lists list) {
           return is_equal(a.*list, b.*list) &&
                  ((a.*list).function != nullptr) == ((b.*list).function != nullptr);
         });
}

using Size = unsigned regulus_kernel::*;
constexpr std::array<std::pair<const char*, Size>, 6> kSizes = {
    {{"variables", &regulus_kernel::variables},
     {"motion parameters", &regulus_kernel::motion_variables},
     {"rows", &regulus_kernel::rows},
     {"columns", &regulus_kernel::columns},
     {"constraints", &regulus_kernel::constraints},
     {"pose parameters", &regulus_kernel::pose_parameters}}};

void require_shape(const std::string& path, const regulus_kernel& edited,
                   const regulus_kernel& own) {
  for (const auto& [what, size] : kSizes)
    if (edited.*size != own.*size)
      throw unfit(path, fmt::format("the text has {} {}, the question has {}", edited.*size, what,
                                    own.*size));
  for (const KernelFunctionRow& row : kKernelFunctions)
    if (row.field != nullptr && (edited.*row.field == nullptr) != (own.*row.field == nullptr))
      throw unfit(path, fmt::format("the text has {} function {}, the search needs {}",
                                    edited.*row.field == nullptr ? "no" : "a", row.name,
                                    own.*row.field == nullptr ? "none" : "one"));
  if (!has_lists_of(edited, own))
    throw unfit(path, "the text lists other derivatives, rows or nominal values");
}

/// One point in each lane: the middle of the ranges, then others that fill them evenly.
BoxBatch points_of(const std::vector<Interval>& ranges) {
  constexpr double kGolden = 0.6180339887498949;
  BoxBatch points(ranges.size());
  for (std::size_t v = 0; v < ranges.size(); ++v)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double turns = double(lane) * kGolden * double(v + 1) + 0.5;
      const double part = turns - std::floor(turns);
      const double x = ranges[v].lo + part * (ranges[v].hi - ranges[v].lo);
      points.set(v, lane, Interval(std::clamp(x, ranges[v].lo, ranges[v].hi)));
    }
  return points;
}

/// K with small whole numbers, which are on a grid.
PointRows small_K(std::size_t entries) {
  PointRows K(entries);
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      K.set(e, lane, double((7 * e + 3 * lane + e * e) % 11) - 5);
  return K;
}

/// Two kernels of one shape at the same points.
struct Comparison {
  CheckedKernel edited, own;
  BoxBatch points;
  PointRows K;

  [[nodiscard]] std::optional<std::string> differ(std::string_view name, regulus_function of_edited,
                                                  regulus_function of_own,
                                                  std::size_t outputs) const {
    if (of_own == nullptr || outputs == 0) return std::nullopt;
    OutputBatch a(outputs), b(outputs);
    const LaneMask undefined = edited.call(of_edited, points.data(), K.data(), a.data()) |
                               own.call(of_own, points.data(), K.data(), b.data());
    for (std::size_t e = 0; e < outputs; ++e)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Interval x = a.get(e, lane), y = b.get(e, lane);
        if (!has_lane(undefined, lane) && !(x.lo <= y.hi && y.lo <= x.hi))
          return fmt::format(
              "output {} of {} is in [{:.9g}, {:.9g}] by the text, and in [{:.9g}, "
              "{:.9g}] by the model",
              e, name, x.lo, x.hi, y.lo, y.hi);
      }
    return std::nullopt;
  }
};

}  // namespace

EditedKernel compile_edited(const std::string& path, const Module& module,
                            const CompileOptions& options) {
  const std::string source = read_file(path, kLargestText, Readable::kFile);
  EditedKernel edited{{path, sha256(source)}, compile_or_blame(path, source, options)};
  const regulus_kernel& kernel = *edited.code.kernel();
  const char* const named = kernel.identity == nullptr ? "" : kernel.identity;
  if (named != identity(module))
    throw unfit(path,
                "the text was written for another question: its identity is not the one of "
                "this model, motion, method and options");
  const machine::MachineKernel own(select(module), options.isa);
  require_shape(path, kernel, *own.get());
  return edited;
}

std::optional<std::string> find_difference(const regulus_kernel& edited, const Module& module,
                                           const std::vector<Interval>& ranges, Isa isa) {
  const machine::MachineKernel machine(select(module), isa);
  const regulus_kernel& own = *machine.get();
  const std::size_t variables = own.variables, mn = std::size_t{own.rows} * own.columns;
  const std::size_t nn = std::size_t{own.columns} * own.columns;
  const Comparison both{CheckedKernel(edited), CheckedKernel(own), points_of(ranges), small_K(mn)};
  const std::array<std::size_t, 10> outputs = {mn,
                                               variables * mn,
                                               nn,
                                               variables * nn,
                                               std::size_t{own.rows} * own.rows,
                                               1,
                                               own.constraints,
                                               own.pose_parameters,
                                               1,
                                               variables};
  for (std::size_t f = 0; f < outputs.size(); ++f) {
    const KernelFunctionRow& row = kKernelFunctions[f];
    if (auto found = both.differ(row.name, edited.*row.field, own.*row.field, outputs[f]))
      return found;
  }
  if (own.expansion == nullptr) return std::nullopt;
  const regulus_expansion &a = *edited.expansion, &b = *own.expansion;
  if (auto found = both.differ("the expansion's product", a.product, b.product, nn)) return found;
  for (const Lists list : kLists)
    if (auto found = both.differ("a list of derivatives", (a.*list).function, (b.*list).function,
                                 (b.*list).count))
      return found;
  return std::nullopt;
}

}  // namespace regulus::detail
