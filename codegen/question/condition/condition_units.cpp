// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_units.hpp"

#include <new>
#include <utility>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {
namespace {

using cluster::ByteReader;
using cluster::ByteWriter;
using cluster::MalformedMessage;

void put(ByteWriter& to, const std::vector<double>& numbers) {
  to.put_list(std::span<const double>(numbers));
}

void put(ByteWriter& to, const BoxFinding& finding) {
  to.put(finding.is_outside);
  to.put(finding.is_undefined);
  to.put(finding.bound.upper);
  put(to, finding.bound.impact);
  to.put(finding.attained.has_value());
  if (!finding.attained) return;
  to.put_list(std::span<const Interval>(finding.attained->variables));
  to.put(finding.attained->shown.condition);
  put(to, finding.attained->shown.most);
  put(to, finding.attained->shown.least);
}

template <typename Number>
std::vector<Number> take_numbers(ByteReader& from, std::size_t count) {
  std::vector<Number> numbers = from.take_list<Number>();
  if (numbers.size() != count) throw MalformedMessage();
  return numbers;
}

bool take_flag(ByteReader& from) {
  const auto byte = from.take<unsigned char>();
  if (byte > 1) throw MalformedMessage();
  return byte == 1;
}

ConditionWitness take_witness(ByteReader& from, const ConditionQuestion& question) {
  const auto columns = std::size_t(question.problem.kernel->columns);
  ConditionWitness witness;
  witness.variables = take_numbers<Interval>(from, question.problem.outer.size());
  witness.shown.condition = from.take<double>();
  witness.shown.most = take_numbers<double>(from, columns);
  witness.shown.least = take_numbers<double>(from, columns);
  return witness;
}

void take(ByteReader& from, const ConditionQuestion& question, BoxFinding& finding) {
  finding.is_outside = take_flag(from);
  finding.is_undefined = take_flag(from);
  finding.bound.upper = from.take<double>();
  finding.bound.impact = from.take_list<double>();
  const std::size_t impacts = finding.bound.impact.size();
  if (impacts != 0 && impacts != question.problem.outer.size()) throw MalformedMessage();
  if (take_flag(from)) finding.attained = take_witness(from, question);
}

/// The boxes of a unit.
struct UnitBoxes {
  std::vector<BoxJudge::Box> boxes;
  double attained = 0;
};

UnitBoxes boxes_of(const cluster::Unit& unit, std::size_t variables) {
  if (unit.size() > kLanes || unit.ranges.size() != unit.size() * (variables + 1))
    throw MalformedMessage();
  UnitBoxes result;
  const auto width = static_cast<std::ptrdiff_t>(variables);
  for (auto at = unit.ranges.begin(); at != unit.ranges.end(); at += width + 1)
    result.boxes.emplace_back(at, at + width);
  result.attained = unit.ranges.back().hi;
  return result;
}

/// It may be called in any thread with any rounding.
class ConditionDecider final : public cluster::UnitDecider {
 public:
  explicit ConditionDecider(const ConditionQuestion& question)
      : variables_(question.problem.outer.size()), judge_(question) {}

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override {
    const UnitBoxes given = boxes_of(unit, variables_);
    cluster::Outcome outcome;
    outcome.boxes = unit.size();
    try {
      outcome.events = judged(given);
    } catch (const std::bad_alloc&) {
      outcome.kind = cluster::OutcomeKind::kMemory;
    }
    return write_outcome(outcome);
  }

 private:
  [[nodiscard]] std::string judged(const UnitBoxes& given) {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    std::vector<BoxFinding> findings(given.boxes.size());
    judge_.judge(given.boxes, findings, given.attained);
    ByteWriter bytes;
    for (const BoxFinding& finding : findings) put(bytes, finding);
    return bytes.take();
  }

  const std::size_t variables_;
  BoxJudge judge_;
};

}  // namespace

cluster::Unit unit_of(std::span<const BoxJudge::Box> boxes, double attained) {
  cluster::Unit unit;
  unit.depths.assign(boxes.size(), 0);
  for (const BoxJudge::Box& box : boxes) {
    unit.ranges.insert(unit.ranges.end(), box.begin(), box.end());
    unit.ranges.push_back({0, attained});
  }
  return unit;
}

cluster::MakeDecider condition_deciders(const ConditionQuestion& question) {
  return [question] { return std::make_unique<ConditionDecider>(question); };
}

void read_findings(std::string_view outcome, const ConditionQuestion& question,
                   std::span<BoxFinding> findings) {
  const cluster::Outcome read = cluster::read_outcome(outcome);
  if (read.kind == cluster::OutcomeKind::kMemory) throw std::bad_alloc();
  if (read.kind != cluster::OutcomeKind::kDecided || !read.groups.empty()) throw MalformedMessage();
  ByteReader bytes(read.events);
  for (BoxFinding& finding : findings) take(bytes, question, finding);
  if (!bytes.at_end()) throw MalformedMessage();
}

}  // namespace regulus
