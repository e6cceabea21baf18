// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_arm_theorem.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/verifier/model/section_reading.hpp"

namespace regulus::verifier {
namespace {

constexpr std::array<const char*, 6> kRowNames = {"v_x", "v_y", "v_z", "w_x", "w_y", "w_z"};

std::vector<std::string> as_arguments(const std::vector<std::string>& texts) {
  std::vector<std::string> result;
  for (const std::string& text : texts) result.push_back(coq_argument(text));
  return result;
}

}  // namespace

ArmWriter::ArmWriter(const Question& question, const WrittenValues& values,
                     const RobotOfModel& robot, std::vector<std::string> point)
    : q_(question),
      values_(values),
      robot_(robot),
      point_(std::move(point)),
      poses_(read_section(values)->pose()),
      view_(find_arm_view(question, values, as_arguments(point_))) {
  if ((q_.singular || q_.has_threshold) && view_.ratio.empty())
    throw Unfinished(
        "there is no theorem about the determinant of an arm whose matrix is not "
        "square");
}

std::string ArmWriter::definition() const {
  if (!robot_.is_geometry_certain) return "";
  std::vector<std::string> joints;
  for (const SectionPose& pose : poses_) joints.push_back(coq_identifier(pose.name));
  return "(** The parts of the arm of the model file, from the base to the tool, with the values "
         "of "
         "its\n    joints. *)\nDefinition arm (" +
         text_of(joints, " ") + " : R) : list part :=\n  " + parts(joints, "   ") + ".\n\n";
}

/// The parts, with these words for the values of the joints.
std::string ArmWriter::parts(const std::vector<std::string>& joints,
                             const std::string& margin) const {
  std::vector<CoqItem> items;
  for (const CoqPart& part : robot_.parts) items.push_back({"", coq_part(part, joints)});
  return coq_list(items, margin);
}

std::string ArmWriter::arm() const {
  return robot_.is_geometry_certain ? "(arm " + text_of(as_arguments(robot_.pose), " ") + ')'
                                    : "\n    " + parts(robot_.pose, "     ");
}

std::string ArmWriter::jacobian() const { return "(jacobian " + arm() + ')'; }

std::string ArmWriter::rank() const {
  const std::size_t joints = robot_.pose.size();
  const char* word = is_about_columns()          ? "columns_depend 6 "
                     : joints > kRowNames.size() ? "full_row_rank 6 "
                                                 : "full_column_rank 6 ";
  return word + std::to_string(joints) + "\n    " + jacobian();
}

std::string ArmWriter::determinant() const {
  const std::string size = "determinant " + std::to_string(view_.rows.size());
  if (view_.rows.size() == kRowNames.size()) return size + ' ' + jacobian();
  std::vector<std::string> names;
  for (const std::size_t row : view_.rows) names.emplace_back(kRowNames.at(row));
  return size + "\n    (rows_of [" + text_of(names, "; ") + "]\n      (jacobian_seen " +
         place_of(view_) + ' ' + arm() + "))";
}

bool ArmWriter::is_about_columns() const {
  return q_.singular && !q_.has_threshold && view_.rows.size() < kRowNames.size();
}

/// How many parts are before the link, and the point in its frame.
std::string ArmWriter::place_of(const ArmView& view) const {
  return std::to_string(parts_before(view.link)) + " (" + text_of(view.point, ", ") + ')';
}

std::size_t ArmWriter::parts_before(std::size_t link) const {
  std::size_t count = 0;
  for (std::size_t joints = 0; joints < link; ++count)
    joints += robot_.parts.at(count).joint.has_value();
  return count;
}

std::string ArmWriter::rows_of(const ArmView& view) const {
  std::vector<std::string> rows;
  for (const std::size_t row : view.rows) rows.push_back(std::to_string(row));
  return place_of(view) + " [" + text_of(rows, "; ") + ']' +
         (view.ratio.empty() ? "" : ' ' + coq_argument(view.ratio));
}

/// The values of joints that are definitions of the certificate, and no numbers.
std::string ArmWriter::list_of_words(const std::vector<std::string>& poses) const {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (std::ranges::find(q_.variables, poses_[i].name, &Variable::name) == q_.variables.end() &&
        robot_.pose[i].find('_') != std::string::npos)
      words.push_back(poses[i]);
  return words.empty() ? "no_quantities" : '[' + text_of(words, "; ") + ']';
}

std::string ArmWriter::regular_proof() const {
  const char* tactic = q_.has_threshold      ? "by_large_arm"
                       : view_.ratio.empty() ? "by_rows_of_arm"
                                             : "by_arm";
  return std::string(tactic) + " the_claim\n    " +
         (point_.empty() ? "no_quantities" : '[' + text_of(point_, "; ") + ']') + ' ' +
         list_of_words(robot_.pose) + "\n    " + rows_of(view_) + " S";
}

/// The values of the joints at the pose of the certificate.
std::vector<std::string> ArmWriter::values_at_pose() const {
  std::map<std::string, std::string> of_pose;
  for (const CoqQuantity& quantity : robot_.quantities) of_pose[quantity.name] = quantity.of_pose;
  std::vector<std::string> names, values;
  for (const std::string& name : robot_.names) names.push_back(coq_argument(of_pose[name]));
  for (std::size_t i = 0; i < poses_.size(); ++i)
    values.push_back(robot_.poses[i].has_error
                         ? of_pose[robot_.pose[i]]
                         : coq_real(robot_.own.graph, robot_.poses[i].commanded, names));
  return values;
}

std::string ArmWriter::singular_proof() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < q_.variables.size(); ++i)
    names.push_back("(quantity v " + std::to_string(i) + ')');
  const ArmView view = find_arm_view(q_, values_, names);
  return std::string(q_.has_threshold ? "by_small_arm" : "by_singular_arm") + " S\n    " +
         list_of_words(values_at_pose()) + "\n    " + rows_of(view);
}

}  // namespace regulus::verifier
