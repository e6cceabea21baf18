// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_poses.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>

#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/planar_platform.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfLegs = 64;
constexpr const char* kUnknowns[] = {"x", "y", "phi"};

class PoseWriter {
 public:
  PoseWriter(Question& question, const std::vector<std::string>& lines, SquaresOfLegs squares)
      : q_(question), lines_(lines), are_constants_(squares == SquaresOfLegs::kConstants) {
    for (std::size_t i = 0; i < kLegsInPlane; ++i) names_[i] = free_name(kUnknowns[i], lines);
    form_planar_equations(q_);
  }

  std::string text() {
    for (const std::string& line : lines_)
      if (line.starts_with("leg ")) read_leg(line);
    std::string text, after;
    for (const std::string& line : lines_) {
      if (line.starts_with("leg ") || line == "proof") continue;
      std::string& part = line.starts_with("solution ") ? after : text;
      part += (line.starts_with("claim ") ? "claim " + claim() : line) + '\n';
      if (line.starts_with("motion ")) part += "alpha 0\n";
    }
    return text + squares_ + unknowns() + equations_ + after + "proof\n";
  }

 private:
  [[nodiscard]] std::string claim() const {
    return format::describe_solutions_claim(
        {q_.solutions->verdict, format::kOfUnknowns, "configuration", "configurations",
         q_.solutions->solutions.size(), q_.claimed_set().uncertain});
  }

  /// A name or a number as it is, otherwise in brackets.
  static std::string operand(const std::string& expression) {
    const auto is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    return std::ranges::all_of(expression, is_part) ? expression : '(' + expression + ')';
  }
  /// `+ E*FACTOR`; nothing for 0.
  static std::string term(const char* sign, const std::string& expression,
                          const std::string& factor) {
    return expression == "0" ? "" : sign + operand(expression) + factor;
  }

  /// The squared distance between the joints less the squared length, which is a name if it varies.
  void read_leg(std::string_view line) {
    take_until(line, " ");
    std::array<std::string, 2> base, platform;
    for (auto* anchor : {&base, &platform})
      for (std::string& coordinate : *anchor) coordinate = take_until(line, " | ");
    std::string square(line);
    const bool is_uncertain = square.find(" +- ") != std::string::npos;
    if (is_uncertain || are_constants_) {
      const std::string name = free_name("square_" + std::to_string(++legs_), lines_);
      squares_ += (is_uncertain ? "uncertain " : "constant ") + name + " = " + square + '\n';
      square = name;
    }
    const std::string c = "*cos(" + names_[2] + ')', s = "*sin(" + names_[2] + ')';
    equations_ += "equation (" + names_[0] + term(" + ", platform[0], c) +
                  term(" - ", platform[1], s) + term(" - ", base[0], "") + ")^2 + (" + names_[1] +
                  term(" + ", platform[0], s) + term(" + ", platform[1], c) +
                  term(" - ", base[1], "") + ")^2 - " + operand(square) + '\n';
  }

  /// x and y are within a whole distance of whole numbers, or of 0 if all is small.
  std::string unknowns() {
    const ClosureLines& closure = *q_.closure;
    const auto middles = evaluate(q_.graph, closure.middle, {}, kBitsOfLegs),
               radii = evaluate(q_.graph, closure.radius, {}, kBitsOfLegs);
    if (!middles || !radii) throw Unfinished("a number of the legs has no certain value");
    std::string text;
    for (std::size_t i = 0; i < 2; ++i) {
      const double middle = mid((*middles)[i].enclosure()), whole = std::round(middle),
                   radius = (*radii)[i].enclosure().hi + std::fabs(middle - whole);
      if (!(std::fabs(whole) < kMost && radius < kMost))
        throw Unfinished("a number of the legs is too large");
      text += "unknown " + names_[i] + " = " + std::to_string(long(whole)) + " +- " +
              std::to_string(long(std::ceil(radius)) + 1) + '\n';
    }
    const long parts = std::lround(kPartsOfAngle * mid((*middles)[2].enclosure()));
    return text + "unknown " + names_[2] + " = " + std::to_string(parts) + '/' +
           std::to_string(kPartsOfAngle) + " +- pi\n";
  }

  static constexpr double kMost = 0x1p50;
  static constexpr long kPartsOfAngle = 1024;  ///< as those of form_planar_equations

  Question& q_;
  const std::vector<std::string>& lines_;
  const bool are_constants_;  ///< the squared lengths that do not vary
  std::array<std::string, kLegsInPlane> names_;
  std::string squares_, equations_;
  std::size_t legs_ = 0;
};

}  // namespace

ListedConfigurations configurations_of(const Question& question,
                                       const std::vector<std::string>& lines,
                                       SquaresOfLegs squares) {
  if (question.closure) return {question, lines};
  if (question.solutions->legs.size() != kLegsInPlane)
    throw Unfinished(
        "there is no theorem about lists of postures yet, nor about poses in space at the places "
        "of a "
        "table");
  Question poses = question;
  const std::string written = PoseWriter(poses, lines, squares).text();
  std::istringstream text(written);
  Lines plain(text);
  ListedConfigurations listed;
  read_question(plain, listed.question);
  listed.lines = lines_of(written);
  return listed;
}

}  // namespace regulus::verifier
