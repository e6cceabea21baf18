// SPDX-License-Identifier: Apache-2.0
// The operations of packs on slots, for the instruction set that the including file is compiled
// for. REGULUS_MACHINE_TABLE names the function that returns their table.
#pragma once

#include <type_traits>

#include "runtime/kernel/pack.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::detail::machine {

const StepTable& REGULUS_MACHINE_TABLE() noexcept;

namespace {

using pack::I;
using pack::P;
using Op = PackOperation;

static_assert(sizeof(I) <= sizeof(Slot) && alignof(I) <= alignof(Slot));
static_assert(sizeof(P) <= sizeof(Slot) && alignof(P) <= alignof(Slot));
static_assert(std::is_trivially_copyable_v<I> && std::is_trivially_copyable_v<P>);

// The bytes of a slot are read as the type that was written there.
template <class Value>
struct [[gnu::may_alias]] InSlot {
  Value value;
};

template <class Value>
REGULUS_INLINE const Value& get(const Frame& frame, std::uint32_t slot) {
  return reinterpret_cast<const InSlot<Value>*>(frame.slots + slot)->value;
}
template <class Value>
REGULUS_INLINE void put(Slot& slot, const Value& value) {
  reinterpret_cast<InSlot<Value>*>(&slot)->value = value;
}

#define REGULUS_STEP(name, Result, expression)     \
  void name(Frame& f, const Step& s) {             \
    using namespace pack;                          \
    put<Result>(f.slots[s.r], Result(expression)); \
  }
#define REGULUS_STEP_1(name, Result, A, function) \
  REGULUS_STEP(name, Result, function(get<A>(f, s.a)))
#define REGULUS_STEP_2(name, Result, A, B, function) \
  REGULUS_STEP(name, Result, function(get<A>(f, s.a), get<B>(f, s.b)))
#define REGULUS_STEP_3(name, Result, A, B, C, function) \
  REGULUS_STEP(name, Result, function(get<A>(f, s.a), get<B>(f, s.b), get<C>(f, s.c)))
#define REGULUS_PARTIAL_STEP(function) \
  REGULUS_STEP(function##_IU, I, function(get<I>(f, s.a), f.undefined))
#define REGULUS_SIGN_STEPS(name, sign)                           \
  REGULUS_STEP(name##_II, I, get<I>(f, s.a) sign get<I>(f, s.b)) \
  REGULUS_STEP(name##_IP, I, get<I>(f, s.a) sign get<P>(f, s.b)) \
  REGULUS_STEP(name##_PI, I, get<P>(f, s.a) sign get<I>(f, s.b)) \
  REGULUS_STEP(name##_PP, I, get<P>(f, s.a) sign get<P>(f, s.b))

REGULUS_STEP(load, I, pack::load(f.boxes, static_cast<int>(s.a)))
REGULUS_STEP(point, P, pack::point(f.points, static_cast<int>(s.a)))
void store(Frame& f, const Step& s) {
  for (std::uint32_t e = s.a; e <= s.b; ++e)
    pack::store(f.out, static_cast<int>(e), get<I>(f, s.c));
}
REGULUS_STEP(copy, I, get<I>(f, s.b))

REGULUS_STEP_1(thin_P, I, P, thin)
REGULUS_STEP_1(point_of_I, P, I, point_of)
REGULUS_STEP_1(negate_P, P, P, -)
REGULUS_STEP_2(exact_add_PP, P, P, P, exact_add)
REGULUS_STEP_2(exact_sub_PP, P, P, P, exact_sub)
REGULUS_STEP_2(exact_mul_PP, P, P, P, exact_mul)
REGULUS_STEP_3(exact_mul_add_PPP, P, P, P, P, exact_mul_add)
REGULUS_STEP_1(negate_I, I, I, -)
REGULUS_SIGN_STEPS(add, +)
REGULUS_SIGN_STEPS(subtract, -)
REGULUS_SIGN_STEPS(multiply, *)
REGULUS_STEP_3(mul_add_III, I, I, I, I, mul_add)
REGULUS_STEP_3(mul_add_IPI, I, I, P, I, mul_add)
REGULUS_STEP_3(mul_add_PII, I, P, I, I, mul_add)
REGULUS_STEP_3(mul_add_PPI, I, P, P, I, mul_add)
REGULUS_STEP_1(sqr_I, I, I, sqr)
REGULUS_STEP(pow_IN, I, pow(get<I>(f, s.a), s.b))
REGULUS_STEP_1(abs_I, I, I, abs)
REGULUS_STEP_1(sin_I, I, I, sin)
REGULUS_STEP_1(cos_I, I, I, cos)
REGULUS_STEP_1(atan_I, I, I, atan)
/// The cosine goes to slot c.
void sincos_I(Frame& f, const Step& s) {
  I sine, cosine;
  pack::sincos(get<I>(f, s.a), sine, cosine);
  put<I>(f.slots[s.r], sine);
  put<I>(f.slots[s.c], cosine);
}
REGULUS_PARTIAL_STEP(checked)
REGULUS_STEP(div_IIU, I, div(get<I>(f, s.a), get<I>(f, s.b), f.undefined))
REGULUS_PARTIAL_STEP(sqrt)
REGULUS_PARTIAL_STEP(tan)
REGULUS_PARTIAL_STEP(asin)
REGULUS_PARTIAL_STEP(acos)
REGULUS_STEP(atan2_IIU, I, atan2(get<I>(f, s.a), get<I>(f, s.b), f.undefined))
REGULUS_PARTIAL_STEP(exp)
REGULUS_PARTIAL_STEP(log)

#undef REGULUS_STEP
#undef REGULUS_STEP_1
#undef REGULUS_STEP_2
#undef REGULUS_STEP_3
#undef REGULUS_PARTIAL_STEP
#undef REGULUS_SIGN_STEPS

/// In the order of PackOperation. Constants are in the frame before the first step; a fetched value
/// is read from the slot that keeps it.
constexpr StepTable kTable = {
    {load,         point,
     nullptr,      nullptr,
     nullptr,      copy,
     store,        thin_P,
     point_of_I,   negate_P,
     exact_add_PP, exact_sub_PP,
     exact_mul_PP, exact_mul_add_PPP,
     negate_I,     add_II,
     add_IP,       add_PI,
     add_PP,       subtract_II,
     subtract_IP,  subtract_PI,
     subtract_PP,  multiply_II,
     multiply_IP,  multiply_PI,
     multiply_PP,  mul_add_III,
     mul_add_IPI,  mul_add_PII,
     mul_add_PPI,  sqr_I,
     pow_IN,       abs_I,
     sin_I,        cos_I,
     atan_I,       sincos_I,
     nullptr,      checked_IU,
     div_IIU,      sqrt_IU,
     tan_IU,       asin_IU,
     acos_IU,      atan2_IIU,
     exp_IU,       log_IU},
    copy,
    [](Slot& slot, double lo, double hi) { put<I>(slot, pack::constant(lo, hi)); },
    [](Slot& slot, double value) { put<P>(slot, P(value)); }};

}  // namespace

const StepTable& REGULUS_MACHINE_TABLE() noexcept { return kTable; }

}  // namespace regulus::detail::machine
