// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/limit/rows.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/jit/part.hpp"
#include "codegen/kernel/jit/part_code.hpp"
#include "codegen/kernel/jit/part_compiler.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "runtime/interval/x8.hpp"
#include "runtime/kernel/buffers.hpp"
#include "tests/bench/kernel/batched.hpp"
#include "tests/bench/kernel/subject.hpp"
#include "tests/bench/limit/instructions.hpp"
#include "tests/bench/limit/peak.hpp"

namespace regulus::detail::bench {
namespace {

constexpr std::size_t kBatches = Sample::kBoxes / std::size_t{REGULUS_LANES};

Section heading() {
  return {"limit",
          "What the processor can do at best",
          "The AVX-512 kernel of K·M against loops that do nothing but 512-bit arithmetic in "
          "registers. The ratio is to the first row.",
          {}};
}

Row counted(std::string name, std::size_t value, std::string unit, std::string explanation) {
  Row row;
  row.name = std::move(name);
  row.value = static_cast<double>(value);
  row.unit = std::move(unit);
  row.explanation = std::move(explanation);
  return row;
}

/// Returns the part of the peak: the least time for so many operations, divided by the time taken.
Row fraction(std::string name, std::size_t operations, const Spread& peak_by_time,
             const std::string& explanation) {
  const double percent = 100.0 * static_cast<double>(operations);
  Row row = counted(std::move(name), 0, "%", "");
  row.value = percent * peak_by_time.median;
  row.explanation = fmt::format("{} ({:.0f}–{:.0f})", explanation, percent * peak_by_time.low,
                                percent * peak_by_time.high);
  return row;
}

/// Returns the ratio to the rest of the reference, without this part of it.
Spread without(const Spread& ratio, const Spread& part) {
  const double left = 1 - part.median;
  return {ratio.median / left, ratio.low / left, ratio.high / left};
}

/// Computes as many sines and cosines of eight intervals as a batch needs.
class SinesAndCosines {
 public:
  SinesAndCosines(const Module& module, const Sample& sample)
      : count_(sines_and_cosines(left_product_of(module))), angles_(1), values_(2) {
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane)
      angles_.set(0, lane, sample.boxes[(lane + 1) * sample.variables - 1]);
  }

  void pass() noexcept {
    for (std::size_t i = 0; i < count_; ++i) regulus_x8_sincos(angles_.data(), values_.data());
  }

 private:
  std::size_t count_;
  IntervalRows angles_, values_;
};

/// The contenders in the order of the timings.
enum : std::size_t { kBatch, kBound, kFused, kSines };

std::vector<Timing> time_all(BatchedProduct& product, SinesAndCosines& sines) {
  const Contender contenders[] = {
      {"K·M, eight boxes", static_cast<double>(kBatches), [&] { product.pass(); }},
      {"embedded rounding", kPeakOperations, peak_bounds},
      {"fused", kPeakOperations, peak_fused},
      {"sines and cosines", 1, [&] { sines.pass(); }},
  };
  return compare(contenders);
}

void add_times(const std::vector<Timing>& timings, std::vector<Row>& rows) {
  rows.push_back(timed_row("K·M, a batch of eight boxes", timings[kBatch], 1e9, "ns",
                           "sines and cosines included"));
  rows.push_back(timed_row("of these, sines and cosines", timings[kSines], 1e9, "ns",
                           "regulus_x8_sincos for the three angles"));
  Row bound = timed_row("a bound at best", timings[kBound], 1e9, "ns",
                        "vaddpd and vmulpd on zmm registers, {ru-sae} and {rd-sae} in turn, 16 "
                        "independent chains");
  Row fused = timed_row("a fused multiply-add at best", timings[kFused], 1e9, "ns",
                        "vfmadd on zmm registers, {rd-sae}, 16 independent chains");
  for (Row* row : {&bound, &fused}) {
    row->ratio.reset();  // the fractions below tell more than this ratio
    rows.push_back(std::move(*row));
  }
}

void add_counts(const VectorInstructions& counts, std::vector<Row>& rows) {
  rows.push_back(counted("bound operations of the code", counts.arithmetic, "a batch",
                         "vadd vsub vmul vfmadd vmin vmax on zmm registers, by objdump; without "
                         "those of sines and cosines"));
  rows.push_back(counted("selections of the code", counts.selection, "a batch",
                         "blends, comparisons and logic on zmm registers: they take the same two "
                         "ports and give no bound"));
  rows.push_back(counted("moves of the code", counts.moves, "a batch",
                         "loads, stores, copies and broadcasts of zmm registers"));
  rows.push_back(counted("size of the code", counts.bytes, "bytes",
                         "run once from end to end: more than a cache of decoded instructions "
                         "holds, so that fetching it is a limit, too"));
}

void add_fractions(const VectorInstructions& counts, const std::vector<Timing>& timings,
                   std::vector<Row>& rows) {
  const Spread& peak = timings[kBound].ratio;
  const Spread peak_of_rest = without(peak, timings[kSines].ratio);
  rows.push_back(fraction("fraction of the peak, bounds", counts.arithmetic, peak,
                          "operations on bounds of the code, at best, by the time of a batch"));
  rows.back().target = value_at_least(40);
  rows.push_back(fraction("the same without the time of sines and cosines", counts.arithmetic,
                          peak_of_rest, "whose operations are not counted"));
  rows.push_back(fraction("and with selections: how full the ports are",
                          counts.arithmetic + counts.selection, peak_of_rest,
                          "what no order of instructions could make faster is 100 %"));
}

/// Returns the listing of the machine code that `check` would run for K·M; nullopt without objdump.
std::optional<std::string> listing_of(const machine::PackKernel& program) {
  const auto product = static_cast<std::size_t>(KernelFunction::kLeftProduct);
  const machine::PackFunction& function = program.functions[product];
  std::vector<std::string> bytes;
  for (std::size_t part = 0; part < function.part_ends.size(); ++part)
    bytes.push_back(part_bytes(function, part));
  const std::vector<std::string_view> parts(bytes.begin(), bytes.end());
  std::string listing;
  for (const std::string& code : PartCompiler().compile(parts, Isa::kAvx512).codes) {
    const std::optional<std::string> part = disassemble(code);
    if (!part) return std::nullopt;
    listing += *part;
  }
  return listing;
}

}  // namespace

Section limit_rows() {
  Section section = heading();
  std::vector<Row>& rows = section.rows;
  if (!supported(Isa::kAvx512)) {
    rows = {skipped_row("fraction of the peak", "this processor has no AVX-512", "")};
    return section;
  }
  const Module module = kernel_subject();
  const Sample sample = make_sample(module);
  CompileOptions options;
  options.isa = Isa::kAvx512;
  options.use_cache = false;
  const CompiledKernel compiled = compile_kernel(select(module), options);
  BatchedProduct product(*compiled.kernel(), sample);
  SinesAndCosines sines(module, sample);
  const std::vector<Timing> timings = time_all(product, sines);
  add_times(timings, rows);
  rows.push_back(counted(
      "bound operations of the program", bound_operations(left_product_of(module)), "a batch",
      "2 for a sum, 2 for a product with a double, 4 and a minimum and a maximum "
      "for a product of intervals"));

  if (const std::optional<std::string> listing = listing_of(select(module))) {
    const VectorInstructions counts = count_instructions(*listing, ".data");
    add_counts(counts, rows);
    add_fractions(counts, timings, rows);
  } else {
    rows.push_back(skipped_row("fraction of the peak", "objdump was not found", ""));
  }
  return section;
}

}  // namespace regulus::detail::bench
