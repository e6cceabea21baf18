// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/decider.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

/// The splits between two checks that the uncertainty still lets the box be certified.
constexpr std::uint32_t kStallCheck = 12;

/// The splits between two boxes on which every test is tried. A test that stopped being useful
/// elsewhere may be the only one that can certify a box, of any size.
constexpr std::uint32_t kEveryTest = 4;
static_assert(kStallCheck % kEveryTest == 0);

/// After so many splits, an undecided box justifies the cost of its determinant in closed form.
constexpr std::uint32_t kClosedFormDepth = 11;

/// After so many splits, forms for products of uncertain quantities save more boxes than they cost,
/// in boxes that are not too far beyond the threshold of costly tests.
constexpr std::uint32_t kProductsDepth = 15;
constexpr double kReachOfProducts = 0.15;
constexpr unsigned kFewHalvings = 32;

bool is_point(std::span<const Interval> box) noexcept {
  return std::all_of(box.begin(), box.end(), [](const Interval& x) { return x.lo == x.hi; });
}

bool cannot_be_halved(std::span<const Interval> box) noexcept {
  return std::none_of(box.begin(), box.end(), [](const Interval& x) { return bisect(x); });
}

}  // namespace

Decider::Decider(const Problem& problem, const Settings& settings, const RowStructure& structure,
                 bool tries_easy_tests)
    : problem_(problem),
      settings_(settings),
      keeps_uncertainty_whole_(problem.kernel->variables > problem.kernel->motion_variables &&
                               settings.uncertainty == Uncertainty::kElements),
      looks_at_midpoints_(!settings.exhaustive && settings.ingredients.midpoints &&
                          problem.kernel->rows == problem.kernel->columns),
      scaled_(problem.alpha.hi > 0.0),
      tries_products_(!scaled_ && structure.is_known() && !structure.empty() &&
                      settings.method == Method::kAuto && settings.ingredients.orthants),
      batch_(problem, settings, structure, tries_easy_tests),
      center_(problem, settings, keeps_uncertainty_whole_ ? structure : no_structure_),
      tests_(make_tests(problem, settings, structure)),
      bisector_(problem, settings),
      middle_(problem.kernel->variables) {
  if (tries_easy_tests) easy_tests_ = make_easy_tests(problem, settings, structure);
  if (settings.exhaustive) box_witness_.emplace(problem, settings);
  learn_from_root();
}

void Decider::learn_from_root() noexcept {
  batch_.forget_root();
  batch_.load(0, problem_.outer);
  batch_.seal(1);
  batch_.learn_from_root();
}

void Decider::take_ranges() {
  bisector_ = Bisector(problem_, settings_);
  if (box_witness_) box_witness_.emplace(problem_, settings_);
  learn_from_root();
}

void Decider::load(Decisions& decisions) noexcept {
  out_ = &decisions;
  decisions.forget_attempt();
  batch_.clear();
  for (std::size_t lane = 0; lane < decisions.count(); ++lane)
    batch_.load(lane, decisions.box_of(lane));
  batch_.seal(decisions.count());
}

bool Decider::all_easy(std::size_t test, Decisions& decisions) noexcept {
  load(decisions);
  const LaneMask lanes = batch_.loaded();
  return easy_tests_[test]->certify(batch_, lanes, decisions.budget) == lanes;
}

/// Steps 5–30 of Algorithm 1.
void Decider::decide(Decisions& decisions, bool keep_proofs) {
  load(decisions);
  for (std::size_t lane = 0; lane < decisions.count(); ++lane)
    if (decisions.open(lane).depth % kEveryTest == kEveryTest - 1)
      decisions.budget.anyway |= 1U << lane;

  const LaneMask lanes = leave_outside(batch_.loaded());
  LaneMask undecided = 0;
  if (settings_.exhaustive) {
    const LaneMask leavable = settings_.split_certified ? at_minimum_width(lanes) : lanes;
    undecided = (lanes & ~leavable) | leave_small(leave_by_every_test(leave_certified(leavable)));
    for_each_lane(undecided, [this](std::size_t lane) { split_or_look_inside(lane); });
  } else {
    undecided = leave_by_every_test(leave_certified(leave_easy(lanes)));
    LaneMask hopeless = 0;
    undecided = leave_where_poses_stall(undecided, hopeless);
    for_each_lane(undecided, [this, hopeless](std::size_t lane) {
      split_or_block(lane, has_lane(hopeless, lane));
    });
  }
  decisions.uncertified = undecided;
  decisions.inside = undecided != 0 ? batch_.certain_inside() : 0;
  if (looks_at_midpoints_)
    decisions.midpoint_determinants = approx_midpoint_determinants(batch_, lanes, scaled_);
  if (keep_proofs)
    decisions.keep_proofs(batch_);
  else
    decisions.refer_to(batch_.preconditioner().data(), batch_.vector().data());
  decisions.decided = true;
}

