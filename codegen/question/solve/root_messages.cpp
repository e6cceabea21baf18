// SPDX-License-Identifier: GPL-3.0-or-later
// Findings about boxes, as messages between ranks.
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

void RootJudge::put(cluster::ByteWriter& to, const RootFinding& finding) {
  to.put(finding.is_empty);
  to.put(finding.is_undefined);
  to.put(finding.is_regular);
  to.put_list(std::span<const Interval>(finding.unknowns));
  to.put_list(std::span<const double>(finding.impact));
  to.put(finding.root.has_value());
  if (!finding.root) return;
  to.put_list(std::span<const double>(finding.root->center));
  to.put_list(std::span<const double>(finding.root->radius));
  to.put_list(std::span<const Interval>(finding.root->values));
  to.put(finding.root->sign);
}

RootFinding RootJudge::take(cluster::ByteReader& from, const RootQuestion& question) {
  const std::size_t n = question.shape.unknowns;
  RootFinding finding;
  finding.is_empty = from.take_flag();
  finding.is_undefined = from.take_flag();
  finding.is_regular = from.take_flag();
  finding.unknowns = from.take_list_of<Interval>(n);
  finding.impact = from.take_list<double>();
  if (!finding.impact.empty() && finding.impact.size() != question.shape.variables + n)
    throw cluster::MalformedMessage();
  if (!from.take_flag()) return finding;
  Root& root = finding.root.emplace();
  root.center = from.take_list_of<double>(n);
  root.radius = from.take_list_of<double>(n);
  root.values = from.take_list_of<Interval>(n);
  root.sign = from.take<int>();
  return finding;
}

}  // namespace regulus::detail
