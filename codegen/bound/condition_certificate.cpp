// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/condition_certificate.hpp"

#include <fmt/format.h>

#include <new>
#include <system_error>

#include "codegen/bound/bound_certificate.hpp"
#include "codegen/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::inline bounding {
namespace {

constexpr const char* kSafeEnding = ".safe";
constexpr const char* kAttainedEnding = ".singular";

/// Reports a failure of a writer as a FileError.
template <class Action>
void reporting_failures(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

void write_file(const std::string& path, const std::string& text) try {
  AtomicFile file(path);
  file.write(text);
  file.put_in_place_durably();
} catch (const std::system_error& error) {
  throw FileError("the certificate " + path + " cannot " + error.what());
}

}  // namespace

ConditionCertificate::ConditionCertificate(std::string path, const Request& request,
                                           const Component& component,
                                           const std::set<std::string>& uncertain)
    : path_(std::move(path)), request_(request), component_(component), uncertain_(uncertain) {
  if (path_.empty()) return;
  // Checked before the search, which may take long.
  for (const char* ending : {kSafeEnding, kAttainedEnding})
    reporting_failures([&] { const CertificateWriter probe(path_ + ending, {}); });
}

CertifiedQuestion ConditionCertificate::question(const GiNaC::ex& number,
                                                 const std::set<std::string>& uncertain) const {
  Bordered itself;
  itself.is_reciprocal = false;
  return certified_bound(request_, component_, itself, number, uncertain);
}

CertifiedQuestion ConditionCertificate::question_of_singularity(
    const std::set<std::string>& uncertain) const {
  return certified_bound(request_, component_, Bordered{}, 0, uncertain);
}

bool ConditionCertificate::is_refused(const CertifiedQuestion& question, bool is_singular) {
  obstacle_ = certificate_obstacle(question, is_singular);
  return !obstacle_.empty();
}

void ConditionCertificate::on_split(const OpenBox&, const Split& split) noexcept try {
  events_.push_back({split.parent, split.at, split.variable, Rule::kBlocked});
} catch (const std::bad_alloc&) {
  is_out_of_memory_ = true;
}

void ConditionCertificate::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept try {
  events_.push_back({box.id, 0, 0, rule});
} catch (const std::bad_alloc&) {
  is_out_of_memory_ = true;
}

void ConditionCertificate::prove(const BoundEnd& end) {
  if (path_.empty()) return;
  if (is_out_of_memory_) throw FileError("the certificate " + path_ + ": not enough memory");
  CertifiedQuestion question = this->question(end.exact, uncertain_);
  if (is_refused(question, false)) return;
  reporting_failures([&] {
    CertificateWriter writer(path_ + kSafeEnding, std::move(question));
    writer.on_start({}, {});
    for (const Event& event : events_)
      if (event.rule == Rule::kBlocked)
        writer.on_split({}, {event.box, event.variable, event.at, 0});
      else
        writer.on_leaf({event.box, 0, {}}, event.rule, {});
    Result proved;
    proved.verdict = Verdict::kNoSingularity;
    static_cast<void>(writer.finish(proved));
  });
  safe_ = {path_ + kSafeEnding, "below " + rounded_text(end, RoundTo::kAbove)};
}

void ConditionCertificate::attain(const BoundEnd& end, const std::vector<Interval>& variables) {
  if (path_.empty()) return;
  const CertifiedQuestion question = this->question(end.exact, uncertain_);
  if (is_refused(question, true)) return;
  std::string point = "point 0";
  for (const Interval& x : variables)
    point += is_thin(x) ? fmt::format(" {:a}", x.lo) : fmt::format(" {:a}:{:a}", x.lo, x.hi);
  write_file(path_ + kAttainedEnding,
             fmt::format("{}\nverdict {}\nclaim {}\n{}proof\nreason {}\n{}\nend\n", format::kMagic,
                         format::kSingularity, question.singularity, question.text, format::kRatio,
                         point));
  singular_ = {path_ + kAttainedEnding, "attains " + rounded_text(end, RoundTo::kBelow)};
}

void ConditionCertificate::show_singular(const Result& result,
                                         const std::set<std::string>& uncertain) {
  if (!path_.empty()) write_singular(result, uncertain);
}

void ConditionCertificate::show_singular(const std::vector<Interval>& variables) {
  if (path_.empty()) return;
  const GiNaC::matrix& matrix = request_.model.matrix;
  Result result;
  result.verdict = Verdict::kSingularity;
  result.reason = matrix.rows() == matrix.cols() ? Reason::kSmallDeterminant : Reason::kLostRank;
  result.witness.emplace().points.push_back({variables, {}, {}, {}, {}});
  write_singular(result, uncertain_);
}

void ConditionCertificate::write_singular(const Result& result,
                                          const std::set<std::string>& uncertain) {
  CertifiedQuestion question = question_of_singularity(uncertain);
  if (is_refused(question, true)) return;
  reporting_failures([&] {
    CertificateWriter writer(path_ + kAttainedEnding, std::move(question));
    static_cast<void>(writer.finish(result));
  });
  singular_ = {path_ + kAttainedEnding, "the matrix is singular"};
}

EndProofs ConditionCertificate::proofs() const {
  const auto end = [this](const EndProof& proof, const char* why_none) -> EndProof {
    if (!proof.file.empty()) return proof;
    return {{}, obstacle_.empty() ? why_none : obstacle_};
  };
  const char* no_upper =
      is_ratio_ ? "it is the ratio of the bounds of sigma-max and sigma-min, which have one each"
                : "no bound was proved";
  return {!path_.empty(), end(safe_, no_upper), end(singular_, "no pose shows it"), "upper",
          "attained"};
}

}  // namespace regulus::bounding
