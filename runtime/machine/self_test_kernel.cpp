// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/self_test_kernel.hpp"

#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/self_test.hpp"

namespace regulus::detail::machine {
namespace {

using Op = PackOperation;

constexpr std::size_t kBounds = 42;  // outputs of the first function

/// The list of a function of one part.
class List {
 public:
  ValueId operator()(Op operation, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0) {
    function_.code.push_back({operation, a, b, c});
    return static_cast<ValueId>(function_.code.size() - 1);
  }
  ValueId constant(Op operation, double value) {
    function_.constants.push_back(Interval(value));
    return (*this)(operation, static_cast<std::uint32_t>(function_.constants.size() - 1));
  }

  void store(ValueId value) {
    (*this)(Op::kStore, function_.outputs, function_.outputs, value);
    ++function_.outputs;
  }
  PackFunction take() {
    function_.part_ends = {static_cast<std::uint32_t>(function_.code.size())};
    return std::move(function_);
  }

 private:
  PackFunction function_;
};

/// The operations of self_test_program.hpp, in the same order.
class Bounds {
 public:
  PackFunction list() {
    quotients_and_products();
    sums();
    fused_operations();
    functions();
    constants();
    small_numbers();
    return f.take();
  }

 private:
  void quotients_and_products() {
    f.store(f(Op::kDiv_IIU, one, three));
    f.store(f(Op::kDiv_IIU, minus(wide), minus(three)));
    f.store(f(Op::kDiv_IIU, tenth, minus(three)));
    f.store(f(Op::kSqrt_IU, three));

    f.store(f(Op::kMultiply_II, tenth, three));
    f.store(f(Op::kMultiply_PI, p_tenth, three));
    f.store(f(Op::kMultiply_PP, p_tenth, p_three));
    f.store(f(Op::kMultiply_II, minus(tenth), tenth));
    f.store(f(Op::kMultiply_PI, p_minus(p_tenth), tenth));
    f.store(f(Op::kMultiply_PP, p_minus(p_tenth), p_tenth));
    f.store(f(Op::kMultiply_II, wide, wide));
    f.store(f(Op::kMultiply_PI, p_minus(p_tenth), wide));
  }

  void sums() {
    f.store(f(Op::kAdd_PP, p_one, p_small));
    f.store(f(Op::kAdd_IP, one, p_small));
    f.store(f(Op::kAdd_II, one, f(Op::kThin_P, p_small)));
    f.store(f(Op::kSubtract_PP, p_one, p_small));
    f.store(f(Op::kSubtract_PI, p_small, one));
    f.store(f(Op::kSubtract_II, minus(one), f(Op::kThin_P, p_small)));
  }

  void fused_operations() {
    f.store(f(Op::kMulAdd_PPI, p_tenth, p_three, one));
    f.store(f(Op::kMulAdd_PII, p_tenth, three, one));
    f.store(f(Op::kMulAdd_III, three, tenth, one));
    f.store(f(Op::kMulAdd_PII, p_minus(p_tenth), three, one));
    f.store(f(Op::kMulAdd_PPI, p_minus(p_three), p_tenth, one));
  }

  void functions() {
    f.store(f(Op::kSqr_I, tenth));
    f.store(f(Op::kSqr_I, wide));
    f.store(f(Op::kPow_IN, tenth, 3));
    f.store(f(Op::kPow_IN, minus(tenth), 3));
    f.store(f(Op::kPow_IN, wide, 3));
    f.store(f(Op::kPow_IN, minus(tenth), 4));
    f.store(f(Op::kAbs_I, wide));
    f.store(f(Op::kSin_I, one));
  }

  void constants() {
    f.store(f(Op::kMultiply_PP, exact(0.1), exact(3.0)));
    f.store(f(Op::kAdd_PP, exact(1.0), exact(0x1p-60)));
    f.store(f(Op::kSubtract_PP, exact(1.0), exact(0x1p-60)));
    f.store(f(Op::kMultiply_II, constant(0.1), constant(3.0)));
    f.store(f(Op::kDiv_IIU, constant(1.0), constant(3.0)));
    f.store(f(Op::kSqrt_IU, constant(3.0)));
    f.store(f(Op::kMulAdd_PPI, exact(0.1), exact(3.0), constant(1.0)));
  }

  void small_numbers() {
    f.store(f(Op::kMultiply_II, tiny, tiny));
    f.store(f(Op::kMultiply_II, minus(tiny), tiny));
    f.store(f(Op::kAdd_II, smallest, smallest));
    f.store(f(Op::kMultiply_PI, p_three, smallest));
  }

  ValueId minus(ValueId x) { return f(Op::kNegate_I, x); }
  ValueId p_minus(ValueId x) { return f(Op::kNegate_P, x); }
  ValueId exact(double value) { return f.constant(Op::kExact, value); }
  ValueId constant(double value) { return f.constant(Op::kConstant, value); }

  List f;
  const ValueId one = f(Op::kLoad, 0), three = f(Op::kLoad, 1), tenth = f(Op::kLoad, 2);
  const ValueId wide = f(Op::kLoad, 3), tiny = f(Op::kLoad, 4), smallest = f(Op::kLoad, 5);
  const ValueId p_one = f(Op::kPoint, 0), p_three = f(Op::kPoint, 1);
  const ValueId p_tenth = f(Op::kPoint, 2), p_small = f(Op::kPoint, 3);
};

PackFunction undefined_quotient() {
  List f;
  const ValueId one = f(Op::kLoad, 0), wide = f(Op::kLoad, 3);
  f.store(f(Op::kDiv_IIU, one, wide));
  return f.take();
}

PackFunction undefined_root() {
  List f;
  f.store(f(Op::kSqrt_IU, f(Op::kLoad, 3)));
  return f.take();
}

PackFunction& function(PackKernel& kernel, KernelFunction which) {
  return kernel.functions[static_cast<std::size_t>(which)];
}

/// The self-test's function, whose context is the kernel. The last two outputs are masks: the lanes
/// in which the two last operations are undefined.
unsigned run(const double* boxes, const double* points, double* out, const void* context) {
  const auto& kernel = *static_cast<const regulus_kernel*>(context);
  const unsigned undefined = kernel.matrix(boxes, points, out, kernel.context);
  OutputBatch unused(1);
  double* next = out + 2 * REGULUS_LANES * kBounds;
  for (const regulus_function f : {kernel.row_scale, kernel.constraint}) {
    const auto lanes = static_cast<double>(f(boxes, points, unused.data(), kernel.context));
    for (int i = 0; i < 2 * REGULUS_LANES; ++i) *next++ = lanes;
  }
  return undefined;
}

}  // namespace

PackKernel self_test_kernel() {
  PackKernel kernel;
  kernel.variables = kernel.motion_variables = 6;
  kernel.rows = kernel.columns = 2;  // four entries of K
  function(kernel, KernelFunction::kMatrix) = Bounds().list();
  function(kernel, KernelFunction::kRowScale) = undefined_quotient();
  function(kernel, KernelFunction::kConstraint) = undefined_root();
  kernel.identity = "self-test";
  return kernel;
}

std::optional<std::string> check_self_test(const regulus_kernel& kernel, Isa isa) {
  return regulus::check_self_test(run, isa, &kernel);
}

}  // namespace regulus::detail::machine
