// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_platform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "runtime/formal/coq_claim.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_solutions.hpp"
#include "runtime/verifier/counted_system.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kMostBitsOfPoses = 1024;
constexpr std::size_t kRotation = 9;  ///< unknowns before those of the position, row by row
/// The numbers of a pose for Coq: the position, then the first and the second column of the rotation.
constexpr auto kNumbersOfPose = std::to_array<std::size_t>({9, 10, 11, 0, 3, 6, 1, 4, 7});
/// The errors of the equations in doubles are smaller than this part of their terms.
constexpr double kErrorOfTerms = 0x1p-45;
/// A root that is not real is looked for within this part of its size.
constexpr double kAboutRoot = 0x1p-24;
/// A line is wider than the places of its pose by this factor.
constexpr double kMoreThanPlaces = 1.25;

double double_of(arb_srcptr x) { return arf_get_d(arb_midref(x), ARF_RND_NEAR); }

std::string coq_float(double x) {
  char text[40];
  std::snprintf(text, sizeof text, x < 0 ? "(%a)" : "%a", x);
  return text;
}

std::string coq_floats(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "[" : "; ") + coq_float(x);
  return text + "]";
}

/// A leg for Coq.
struct WrittenLeg {
  std::string base, anchor, square;
};

class PlatformWriter {
 public:
  PlatformWriter(Lines& proof, Question& q, const std::vector<std::string>& lines)
      : proof_(proof), q_(q), coq_(coq_question(lines, q)) {
    for (const std::string_view line : lines)
      if (line.starts_with("constant "))
        constants_.emplace(line.substr(9, line.find(" = ") - 9), line.substr(line.find(" = ") + 3));
      else if (line.starts_with("leg "))
        read_leg(line);
    q_.alpha = q_.graph.number("0");
    system_ = platform_system(q_, enclose_variety(q_).outer);
  }

  std::string text() {
    for (const SolutionLine& line : q_.solutions->solutions) add_pose(line);
    const bool is_counted = q_.solutions->verdict != format::kIncomplete;
    if (is_counted && !read_roots())
      throw Unfinished(
          "there is no theorem yet that poses in space are all which were searched, or whose legs "
          "meet in points that are written in two ways; regulus-verify proves it");
    const std::string most = is_in_pairs_ ? "sixteen_poses" : "forty_poses",
                      check = is_counted ? most : "some_poses",
                      claim = is_counted ? most + " -> all_poses" : check;
    return coq_heading(q_) + coq_.text + legs() + poses(is_counted) + (is_counted ? roots() : "") +
           method() +
           coq_claim(claim + " the_question the_legs the_solutions",
                     "check_" + check + "_correct the_question the_legs the_method the_solutions" +
                         (is_counted ? " the_roots" : ""));
  }

