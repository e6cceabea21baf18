// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/plain_words.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/model/edited_note.hpp"
#include "codegen/model/reduced_note.hpp"

namespace regulus::detail {
namespace {

/// A matrix that leaves out constraints says less than the robot does.
std::string limited(const SearchSubject& p, const std::string& sentence) {
  const bool is_reduced = full_or_reduced(p.labels.matrix_notes) == std::string_view("reduced");
  return (is_reduced ? "as far as the reduced matrix says, " : "") + sentence;
}

/// Returns "of this motion", with the poses that are meant.
std::string of_motion(const SearchSubject& p) {
  if (p.labels.where == name(Where::kReachable)) return "of this motion that the robot reaches";
  if (p.labels.where == name(Where::kWithinRanges))
    return "of this motion with the joints within their ranges";
  return p.labels.constraints > 0 ? "of this motion that meets the constraints" : "of this motion";
}

bool is_of_arm(const SearchSubject& p) { return p.labels.matrix_kind != MatrixKind::kInverse; }

/// True if the columns are named as a twist: otherwise the model does not say what the matrix belongs to.
/// Edited, it is no longer that of the robot.
bool has_platform(const SearchSubject& p) {
  return !p.labels.twist.empty() && !is_edited(p.labels.matrix_notes);
}

/// Returns "in all 6 directions of its matrix".
std::string in_all_directions(const SearchSubject& p) {
  return fmt::format(
      "in all {} directions of its matrix",
      p.labels.matrix_kind == MatrixKind::kForward ? p.labels.rows : p.labels.columns);
}

/// The arm has fewer joints than its matrix has directions: none of them is lost if the joints keep all
/// of their own freedom.
bool is_short(const SearchSubject& p) {
  return p.labels.matrix_kind == MatrixKind::kForward && p.labels.rows > p.labels.columns;
}

/// `poses`: "of this motion".
std::string held(const SearchSubject& p, const std::string& poses) {
  if (p.labels.is_branch)
    return fmt::format(
        "the mechanism cannot change its branch, or move while the motors are locked, at any pose "
        "{}",
        poses);
  if (is_short(p))
    return fmt::format("at every pose {} each motion of the {} joints moves the tool", poses,
                       p.labels.columns);
  return is_of_arm(p) ? fmt::format("at every pose {} the joints can move the tool {}", poses,
                                    in_all_directions(p))
         : has_platform(p)
             ? fmt::format("the platform cannot give way at any pose {} while its legs hold", poses)
             : fmt::format("the matrix loses rank at no pose {}", poses);
}

/// `pose`: "at some pose", "at every pose".
std::string lost(const SearchSubject& p, const char* pose, const std::string& poses) {
  if (p.labels.is_branch)
    return fmt::format("{} {} the mechanism can move although the motors are locked", pose, poses);
  if (is_short(p))
    return fmt::format("{} {} the {} joints can move and leave the tool at rest", pose, poses,
                       p.labels.columns);
  return is_of_arm(p) ? fmt::format("{} {} the joints cannot move the tool {}", pose, poses,
                                    in_all_directions(p))
         : has_platform(p)
             ? fmt::format("{} {} the platform can give way although its legs hold", pose, poses)
             : fmt::format("{} {} the matrix loses rank", pose, poses);
}

std::string past_threshold(const SearchSubject& p, bool exceeded) {
  return fmt::format("at {} pose {} |det J⁻¹| is {} {}", exceeded ? "every" : "some", of_motion(p),
                     exceeded ? "larger than" : "at most",
                     threshold_text(p.variety.alpha, exceeded));
}

std::string with_uncertain(const SearchSubject& p, const char* words, std::string sentence) {
  return sentence + (uncertain_count(p) == 0 ? "" : words);
}

std::string plain_words(const SearchSubject& p, Verdict verdict, Reason reason) {
  constexpr const char* kAll = ", whatever the uncertain quantities are within their tolerances";
  constexpr const char* kSome = ", for some values of the uncertain quantities";
  const bool threshold = p.variety.alpha.hi > 0;
  if (verdict == Verdict::kNoSingularity)
    return limited(
        p, with_uncertain(p, kAll, threshold ? past_threshold(p, true) : held(p, of_motion(p))));
  if (verdict == Verdict::kPossibleProblem) return "";
  if (reason == Reason::kAlwaysSingular)
    return limited(p, with_uncertain(p, kAll, lost(p, "at every pose", of_motion(p))));
  return limited(p, with_uncertain(p, kSome,
                                   threshold ? past_threshold(p, false)
                                             : lost(p, "at some pose", of_motion(p))));
}

}  // namespace

void tell_meaning(const std::string& words, Facts& facts) {
  using Json = nlohmann::ordered_json;
  facts.tell("meaning", words.empty() ? Json(nullptr) : Json(words), "meaning", words);
}

void tell_meaning(const SearchSubject& subject, Verdict verdict, Reason reason, Facts& facts) {
  tell_meaning(plain_words(subject, verdict, reason), facts);
}

void tell_meaning_of_parts(const SearchSubject& subject, const char* part, Facts& facts) {
  if (subject.variety.alpha.hi > 0) {
    facts.add("meaning", nullptr);
    return;
  }
  const std::string of_part = fmt::format("of the {}", part);
  const std::string words = fmt::format("free: {}\nsingular: {}", held(subject, of_part),
                                        lost(subject, "at some pose", of_part));
  std::string in_one_line = words;
  in_one_line.replace(in_one_line.find('\n'), 1, "; ");
  facts.tell("meaning", in_one_line, "meaning", words);
}

std::string nothing_proved(const std::string& reason) { return "nothing is proved: " + reason; }

}  // namespace regulus::detail
