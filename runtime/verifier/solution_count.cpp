// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/solution_count.hpp"

#include <algorithm>

#include "runtime/verifier/counted_system.hpp"
#include "runtime/verifier/planar_platform.hpp"
#include "runtime/verifier/pose_search.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/solution_lines.hpp"
#include "runtime/verifier/solution_search.hpp"
#include "runtime/verifier/variety.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kNumbersOfPose = 7;
constexpr long kMostBitsOfCount = 1024;  // Numbers of the question are enclosed with some more.

/// The first line of the proof has been read.
class SolutionCount {
 public:
  SolutionCount(Lines& lines, Question& q, const Box& places, const Options& options,
                Verification& result)
      : lines_(lines),
        claim_(*q.solutions),
        system_(platform_system(q, places)),
        result_(result),
        clock_(options, result) {}

  void check() {
    for (const SolutionLine& line : claim_.solutions) {
      lines_.name_line(line.line);
      system_->require_possible(line);
    }
    lines_.name_line(0);
    read();
    require_number();
    for (std::size_t i = 0; i < starts_.size(); ++i) prove(i);
    match();
    lines_.name_line(0);
  }

 private:
  [[noreturn]] void reject(std::size_t line, const std::string& why) {
    lines_.name_line(line);
    throw Rejection(why);
  }
  [[noreturn]] void give_up(std::size_t line, const std::string& why) {
    lines_.name_line(line);
    throw Unfinished(why);
  }

  void read() {
    do {
      const auto words = words_of(lines_.text());
      if (words.size() == 2 && words[0] == "end") return read_end(words[1]);
      if (words.empty() || words[0] != "root" || words.size() != 1 + 2 * system_->numbers())
        throw Rejection("expected 'root' and " + std::to_string(2 * system_->numbers()) +
                        " numbers, or 'end'");
      if (starts_.size() == format::kMostSolutions) throw Rejection("there are too many roots");
      ComplexMatrix z(system_->numbers(), 1);
      for (std::size_t i = 0; i < system_->numbers(); ++i)
        acb_set_d_d(z.at(i), read_double(words[1 + 2 * i]), read_double(words[2 + 2 * i]));
      starts_.push_back(std::move(z));
      lines_of_.push_back(lines_.number());
    } while (lines_.next());
    throw Rejection("the file ends before the line 'end' of the proof");
  }

  void read_end(std::string_view count) {
    if (count != std::to_string(starts_.size()))
      throw Rejection("the proof has " + std::to_string(starts_.size()) + " lines 'root'");
    if (lines_.next()) throw Rejection("there is text after the line 'end'");
  }

  /// Only if the roots are as many as there can be, there are no others.
  void require_number() const {
    const std::size_t count = starts_.size(), most = system_->most();
    if (count > most || (claim_.verdict != format::kIncomplete && count < most))
      throw Rejection("the proof has " + std::to_string(count) + " roots, and all would be " +
                      std::to_string(most));
  }

  void prove(std::size_t i) {
    clock_.tick();
    const ComplexMatrix place = system_->place_of(starts_[i]);
    const std::vector<double> scale = system_->scale_at(place);
    const ComplexSystem* one = system_->one();
    const auto root = one == nullptr ? prove_root(*system_, place, scale, kMostBitsOfCount)
                                     : prove_tube(*one, *system_, place, scale);
    if (!root) give_up(lines_of_[i], "no simple root was found near this place");
    lines_.name_line(lines_of_[i]);
    system_->require_solution(*root);
    for (std::size_t k = 0; k < roots_.size(); ++k) {
      const Certainty same = is_same(*root, roots_[k]);
      const std::string other = "the same root as line " + std::to_string(lines_of_[k]);
      if (same == Certainty::kYes) reject(lines_of_[i], "this is " + other);
      if (same == Certainty::kUnknown) give_up(lines_of_[i], "this may be " + other);
    }
    const Certainty real = is_real(*root);
    if (real == Certainty::kUnknown)
      give_up(lines_of_[i], "it is not certain whether this root is real");
    if (real == Certainty::kYes) real_.push_back(i);
    roots_.push_back(*root);
    result_.roots = roots_.size();
    result_.real_roots = real_.size();
  }

  /// Each real root has a line, and each line one of them.
  void match() {
    std::vector<bool> is_taken(claim_.solutions.size());
    for (const std::size_t i : real_) {
      const std::size_t line = line_of(i, is_taken);
      is_taken[line] = true;
    }
    for (std::size_t k = 0; k < is_taken.size(); ++k)
      if (!is_taken[k])
        reject(claim_.solutions[k].line, "the proof has no real root within this line");
  }

  std::size_t line_of(std::size_t root, const std::vector<bool>& is_taken) {
    bool is_certain = true;
    for (std::size_t k = 0; k < is_taken.size(); ++k) {
      const Certainty within = system_->is_within(roots_[root], claim_.solutions[k]);
      if (within == Certainty::kYes && !is_taken[k]) return k;
      is_certain = is_certain && within == Certainty::kNo;
    }
    if (is_certain) reject(lines_of_[root], "this root is real, and within no line 'solution'");
    give_up(lines_of_[root], "this root is real, and not certainly within a line 'solution'");
  }

  Lines& lines_;
  const SolutionLines& claim_;
  const std::unique_ptr<CountedSystem> system_;
  Verification& result_;
  WorkClock clock_;
  std::vector<ComplexMatrix> starts_;
  std::vector<std::size_t> lines_of_;  ///< by root
  std::vector<ComplexRoot> roots_;
  std::vector<std::size_t> real_;
};

}  // namespace

void check_solutions(Lines& lines, Question& question, const Options& options,
                     Verification& result) {
  if (question.solutions->legs.size() == kLegsInPlane) form_planar_equations(question);
  if (question.closure || question.solutions->arm)
    return search_solutions(lines, question, options, result);
  if (!lines.next()) throw Rejection("the file ends before the line 'end' of the proof");
  question.alpha = question.graph.number("0");
  const Box places = enclose_variety(question).outer;
  read_from_lines(lines, *question.solutions, kNumbersOfPose);
  if (question.solutions->from.empty() && lines.text() != "end")
    return SolutionCount(lines, question, places, options, result).check();
  if (lines.text() != "end") throw Rejection("expected 'end' after the lines 'from'");
  if (question.solutions->verdict == format::kIncomplete && !question.solutions->from.empty())
    throw Rejection("lines 'from' of poses on six legs are of COMPLETE");
  if (lines.next()) throw Rejection("there is text after the line 'end'");
  search_poses(lines, question, places, options, result);
}

}  // namespace regulus::verifier
