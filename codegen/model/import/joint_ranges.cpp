// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/joint_ranges.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "codegen/model/import/exact_pose.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr long kMostTurns = 12;  ///< after which the joints that follow are where they were

std::vector<const ImportedJoint*> followers_of(const ImportedJoint& joint, const Chain& chain) {
  std::vector<const ImportedJoint*> followers;
  for (const ImportedJoint* other : chain.joints)
    if (other->type != JointType::kFixed && other->mimics == joint.name) followers.push_back(other);
  return followers;
}

/// Returns the values of the leader for which multiplier * q + offset is within the limits; nullopt
/// for a follower that stands still.
std::optional<JointLimits> limits_for_leader(const ImportedJoint& follower) {
  const ex& multiplier = follower.rule->multiplier.value;
  if (multiplier.is_zero()) return std::nullopt;
  const auto value = [&](const WrittenNumber& end) {
    return number_of(((end.value - follower.rule->offset.value) / multiplier).expand());
  };
  WrittenNumber lower = value(follower.limits->lower), upper = value(follower.limits->upper);
  if (follower.rule->multiplier.approx() < 0) std::swap(lower, upper);
  return JointLimits{std::move(lower), std::move(upper)};
}

/// Returns the turns of the joint after which every joint that follows it is where it was; nullopt if
/// there are none, or many.
std::optional<long> period_of(const std::vector<const ImportedJoint*>& followers) {
  numeric period = 1;
  for (const ImportedJoint* follower : followers) {
    const ex& multiplier = follower->rule->multiplier.value;
    if (multiplier.is_zero()) continue;
    if (!turns(*follower) || !GiNaC::is_a<numeric>(multiplier)) return std::nullopt;
    period = lcm(period, GiNaC::ex_to<numeric>(multiplier).denom());
    if (period > kMostTurns) return std::nullopt;
  }
  return period.to_long();
}

/// The joint has no limits of its own, nor by those that follow it.
RangeOfJoint assumed(const ImportedJoint& joint, const std::vector<const ImportedJoint*>& followers,
                     std::vector<std::string>& notes) {
  const JointLimits turn{twelfths_of_pi(-12), twelfths_of_pi(12)};
  if (joint.type != JointType::kContinuous) {
    notes.push_back(fmt::format("joint {} has no limits: {} is assumed; correct it in the model",
                                in_quotes(joint.name), turns(joint) ? "one turn" : "-1 to 1"));
    return {turns(joint) ? turn : JointLimits{whole(-1), whole(1)},
            " # assumed: the file has none"};
  }
  const std::optional<long> period = period_of(followers);
  if (period == 1) return {turn, " # turns without end"};
  if (period)
    return {{twelfths_of_pi(-12 * *period), twelfths_of_pi(12 * *period)},
            fmt::format(" # turns without end: those that follow repeat after {} turns", *period)};
  notes.push_back(fmt::format(
      "joint {} turns without end, and a joint that follows it does not repeat: one turn "
      "is assumed, which is a part of its poses; correct it in the model",
      in_quotes(joint.name)));
  return {turn, " # assumed: one turn of a joint that turns without end"};
}

/// Narrows a range to the limits of a joint that follows.
class Narrowing {
 public:
  Narrowing(const ImportedJoint& joint, const std::string& file) : joint_(joint), file_(file) {
    if (joint.limits) range_ = joint.limits;
  }

  void narrow(const ImportedJoint& follower) {
    const std::optional<JointLimits> of = limits_for_leader(follower);
    if (!of) return require_still(follower);
    if (!range_ || of->lower.approx() > range_->lower.approx() ||
        of->upper.approx() < range_->upper.approx())
      narrowed_by_ = in_quotes(follower.name);
    if (!range_) range_ = of;
    if (of->lower.approx() > range_->lower.approx()) range_->lower = of->lower;
    if (of->upper.approx() < range_->upper.approx()) range_->upper = of->upper;
    if (range_->lower.approx() > range_->upper.approx()) refuse(follower);
  }

  [[nodiscard]] const std::optional<JointLimits>& range() const { return range_; }
  [[nodiscard]] std::string remark() const {
    return narrowed_by_.empty() ? "" : " # within the limits of " + narrowed_by_;
  }

 private:
  void require_still(const ImportedJoint& follower) const {
    const double at = follower.rule->offset.approx();
    if (at < follower.limits->lower.approx() || at > follower.limits->upper.approx())
      refuse(follower);
  }

  [[noreturn]] void refuse(const ImportedJoint& follower) const {
    throw InputError::statement(
        file_, follower.line,
        fmt::format("joint {} follows joint {} and is outside its own limits wherever that may be",
                    in_quotes(follower.name), in_quotes(joint_.name)),
        "correct its limits, or the multiplier and the offset");
  }

  const ImportedJoint& joint_;
  const std::string& file_;
  std::optional<JointLimits> range_;
  std::string narrowed_by_;
};

}  // namespace

std::optional<RangeOfJoint> limits_of(const ImportedJoint& joint,
                                      const std::vector<const ImportedJoint*>& followers,
                                      const std::string& file) {
  Narrowing narrowing(joint, file);
  for (const ImportedJoint* follower : followers)
    if (follower->limits) narrowing.narrow(*follower);
  if (!narrowing.range()) return std::nullopt;
  return RangeOfJoint{*narrowing.range(), narrowing.remark()};
}

RangeOfJoint range_of(const ImportedJoint& joint, const Chain& chain, const std::string& file,
                      std::vector<std::string>& notes) {
  const std::vector<const ImportedJoint*> followers = followers_of(joint, chain);
  auto limits = limits_of(joint, followers, file);
  return limits ? std::move(*limits) : assumed(joint, followers, notes);
}

}  // namespace regulus::detail