void Decider::leave(std::size_t lane, Rule rule, std::size_t order) noexcept {
  Decision& decision = out_->decision[lane];
  decision = {};
  decision.rule = rule;
  decision.reason = Reason::kAllBoxesCertified;
  decision.order = order;
  if (!settings_.enclose_determinants || rule == Rule::kOutside) return;
  decision.determinant = batch_.determinant(lane, scaled_);
  if (decision.determinant && !scaled_)
    decision.determinant =
        times_power_of_two(*decision.determinant, -problem_.determinant_exponent);
}

void Decider::leave_with_witness(std::size_t lane) {
  leave(lane, Rule::kWitness);
  out_->decision[lane].witness = box_witness_->witness();
  out_->decision[lane].reason = box_witness_->reason();
}

/// Returns the lanes that bisection does not split any more.
LaneMask Decider::at_minimum_width(LaneMask lanes) noexcept {
  LaneMask result = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (!bisector_.splits(out_->box_of(lane))) result |= 1U << lane;
  });
  return result;
}

LaneMask Decider::leave_small(LaneMask lanes) {
  LaneMask rest = lanes;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (!box_witness_->small_throughout(batch_, lane)) return;
    leave_with_witness(lane);
    rest &= ~(1U << lane);
  });
  return rest;
}

LaneMask Decider::leave_outside(LaneMask lanes) noexcept {
  const LaneMask outside = batch_.certain_outside();
  for_each_lane(outside, [this](std::size_t lane) { leave(lane, Rule::kOutside); });
  return lanes & ~outside;
}

LaneMask Decider::leave_easy(LaneMask lanes) noexcept {
  for (std::size_t t = 0; t < easy_tests_.size(); ++t)
    if ((lanes & out_->easy[t]) != 0) lanes &= ~leave_by(*easy_tests_[t], lanes & out_->easy[t]);
  return lanes;
}

/// Returns the lanes that the test certifies.
LaneMask Decider::leave_by(RegularityTest& test, LaneMask lanes) noexcept {
  const LaneMask certified = test.certify(batch_, lanes, out_->budget) & lanes;
  const std::size_t order = vector_order(test.rule());
  for_each_lane(certified, [&](std::size_t lane) { leave(lane, test.rule(), order); });
  return certified;
}

/// Filters are the last tests.
LaneMask Decider::leave_certified(LaneMask lanes) noexcept {
  const std::size_t ours = tests_.size() - settings_.filters.size();
  for (std::size_t t = 0; t < tests_.size() && lanes != 0; ++t) {
    const LaneMask certified = leave_by(*tests_[t], lanes);
    if (t >= ours)
      for_each_lane(certified, [&](std::size_t lane) { out_->decision[lane].filter = t - ours; });
    lanes &= ~certified;
  }
  return leave_by_products(leave_by_closed_form(lanes));
}

/// A test that stopped being useful elsewhere may be the only one for a box that is not split any
/// more, such as a single pose.
LaneMask Decider::leave_by_every_test(LaneMask lanes) noexcept {
  const LaneMask last = at_minimum_width(lanes & ~out_->budget.last);
  if (last == 0) return lanes;
  out_->budget.anyway |= last;
  out_->budget.last |= last;
  return (lanes & ~last) | leave_certified(last);
}

