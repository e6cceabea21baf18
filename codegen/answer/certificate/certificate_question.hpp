// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate: model and motion as they were read, before any rewriting.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

/// Returns the constants of a robot that are variables of a search.
[[nodiscard]] std::set<std::string> uncertain_names(const ReportLabels& subject);

/// Returns the constants of a robot that have a tolerance, or lie in a ball.
[[nodiscard]] std::set<std::string> uncertain_names(const Request& request);

/// Returns the set that a claim is about. `uncertain`: as for certified_question.
[[nodiscard]] format::ClaimedSet claimed_set(const Request& request,
                                             const std::set<std::string>& uncertain);

/// Returns the lines `constant`, `uncertain` and `ball` of a robot. `uncertain`: as for certified_question.
[[nodiscard]] std::string geometry_lines(const Model& model,
                                         const std::set<std::string>& uncertain);

/// `uncertain`: the constants of the robot that vary; some of them may have a spread of 0. A pose
/// parameter in it is a variable of the search even if its control error is 0; the others are if
/// their error is not 0.
///
/// Ensures   the same bytes for the same model file and options, in every process.
/// Throws UsageError if the model's names do not fit into a certificate because two things have
/// the same name.
[[nodiscard]] CertifiedQuestion certified_question(const Request& request,
                                                   const std::set<std::string>& uncertain);
/// Returns what a certificate asks about a motion and tolerances, which may have grown: whether it is
/// regular, or the bound of a quantity. `uncertain`: as for certified_question.
using CertifiedAbout =
    std::function<CertifiedQuestion(const Request&, const std::set<std::string>& uncertain)>;

/// A motion, and what a certificate asks about it.
struct CertifiedMotion {
  Request request;
  CertifiedAbout about;

  [[nodiscard]] CertifiedQuestion question(const std::set<std::string>& uncertain) const {
    return about(request, uncertain);
  }
};

/// Returns why the verifier could not read a certificate of this question, whatever its proof: the
/// question is beyond the limits of the format. Empty if it can. `singular`: with that verdict.
[[nodiscard]] std::string certificate_obstacle(const CertifiedQuestion& question,
                                               bool singular = false);
/// The same for a certificate up to its proof.
[[nodiscard]] std::string obstacle_of_head(const std::string& head);
/// Returns, for a report, why the verifier may not finish a proof of this question: its own
/// objection, or numbers that its bounds do not reach. Empty if no reason is known; this claims
/// nothing.
[[nodiscard]] std::string certificate_doubt(const CertifiedQuestion& question, bool singular);
/// Returns the question that a preparation was made for.
[[nodiscard]] CertifiedQuestion certified_question(const PreparedSearch& preparation);

}  // namespace regulus::detail
