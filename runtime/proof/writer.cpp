// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/writer.hpp"

#include <cstdio>
#include <utility>

#include "runtime/proof/format.hpp"

namespace regulus {
namespace {

const char* word_of(Reason reason) noexcept {
  if (reason == Reason::kSmallDeterminant) return format::kSmallDeterminant;
  if (reason == Reason::kLostRank) return format::kLostRank;
  if (reason == Reason::kNullVector) return format::kNullVector;
  return reason == Reason::kAlwaysSingular ? format::kAlwaysSingular : format::kOppositeSigns;
}

/// Requires  `place` is an end.
std::string word_of(PlaceInRange place) {
  return place == PlaceInRange::kUpperEnd ? format::kUpperEnd : format::kLowerEnd;
}

/// For an enclosure of a number other than 0: the end next to 0 may have been rounded to 0.
bool is_positive(const Interval& x) noexcept { return x.lo >= 0.0 && x.hi > 0.0; }

std::string hexadecimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string text_of(const ExactNumber& number) {
  return format::kExactValue + std::to_string(number.numerator) +
         (number.of_pi != 0 ? "*pi/" : "/") + std::to_string(number.denominator);
}

std::string coordinate(const WitnessPoint& point, std::size_t k) {
  if (!point.places.empty() && point.places[k] != PlaceInRange::kInside)
    return word_of(point.places[k]);
  if (!point.numbers.empty() && point.numbers[k].denominator > 0) return text_of(point.numbers[k]);
  return coordinate_text(point.variables[k]);
}

std::string point_line(const WitnessPoint& point, const char* sign) {
  std::string line = std::string("point ") + sign;
  for (std::size_t k = 0; k < point.variables.size(); ++k) line += ' ' + coordinate(point, k);
  return line + '\n';
}

/// Empty for a point without a null vector.
std::string null_vector_lines(const WitnessPoint& point) {
  if (point.null_vector.empty()) return {};
  std::string lines = format::kChosen;
  for (const std::uint32_t k : point.chosen) lines += ' ' + std::to_string(k);
  lines += std::string("\n") + format::kVector;
  for (const Interval& x : point.null_vector) lines += ' ' + coordinate_text(x);
  return lines + '\n';
}

}  // namespace

std::string head_text(const std::string& verdict, const std::string& claim,
                      const std::string& question) {
  return std::string(format::kMagic) + "\nverdict " + verdict + "\nclaim " + claim + '\n' +
         question + "proof\n";
}

std::string CertifiedQuestion::head(bool singular) const {
  return head_text(singular ? format::kSingularity : format::kNoSingularity,
                   singular ? singularity : no_singularity, text);
}

const char* certificate_word(Rule rule) noexcept {
  switch (rule) {
    case Rule::kOutside:
      return "outside";
    case Rule::kHMatrix:
      return "h-matrix";
    case Rule::kMeanValue:
      return "mean-value";
    case Rule::kSecondOrder:
      return "second-order";
    case Rule::kOrthants:
      return "orthants";
    case Rule::kDeterminant:
      return "determinant";
    case Rule::kElimination:
      return "elimination";
    case Rule::kRohn:
      return "rohn";
    case Rule::kClosedForm:
      return "closed-form";
    case Rule::kFilter:
      return "filter";
    case Rule::kMultiprecision:
      return "multiprecision";
    case Rule::kWitness:
    case Rule::kBlocked:
      break;
  }
  return "none";
}

std::string coordinate_text(const Interval& x) {
  return hexadecimal(x.lo) + (x.hi != x.lo ? ':' + hexadecimal(x.hi) : "");
}

std::string witness_lines(const Result& result) {
  std::string lines = std::string("reason ") + word_of(result.reason) + '\n';
  const bool signs = result.reason == Reason::kOppositeSigns;
  for (const WitnessPoint& point : result.witness->points)
    lines += point_line(point, !signs                           ? "0"
                               : is_positive(point.determinant) ? "+"
                                                                : "-") +
             null_vector_lines(point);
  return lines + (signs ? "path segment\nend\n" : "end\n");
}

CertificateWriter::CertificateWriter(std::string path, CertifiedQuestion question)
    : file_(std::move(path)), question_(std::move(question)), safe_head_(question_.head(false)) {}

/// Splits and leaves are a proof of NO SINGULARITY if nothing else follows.
void CertificateWriter::on_start(const Problem&, const Settings&) noexcept {
  file_.begin(safe_head_);
}

void CertificateWriter::on_split(const OpenBox&, const Split& split) noexcept {
  file_.split(split);
}

void CertificateWriter::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  file_.leaf(box.id, certificate_word(rule));
}

bool CertificateWriter::complete(const Result& result) {
  if (result.verdict == Verdict::kPossibleProblem) return false;
  if (result.verdict == Verdict::kNoSingularity)
    file_.complete();
  else
    file_.complete_with(question_.head(true), witness_lines(result));
  return true;
}

bool CertificateWriter::finish(const Result& result) {
  if (!complete(result)) return false;
  file_.put_in_place();
  return true;
}

}  // namespace regulus
