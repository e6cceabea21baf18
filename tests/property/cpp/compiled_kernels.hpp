// SPDX-License-Identifier: GPL-3.0-or-later
// Runs emitted text, compiled by every installed compiler for every instruction set of this
// processor, and the machine on the same list. Arb checks them at points of random boxes, and they
// must agree with each other to the bit.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "codegen/kernel/cpp/emit.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/print.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "tests/support/ball_containment.hpp"
#include "tests/support/compilers.hpp"
#include "tests/support/grid.hpp"
#include "tests/support/random_program.hpp"
#include "tests/support/sample_modules.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

inline constexpr std::size_t kLanes = REGULUS_LANES;
inline constexpr int kOrder = 2;  ///< of the matrix

struct NamedField {
  const char* name;
  regulus_function regulus_kernel::*function;
};
inline constexpr NamedField kFields[] = {{"left_product", &regulus_kernel::left_product},
                                         {"row_scale", &regulus_kernel::row_scale},
                                         {"constraint", &regulus_kernel::constraint},
                                         {"pose", &regulus_kernel::pose}};

/// Makes a kernel of a 2×2 matrix whose functions are random expressions.
inline Module random_module(std::uint64_t seed) {
  RandomSource random(seed);
  Module m;
  m.model = "random " + std::to_string(seed);
  m.rows = m.columns = kOrder;
  m.constraints = 3;
  m.pose_parameters = 2;
  ProgramShape shape;
  shape.points = 4;
  m.variables = numbered_names("x", shape.inputs);
  m.motion_variables = shape.inputs;
  const auto add = [&](const char* name, int outputs, int operations) {
    shape.outputs = outputs;
    shape.operations = operations;
    shape.functions = !random.one_in(3);
    shape.tree_like = random.one_in(2);
    shape.largest_power = random.one_in(3) ? 24 : 4;
    m.functions.push_back(
        {name, "random", random_program<ProgramBuilder>(random, shape), outputs, 1, {}});
    m.functions.back().program.inputs = m.variables;
  };
  // A third of the modules have sums of one row of K, which kernels may compute as points.
  shape.row_length = random.one_in(3) ? kOrder : 0;
  add("left_product", 4, 8);
  add("row_scale", 1, 7);
  add("constraint", 3, 12);
  add("pose", 2, 30);
  add("matrix", 4, 3);
  return m;
}

/// Joins many emitted texts in one translation unit: the headers once, each text in a namespace.
inline std::string in_one_text(const std::vector<EmittedKernel>& kernels) {
  const std::string includes =
      "#include \"runtime/kernel/abi.hpp\"\n#include \"runtime/kernel/pack.hpp\"\n";
  std::string text = includes;
  for (const EmittedKernel& kernel : kernels) {
    std::string part = kernel.source;
    part.erase(part.find(includes), includes.size());
    text += "namespace of_" + kernel.symbol + " {\n" + part + "}\n";
  }
  return text;
}

/// Points of one box, and the values by Arb there.
struct Sample {
  bool certainly_undefined;
  bool defined;
  std::vector<Ball> outputs;
};

struct Case {
  BoxBatch boxes;
  PointRows points;
  std::vector<std::vector<Sample>> samples;  ///< per lane
};

inline Sample sample_at(const Program& program, const std::vector<double>& inputs,
                        const std::vector<double>& k) {
  ArbArithmetic arithmetic(200);
  std::vector<Ball> in;
  for (const double x : inputs) in.emplace_back(x);
  std::vector<Ball> points;
  for (const double x : k) points.emplace_back(x);
  auto outputs =
      evaluate(program, std::span<const Ball>(in), std::span<const Ball>(points), arithmetic);
  return {arithmetic.certainly_undefined(), !arithmetic.undefined(), std::move(outputs)};
}

inline Case random_case(RandomSource& random, const Program& program) {
  Case result{BoxBatch(program.inputs.size()), PointRows(program.points.size()), {}};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const int largest_exponent = random.one_in(4) ? 64 : 3;
    std::vector<Interval> box;
    for (std::size_t v = 0; v < program.inputs.size(); ++v) {
      box.push_back(corner_interval(random, largest_exponent));
      result.boxes.set(v, lane, box.back());
    }
    std::vector<double> k;
    while (k.size() < program.points.size()) {
      const auto row = corner_row(random, kOrder, largest_exponent == 64 ? 128 : 3);
      k.insert(k.end(), row.begin(), row.end());
    }
    for (std::size_t p = 0; p < k.size(); ++p) result.points.set(p, lane, k[p]);
    std::vector<Sample> samples;
    for (int i = 0; i < 2; ++i) {
      std::vector<double> point;
      for (const Interval& x : box) point.push_back(point_of(random, x));
      samples.push_back(sample_at(program, point, k));
    }
    result.samples.push_back(std::move(samples));
  }
  return result;
}

struct Counts {
  long contained = 0;
  long undefined = 0;
  long defined_lanes = 0;
};

/// The answer of one call: the outputs and the lanes that are undefined.
struct Answer {
  OutputBatch out;
  unsigned undefined;
};

inline Answer ask(const regulus_kernel& table, regulus_function function, std::size_t outputs,
                  const Case& test_case) {
  Answer answer{OutputBatch(outputs), 0};
  answer.undefined = CheckedKernel(table).call(function, test_case.boxes.data(),
                                               test_case.points.data(), answer.out.data());
  return answer;
}

/// The two zeros are the same bound.
inline bool same_bits(double x, double y) {
  return std::memcmp(&x, &y, sizeof x) == 0 || (x == 0.0 && y == 0.0);
}