 private:
  void read_leg(std::string_view line) {
    take_until(line, " ");
    const auto point = [&] {
      std::string text;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view written = take_until(line, " | ");
        const auto constant = constants_.find(written);
        text +=
            (axis == 0 ? "(" : ", ") +
            coq_expression(constant == constants_.end() ? written : constant->second, coq_.names);
      }
      return text + ")";
    };
    WrittenLeg leg{point(), point(), ""};
    const auto varies = coq_.names.find("square " + std::to_string(legs_.size()));
    leg.square =
        line.find(" +- ") == std::string_view::npos ? coq_expression(line, {}) : varies->second;
    legs_.push_back(std::move(leg));
  }

  /// Legs of a pair follow each other. Returns false if they are not in pairs.
  bool put_in_pairs(std::string WrittenLeg::*anchor) {
    std::vector<WrittenLeg> rest = legs_, pairs;
    while (!rest.empty()) {
      const auto is_other = [&](const WrittenLeg& leg) { return leg.*anchor == rest[0].*anchor; };
      const auto other = std::find_if(rest.begin() + 1, rest.end(), is_other);
      if (other == rest.end()) return false;
      pairs.push_back(rest[0]);
      pairs.push_back(*other);
      rest.erase(other);
      rest.erase(rest.begin());
    }
    legs_ = std::move(pairs);
    return true;
  }

  [[nodiscard]] std::string legs() const {
    std::vector<CoqItem> items;
    for (const WrittenLeg& leg : legs_)
      items.push_back({"", "(" + leg.base + ", " + leg.anchor + ", " + leg.square + ")"});
    return "\n(** The legs: each with its anchor on the base, that on the platform in its own "
           "frame, "
           "and its squared\n    length. *)\nDefinition the_legs : list (leg written) :=\n  " +
           coq_list(items, "   ") + ".\n";
  }

  [[nodiscard]] std::string poses(bool are_all) const {
    const std::string more = are_all ? "" : " The theorem does not say that they are all.";
    return "\n(** The poses: an interval for each of x, y and z of the origin of the platform, and "
           "for each number of\n    the directions of its first and its second axis." +
           more + " *)\nDefinition the_solutions : list line :=\n  " + coq_list(poses_, "   ") +
           ".\n";
  }

  [[nodiscard]] std::string method() const {
    return "\n(** The variables of second order. *)\nDefinition the_method : method := Method " +
           std::to_string(q_.variables.size()) + " 0.\n";
  }

  [[nodiscard]] std::string roots() const {
    std::vector<CoqItem> items;
    for (const ComplexRoot& root : roots_) items.push_back({"", hint(root)});
    return "\n(** Where to look for poses whose numbers are not real: the real and the imaginary "
           "part of each\n    number, and how far they may be off. Each stands for its conjugate, "
           "too. *)\nDefinition the_roots : list root :=\n  " +
           coq_list(items, "   ") + "%float.\n";
  }

  [[nodiscard]] ComplexRoot root_near(const ComplexMatrix& place) const {
    const std::vector<double> scale = system_->scale_at(place);
    const ComplexSystem* one = system_->one();
    auto root = one == nullptr ? prove_root(*system_, place, scale, kMostBitsOfPoses)
                               : prove_tube(*one, *system_, place, scale);
    if (!root) throw Unfinished("no simple root was found near a line of the certificate");
    return std::move(*root);
  }

  void add_pose(const SolutionLine& line) {
    ComplexMatrix z(system_->numbers(), 1);
    for (std::size_t i = 0; i < line.values.size(); ++i) acb_set_d(z.at(i), mid(line.values[i]));
    const ComplexRoot root = root_near(system_->place_of(z));
    if (is_real(root) != Certainty::kYes || system_->is_within(root, line) == Certainty::kNo)
      throw Rejection("no pose was found within a line 'solution'");
    const std::vector<double> errors = errors_at(root);
    std::string text;
    for (const std::size_t i : kNumbersOfPose) {
      const double middle = double_of(acb_realref(root.center.at(i))),
                   radius = kMoreThanPlaces * root.radius[i] + errors[i];
      text += (text.empty() ? "[" : "; ") + coq_interval({middle - radius, middle + radius}, 0);
    }
    poses_.push_back({"", text + "]"});
  }

  /// Estimates what doubles leave uncertain of a root: the error of each equation is a part of the
  /// squares of its terms.
  [[nodiscard]] std::vector<double> errors_at(const ComplexRoot& root) const {
    const std::size_t n = system_->unknowns();
    ComplexMatrix values(n, 1), slopes(n, n), inverse(n, n);
    system_->evaluate(root.center, values, slopes, kMostBitsOfPoses);
    if (acb_mat_inv(inverse.get(), slopes.get(), kMostBitsOfPoses) == 0)
      throw Unfinished("the derivatives at a pose are not certainly regular");
    const std::vector<double> scale = system_->scale_at(root.center);
    std::vector<double> errors(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double size = j < n / 2 ? 1 : 4 * scale[kRotation] * scale[kRotation];
        const double part = std::hypot(double_of(acb_realref(inverse.at(i, j))),
                                       double_of(acb_imagref(inverse.at(i, j))));
        errors[i] += kErrorOfTerms * size * part;
      }
    return errors;
  }

  /// Reads the roots that are not real, one of each pair of conjugates. Returns false if the poses are
  /// not counted, or if Coq does not see that the legs are in pairs.
  bool read_roots() {
    if (!proof_.next()) throw Rejection("the file ends before the line 'end' of the proof");
    if (proof_.text() == "end") return false;
    is_in_pairs_ = system_->most() != kMostPoses;
    if (is_in_pairs_ && !put_in_pairs(&WrittenLeg::anchor) && !put_in_pairs(&WrittenLeg::base))
      return false;
    std::size_t real = 0;
    for (auto words = words_of(proof_.text()); words.size() == 1 + 2 * system_->numbers();
         words = words_of(proof_.text())) {
      ComplexMatrix z(system_->numbers(), 1);
      for (std::size_t i = 0; i < system_->numbers(); ++i)
        acb_set_d_d(z.at(i), read_double(words[1 + 2 * i]), read_double(words[2 + 2 * i]));
      const ComplexRoot root = root_near(system_->place_of(z));
      if (is_real(root) == Certainty::kYes)
        ++real;
      else if (std::ranges::none_of(roots_, [&](const auto& r) { return is_conjugate(root, r); }))
        roots_.push_back(root);
      if (!proof_.next()) throw Rejection("the file ends before the line 'end' of the proof");
    }
    if (real != poses_.size() || real + 2 * roots_.size() != system_->most())
      throw Rejection("the roots of the proof are not as many as there can be");
    return true;
  }

  static bool is_conjugate(const ComplexRoot& a, const ComplexRoot& b) {
    for (std::size_t i = 0; i < a.reach.size(); ++i) {
      acb_srcptr x = a.center.at(i), y = b.center.at(i);
      const double reach = a.reach[i] + b.reach[i];
      if (std::fabs(double_of(acb_realref(x)) - double_of(acb_realref(y))) > reach ||
          std::fabs(double_of(acb_imagref(x)) + double_of(acb_imagref(y))) > reach)
        return false;
    }
    return true;
  }

  [[nodiscard]] std::string hint(const ComplexRoot& root) const {
    const std::vector<double> scale = system_->scale_at(root.center);
    std::vector<double> middles, radii;
    for (const std::size_t i : kNumbersOfPose) {
      middles.push_back(double_of(acb_realref(root.center.at(i))));
      middles.push_back(double_of(acb_imagref(root.center.at(i))));
      const double radius = std::max(kMoreThanPlaces * root.radius[i], kAboutRoot * scale[i]);
      radii.insert(radii.end(), 2, radius);
    }
    return "(" + coq_floats(middles) + ",\n    " + coq_floats(radii) + ")";
  }

  static constexpr std::size_t kMostPoses = 40;

  Lines& proof_;
  Question& q_;
  const CoqQuestion coq_;
  std::unique_ptr<CountedSystem> system_;
  CoqNames constants_;  ///< their values; two anchors that are one have the same text
  std::vector<WrittenLeg> legs_;
  std::vector<CoqItem> poses_;
  std::vector<ComplexRoot> roots_;
  bool is_in_pairs_ = false;
};

}  // namespace

std::string platform_theorem(Lines& proof, Question& question,
                             const std::vector<std::string>& lines) {
  return PlatformWriter(proof, question, lines).text();
}

}  // namespace regulus::verifier
