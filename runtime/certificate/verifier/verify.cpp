// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/verify.hpp"

#include <cfenv>

#include "runtime/certificate/verifier/model_comparison.hpp"
#include "runtime/certificate/verifier/pieces.hpp"
#include "runtime/certificate/verifier/proof.hpp"
#include "runtime/certificate/verifier/single_values.hpp"

namespace regulus::verifier {
namespace {

void check(Lines& lines, Question& question, const Options& options, Verification& result) {
  lines.keep();
  read_question(lines, question);
  if (question.is_piecewise) return check_pieces(lines, options, result);
  static_cast<void>(lines.take_kept());
  result.claim = format::describe_claim(question.claimed_set(), question.singular);
  result.model = question.model;
  result.sha256 = question.sha256;
  result.motion = question.motion;
  question.graph.end_of_file();
  if (!options.model_text.empty()) compare_with_model(question, options, result);
  const Variety variety = enclose_variety(question);
  put_in_single_values(question);
  if (question.singular)
    check_witness(lines, question, variety, options, result);
  else
    check_tree(lines, question, variety, options, result);
}

/// Sets the usual environment, without exceptions that stop the process, for its own lifetime.
class UsualEnvironment {
 public:
  UsualEnvironment() noexcept { std::feholdexcept(&before_), std::fesetenv(FE_DFL_ENV); }
  UsualEnvironment(const UsualEnvironment&) = delete;
  UsualEnvironment& operator=(const UsualEnvironment&) = delete;
  ~UsualEnvironment() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
};

/// Throws unless rounding is to nearest and numbers below 2^-1022 are kept: bounds need both.
void require_usual_arithmetic() {
  volatile double least = 0x1p-1074, normal = 0x1p-1022;
  const bool keeps = least * 1.0 > 0.0, reaches = normal * 0.5 > 0.0;
  if (std::fegetround() != FE_TONEAREST)
    throw std::runtime_error("the processor does not round to nearest");
  if (!keeps || !reaches) throw std::runtime_error("the processor flushes small numbers to zero");
}

std::string at_line(const Lines& lines, const std::string& why) {
  return "line " + std::to_string(lines.number()) + ": " + why;
}

}  // namespace

Verification verify(std::istream& file, const Options& options) {
  const UsualEnvironment environment;
  require_usual_arithmetic();
  Verification result;
  Lines lines(file, options.max_bytes);
  Question question;
  try {
    check(lines, question, options, result);
    result.outcome = Outcome::kVerified;
  } catch (const OtherModel& other) {
    result.outcome = Outcome::kRejected;
    result.reason = other.what();
  } catch (const Rejection& rejection) {
    result.outcome = Outcome::kRejected;
    result.reason = at_line(lines, rejection.what());
  } catch (const Unfinished& unfinished) {
    result.outcome = Outcome::kUnfinished;
    result.reason = at_line(lines, unfinished.what());
  }
  return result;
}

std::string describe(const Verification& v) {
  std::string text;
  const auto line = [&text](const std::string& key, const std::string& value) {
    if (!value.empty()) text += key + std::string(11 - key.size(), ' ') + value + '\n';
  };
  line("model", v.model);
  line("sha256", v.sha256);
  line("motion", v.motion);
  line("claim", v.claim);
  if (v.pieces > 0) line("pieces", std::to_string(v.pieces) + " of a trajectory");
  if (v.leaves > 0)
    line("leaves", std::to_string(v.leaves) + ", in " + std::to_string(v.boxes) + " boxes");
  if (v.numbers > 0)
    line("numbers",
         std::to_string(v.numbers) + " values and expressions of the model file compared");
  for (const std::string& difference : v.differences) line("differs", difference);
  for (const std::string& place : v.uncompared) line("uncompared", place);
  line("note", v.note);
  line("reason", v.reason);
  return text;
}

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kVerified:
      return "VERIFIED";
    case Outcome::kRejected:
      return "REJECTED";
    case Outcome::kUnfinished:
      break;
  }
  return "UNFINISHED";
}

}  // namespace regulus::verifier