inline bool same_answers(const Answer& x, const Answer& y, std::size_t outputs) {
  if (x.undefined != y.undefined) return false;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if ((x.undefined >> lane & 1U) != 0) continue;
    for (std::size_t e = 0; e < outputs; ++e) {
      const Interval a = x.out.get(e, lane), b = y.out.get(e, lane);
      if (!same_bits(a.lo, b.lo) || !same_bits(a.hi, b.hi)) return false;
    }
  }
  return true;
}

inline void check(const Answer& answer, const Program& program, const Case& test_case,
                  const std::string& who, Counts& counts) {
  const auto& [out, undefined] = answer;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const bool lane_undefined = (undefined >> lane & 1U) != 0;
    if (!lane_undefined) ++counts.defined_lanes;
    for (const Sample& sample : test_case.samples[lane]) {
      if (sample.certainly_undefined) {
        ASSERT_TRUE(lane_undefined) << who << "\n" << to_text(program);
        ++counts.undefined;
      }
      if (lane_undefined || !sample.defined) continue;
      for (std::size_t e = 0; e < sample.outputs.size(); ++e) {
        ASSERT_TRUE(is_bounded(out.get(e, lane))) << who << "\n" << to_text(program);
        ASSERT_TRUE(possibly_contains(out.get(e, lane), sample.outputs[e]))
            << who << " lane " << lane << " output " << e << "\n"
            << to_text(program);
        ++counts.contained;
      }
    }
  }
}

struct Candidate {
  std::string who;
  Isa isa;
  std::vector<const regulus_kernel*> kernels;  ///< per module
};

class CompiledKernels : public testing::Test {
 protected:
  void build(std::uint64_t first_seed, std::size_t count, const std::string& optimisation) {
    optimisation_ = optimisation;
    std::vector<EmittedKernel> texts;
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
      modules_.push_back(random_module(seed));
      EmitOptions options;
      options.prefix = "random_" + std::to_string(seed);
      options.operations_per_part = part_length(seed);
      texts.push_back(emit(modules_.back(), options));
    }
    const std::string text = in_one_text(texts);
    for (const std::string& compiler : installed_compilers())
      for (const Isa isa : kAllIsas)
        if (supported(isa)) compile(compiler, isa, text, texts);
    for (const Isa isa : kAllIsas)
      if (supported(isa)) add_machines(isa, first_seed);
  }

  static unsigned part_length(std::uint64_t seed) {
    constexpr unsigned kPartLengths[] = {1, 3, 7, 64};
    return kPartLengths[seed % 4];
  }

  void add_machines(Isa isa, std::uint64_t first_seed) {
    candidates_.push_back({machine_name(isa), isa, {}});
    for (std::size_t i = 0; i < modules_.size(); ++i) {
      machines_.emplace_back(select(modules_[i], part_length(first_seed + i)), isa);
      candidates_.back().kernels.push_back(machines_.back().get());
    }
  }
  static std::string machine_name(Isa isa) { return "machine " + std::string(name(isa)); }

  void compile(const std::string& compiler, Isa isa, const std::string& text,
               const std::vector<EmittedKernel>& texts) {
    libraries_.push_back(
        compile_with_spawned(compiler, text, isa, directory_.path(), optimisation_.c_str()));
    candidates_.push_back({compiler + " " + std::string(name(isa)), isa, {}});
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const regulus_kernel* kernel =
          static_cast<const regulus_kernel*>(libraries_.back().symbol(texts[i].symbol.c_str()));
      ASSERT_NE(kernel, nullptr);
      ASSERT_EQ(kernel->identity, identity(modules_[i]));
      ASSERT_EQ(kernel->rounding, required_rounding(isa));
      candidates_.back().kernels.push_back(kernel);
    }
  }

  /// Compares all candidates on `cases` times eight random boxes for each function of each module.
  void compare(int cases) {
    for (std::size_t m = 0; m < modules_.size(); ++m) {
      RandomSource random(1000 + m);
      for (const NamedField& field : kFields) {
        const Program& program = modules_[m].find(field.name)->program;
        for (int i = 0; i < cases; ++i) {
          const Case test_case = random_case(random, program);
          std::map<Isa, Answer> first_of;
          for (const Candidate& candidate : candidates_) {
            const regulus_kernel& kernel = *candidate.kernels[m];
            const std::size_t outputs = program.outputs.size();
            const Answer answer = ask(kernel, kernel.*field.function, outputs, test_case);
            check(answer, program, test_case, candidate.who, counts_[candidate.who]);
            if (HasFatalFailure()) return;
            const auto first = first_of.try_emplace(candidate.isa, answer).first;
            ASSERT_TRUE(same_answers(first->second, answer, outputs)) << candidate.who << "\n"
                                                                      << to_text(program);
          }
        }
      }
    }
  }

  void expect_enough(long contained, long undefined) {
    ASSERT_GE(counts_.size(), 2U);
    const long defined_lanes = counts_[machine_name(Isa::kPortable)].defined_lanes;
    for (const auto& [who, count] : counts_) {
      EXPECT_GT(count.contained, contained) << who;
      EXPECT_GT(count.undefined, undefined) << who;
      // No candidate may become sound by giving up.
      EXPECT_GT(count.defined_lanes * 10, defined_lanes * 9) << who;
    }
  }

  TemporaryDirectory directory_;
  std::string optimisation_;
  std::map<std::string, Counts> counts_;
  std::vector<Module> modules_;
  std::vector<machine::MachineKernel> machines_;
  std::vector<SpawnedLibrary> libraries_;
  std::vector<Candidate> candidates_;
};

}  // namespace regulus::detail::test
