// SPDX-License-Identifier: Apache-2.0
// Compares single values of a model file with what a certificate states, and knows what is left.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/verifier/model/cut_sides.hpp"
#include "runtime/verifier/model/definedness.hpp"
#include "runtime/verifier/model/file_expressions.hpp"
#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

class QuestionComparer final : public SectionComparer {
 public:
  /// `section`: may be null. `hidden`: names that the certificate gives the parts of a trajectory; an
  /// expression of the file cannot mean them. `sides`: of the cuts of atan2 that the question is about;
  /// may be null. All but `hidden` must outlive this object.
  QuestionComparer(Question& question, const WrittenValues& values, SectionReading* section,
                   Names hidden, CutSides* sides, const Options& options, Verification& result);

  [[nodiscard]] Question& question() override { return q_; }
  [[nodiscard]] const WrittenValues& values() const override { return values_; }
  /// Of a place that the file does not have: a value of 0, without a line.
  [[nodiscard]] FilePlace place_of(const std::string& place) const override;
  [[nodiscard]] NodeId expression_at(const std::string& place, const Scope& scope) override {
    return on_sides(expressions_.at(place, scope));
  }

  using SectionComparer::compare;
  void compare(const FilePlace& from, NodeId value, const std::string& stated,
               const std::string& option) override;
  void expect_ball(const FilePlace& from, const std::vector<std::string>& names) override;
  void expect_defined(const FilePlace& from, NodeId value) override;
  void note_compared(const std::string& stated) override { used_.insert(stated); }
  void leave_out(const FilePlace& from, const std::string& why) override;
  [[noreturn]] void refuse(const FilePlace& from, const std::string& stated) override;

  /// Compares the value at a place, if the file has it; returns its node, or kNoNode. A value of a
  /// pose parameter in degrees is a number of degrees.
  NodeId compare_at(const std::string& place, const std::string& stated, const Scope& scope,
                    const std::string& option = "");
  /// The same without names.
  NodeId compare_constant_at(const std::string& place, const std::string& stated,
                             const std::string& option = "") {
    return compare_at(place, stated, no_names_, option);
  }
  /// The same; a place that the file does not have stands for 0.
  NodeId compare_or_zero(const std::string& place, const std::string& stated,
                         const std::string& option = "");

  /// Returns the value at a place of the file that a pose parameter has; it is in its unit.
  [[nodiscard]] NodeId pose_at(const std::string& place, const std::string& name) {
    return expressions_.at(place, q_.actual, degrees_.contains(name));
  }
  /// The same without names.
  [[nodiscard]] NodeId number_at(const std::string& place, const std::string& name) {
    return expressions_.at(place, no_names_, degrees_.contains(name));
  }
  /// Returns a value without names; `in_degrees`: it is a number of degrees.
  [[nodiscard]] NodeId constant_at(const std::string& place, bool in_degrees) {
    return expressions_.at(place, no_names_, in_degrees);
  }
  /// The file and the certificate differ, as an option allows.
  void note_difference(std::string difference) {
    result_.differences.push_back(std::move(difference));
  }

  [[nodiscard]] Definedness& definedness() noexcept { return definedness_; }
  [[nodiscard]] bool is_compared(const std::string& stated) const { return used_.contains(stated); }
  [[nodiscard]] bool may_differ(const std::string& option) const;
  /// Returns the number of differences so far that an option may have made.
  [[nodiscard]] std::size_t differences() const noexcept { return result_.differences.size(); }
  /// Throws OtherModel: the certificate states this, and the file does not.
  [[noreturn]] void refuse_stated(const std::string& stated) const;
  [[noreturn]] void refuse_model(const std::string& why) const;
  /// Throws OtherModel for a length that is negative, where the certificate has its square alone.
  void refuse_negative(const FilePlace& from, NodeId length) const;
  /// Returns the expression, and nothing where the commanded pose has no errors.
  [[nodiscard]] NodeId without_errors(NodeId actual);
  /// The expressions of the file for entries, scales and conditions, by the actual pose.
  [[nodiscard]] const std::vector<NodeId>& model_expressions() const {
    return expressions_of_model_;
  }

  /// Throws OtherModel for a ball that only one of both has, and Unfinished unless all that the
  /// certificate states has been compared. `has_balls`: expect_ball was called for every ball.
  void finish(bool has_balls);

 private:
  [[nodiscard]] NodeId on_sides(NodeId expression) {
    return sides_ == nullptr ? expression : sides_->on_sides(expression);
  }
  [[nodiscard]] StatedValue stated_or_zero(const FilePlace& from, const std::string& stated);
  void differ(const FilePlace& from, const StatedValue& stated, const std::string& option);
  [[nodiscard]] bool is_number_of_degrees(const std::string& stated) const;
  void compare_balls() const;
  void require_equal_tolerances();

  Question& q_;
  const WrittenValues& values_;
  SectionReading* section_;
  CutSides* const sides_;
  const Options& options_;
  Verification& result_;
  const Names degrees_, hidden_;
  const Scope no_names_;
  FileExpressions expressions_;
  Definedness definedness_;
  std::set<std::string> used_;     ///< keys of Question::stated
  std::set<std::string> changed_;  ///< the options that have changed a value
  std::map<std::string, std::vector<std::pair<FilePlace, StatedValue>>> groups_;  ///< by option
  std::vector<std::string> left_out_;                                             ///< sentences
  std::set<std::set<std::string>> balls_;  ///< of the file, by the names of the coordinates
  std::vector<NodeId> expressions_of_model_;
};

}  // namespace regulus::verifier