/// Entries of K·A lose dependencies between each other; an expression of det may keep them.
LaneMask Decider::leave_by_closed_form(LaneMask lanes) noexcept {
  if (settings_.closed_form == nullptr || settings_.method != Method::kAuto) return lanes;
  LaneMask rest = lanes;
  for_each_lane(lanes & (out_->budget.anyway | ~batch_.preconditioned()), [&](std::size_t lane) {
    if (out_->open(lane).depth < kClosedFormDepth || !has_lane(batch_.certain_posed(), lane))
      return;
    const std::optional<Interval> determinant = settings_.closed_form->enclose(out_->box_of(lane));
    if (!determinant || !batch_.certain_above_threshold(lane, mig(*determinant))) return;
    leave(lane, Rule::kClosedForm);
    rest &= ~(1U << lane);
  });
  return rest;
}

/// For boxes of a long search that the orthants without such forms narrowly leave.
LaneMask Decider::leave_by_products(LaneMask lanes) noexcept {
  if (!tries_products_) return lanes;
  LaneMask rest = lanes;
  for_each_lane(lanes & out_->budget.anyway & ~out_->budget.last, [&](std::size_t lane) {
    if (out_->open(lane).depth < kProductsDepth || !has_lane(batch_.certain_posed(), lane)) return;
    const double beyond = batch_.approx_spectral_radius(lane) - out_->budget.threshold.value();
    if (!(beyond < kReachOfProducts)) return;
    if (batch_.certain_by_orthants(1U << lane, kFewHalvings) == 0) return;
    leave(lane, Rule::kOrthants);
    rest &= ~(1U << lane);
  });
  return rest;
}

std::size_t Decider::vector_order(Rule rule) const noexcept {
  if (rule == Rule::kSecondOrder) return batch_.order();
  return rule == Rule::kHMatrix || rule == Rule::kMeanValue ? problem_.kernel->columns : 0;
}

void Decider::split_or_block(std::size_t lane, bool hopeless) noexcept {
  // No box that contains such a point will ever be certified in doubles.
  if (undefined_at_middle(lane)) {
    if (is_point(out_->box_of(lane)) && certified_by_oracle(lane))
      return leave(lane, Rule::kMultiprecision);
    return block(lane, Reason::kUndefined);
  }
  if (hopeless) return block(lane, Reason::kUncertainty);
  const std::optional<std::size_t> variable = bisector_.choose(batch_, lane);
  if (variable) return split(lane, *variable);
  if (certified_by_oracle(lane)) return leave(lane, Rule::kMultiprecision);
  block(lane, reason_at_minimum_width(lane));
}

void Decider::split_or_look_inside(std::size_t lane) {
  const std::optional<std::size_t> variable = bisector_.choose(batch_, lane);
  if (variable) return split(lane, *variable);
  if (certified_by_determinant(lane)) return leave(lane, Rule::kDeterminant);
  // More digits do not help for a wide box: they cost much and decide nothing.
  if (cannot_be_halved(out_->box_of(lane)) && certified_by_oracle(lane))
    return leave(lane, Rule::kMultiprecision);
  const std::uint64_t before = box_witness_->probes();
  const bool found = box_witness_->somewhere_in(out_->box_of(lane));
  out_->probes += box_witness_->probes() - before;
  if (found) return leave_with_witness(lane);
  block(lane, reason_at_minimum_width(lane));
}

void Decider::split(std::size_t lane, std::size_t variable) noexcept {
  Decision& decision = out_->decision[lane];
  decision = {};
  decision.kind = Decision::Kind::kSplit;
  decision.variable = static_cast<std::uint32_t>(variable);
}

void Decider::block(std::size_t lane, Reason reason) noexcept {
  leave(lane, Rule::kBlocked);
  out_->decision[lane].reason = reason;
}

Reason Decider::reason_at_minimum_width(std::size_t lane) noexcept {
  LaneMask defined = batch_.certain_posed() & 1U << lane;
  static_cast<void>(batch_.product({}, defined));
  if (defined == 0) return Reason::kUndefined;
  const auto pose = out_->box_of(lane).first(problem_.kernel->motion_variables);
  return keeps_uncertainty_whole_ && is_point(pose) ? Reason::kUncertainty : Reason::kWidth;
}

