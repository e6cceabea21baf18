// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/feasibility/force_certificate.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline feasibility {
namespace {

constexpr std::size_t kPart = 1 << 16;  ///< bytes that are written at one time

const char* word_of(Rule rule) noexcept {
  switch (rule) {
    case Rule::kHMatrix:
      return format::kFeasibleLeaf;
    case Rule::kWitness:
      return format::kInfeasibleLeaf;
    case Rule::kOutside:
      return format::kOutsideLeaf;
    default:
      return format::kUndecidedLeaf;
  }
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw FileError("the certificate " + path + " cannot " + why);
}

}  // namespace

std::string force_split_line(const Split& split) {
  return fmt::format("s {} {} {:a}\n", split.parent, split.variable, split.at);
}

std::string force_leaf_line(BoxId box, Rule rule) {
  return fmt::format("l {} {}\n", box, word_of(rule));
}

std::string force_witness_lines(const ForceWitness& witness) {
  std::string lines = fmt::format("reason {}\npoint 0", format::kShortage);
  for (const Interval& x : witness.variables)
    lines += is_thin(x) ? fmt::format(" {:a}", x.lo) : fmt::format(" {:a}:{:a}", x.lo, x.hi);
  lines += "\ndirection";
  for (const double y : witness.shortage.direction) lines += fmt::format(" {:a}", y);
  return lines + "\nend\n";
}

ForceCertificate::ForceCertificate(const std::string& path, const PreparedForces& prepared,
                                   bool paves)
    : path_(path), paves_(paves) {
  if (path_.empty()) return;
  question_ = certified_load(prepared.request, uncertain_names(prepared.preparation.labels),
                             prepared.set());
  obstacle_ = certificate_obstacle(question_);
  if (obstacle_.empty()) open(paves ? format::kPaving : format::kFeasible);
}

void ForceCertificate::open(const std::string& verdict) try {
  file_.reset();
  file_.emplace(path_);
  file_->write(question_.head(verdict));
} catch (const std::system_error& error) {
  fail(path_, error.what());
}

/// A failure is reported at the end.
void ForceCertificate::put(const std::string& text) {
  lines_ += text;
  if (lines_.size() < kPart || failure_) return;
  file_->write(lines_);
  lines_.clear();
}

void ForceCertificate::on_split(const OpenBox&, const Split& split) noexcept try {
  put(force_split_line(split));
} catch (const std::exception&) {
  failure_ = std::current_exception();
}

void ForceCertificate::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept try {
  ++leaves_;
  put(force_leaf_line(box.id, rule));
} catch (const std::exception&) {
  failure_ = std::current_exception();
}

void ForceCertificate::finish(const FeasibilityResult& result) {
  if (!file_) return;
  const bool is_infeasible = !paves_ && result.verdict == FeasibilityVerdict::kInfeasible;
  const bool claims =
      paves_ ? !result.is_empty : result.verdict != FeasibilityVerdict::kPossibleProblem;
  if (!claims) {
    obstacle_ = paves_ ? "the constraints exclude every pose"
                       : "POSSIBLE PROBLEM claims nothing that could be proved";
    return file_.reset();
  }
  if (is_infeasible) {
    failure_ = nullptr;
    open(format::kInfeasible);
    lines_ = force_witness_lines(*result.witness);
  } else {
    lines_ += fmt::format("end {}\n", leaves_);
  }
  try {
    if (failure_) std::rethrow_exception(failure_);
    file_->write(lines_);
    file_->put_in_place_durably();
  } catch (const std::system_error& error) {
    fail(path_, error.what());
  }
  is_written_ = true;
}

std::string ForceCertificate::line() const {
  if (path_.empty()) return "";
  return is_written_ ? "certificate " + path_ + '\n' : "certificate none: " + obstacle_ + '\n';
}

void ForceCertificate::add_to(nlohmann::ordered_json& report) const {
  if (path_.empty()) return;
  report["certificate"] = nullptr;
  if (is_written_) report["certificate"] = path_;
  if (!is_written_) report["certificate_obstacle"] = obstacle_;
}

}  // namespace regulus::feasibility