/// Loads a lane's box, with its first variables fixed at their midpoints, to a lane of center_.
void Decider::load_center(std::size_t lane, std::size_t thin_variables,
                          std::size_t center) noexcept {
  const std::span<const Interval> box = out_->box_of(lane);
  std::copy(box.begin(), box.end(), middle_.begin());
  for (std::size_t k = 0; k < thin_variables; ++k) middle_[k] = Interval(mid(middle_[k]));
  if (center == 0) center_.clear();
  center_.load(center, middle_);
}

/// Returns true if J⁻¹ or the pose is undefined at the middle, which may lie in the variety.
bool Decider::undefined_at_middle(std::size_t lane) noexcept {
  if (has_lane(batch_.midpoint_outside(), lane)) return false;
  if (!has_lane(batch_.midpoint_defined(), lane)) return true;
  if (has_lane(batch_.certain_posed(), lane)) return false;
  load_center(lane, problem_.kernel->variables, 0);
  center_.seal(1);
  return center_.certain_posed() == 0;
}

/// Uses both enclosures of the determinant together: the tests use K·A or A alone.
bool Decider::certified_by_determinant(std::size_t lane) noexcept {
  if (problem_.kernel->rows != problem_.kernel->columns) return false;
  const std::optional<Interval> determinant = batch_.determinant(lane, false);
  return determinant && batch_.certain_above_threshold(lane, mig(*determinant));
}

/// The last attempt for a box that cannot be split: more digits than doubles have.
bool Decider::certified_by_oracle(std::size_t lane) noexcept {
  const regulus_kernel& kernel = *problem_.kernel;
  if (settings_.oracle == nullptr || kernel.rows != kernel.columns) return false;
  if (!has_lane(batch_.certain_posed(), lane)) return false;
  const std::optional<Interval> determinant = settings_.oracle->enclose(out_->box_of(lane));
  return determinant && batch_.certain_above_threshold(lane, mig(*determinant));
}

/// No box around a pose can do better than the pose, except by the rounding of K: if the usual tests
/// fail at the middle of a box, as a single pose, it takes the longest ones to certify the box. If
/// these fail at the pose, too, for the whole of the uncertainty, the box is hopeless. Both are
/// tested at intervals only.
LaneMask Decider::leave_where_poses_stall(LaneMask lanes, LaneMask& hopeless) noexcept {
  hopeless = 0;
  if (!keeps_uncertainty_whole_ || !settings_.ingredients.stall) return lanes;
  std::size_t asked[kLanes], count = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (out_->open(lane).depth % kEveryTest != kEveryTest - 1) return;
    load_center(lane, problem_.kernel->motion_variables, count);
    asked[count++] = lane;
  });
  if (count == 0) return lanes;
  center_.seal(count);
  const auto at_boxes = [&asked](LaneMask centers) {
    LaneMask boxes = 0;
    for_each_lane(centers, [&](std::size_t center) { boxes |= 1U << asked[center]; });
    return boxes;
  };
  const LaneMask usual = left_at_centers(center_.loaded() & ~center_.certain_outside(), false);
  LaneMask checked = 0;
  for_each_lane(usual, [&](std::size_t center) {
    if (out_->open(asked[center]).depth % kStallCheck == kStallCheck - 1) checked |= 1U << center;
  });
  hopeless = at_boxes(left_at_centers(checked, true));
  const LaneMask stalled = at_boxes(usual) & ~hopeless & ~out_->budget.last;
  if (stalled == 0) return lanes;
  out_->budget.anyway |= stalled;
  out_->budget.last |= stalled;
  return (lanes & ~stalled) | leave_certified(stalled);
}

/// Returns the lanes of center_ that no test certifies.
LaneMask Decider::left_at_centers(LaneMask centers, bool longest) noexcept {
  TestBudget budget;
  budget.anyway = centers;
  budget.last = longest ? centers : 0;
  for (const auto& test : tests_)
    if (centers != 0) centers &= ~test->certify(center_, centers, budget);
  return centers;
}

}  // namespace regulus::detail
