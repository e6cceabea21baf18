// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/place_table.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/verifier/input_file.hpp"
#include "runtime/verifier/model/joint_chain.hpp"
#include "runtime/verifier/model/place_comparison.hpp"
#include "runtime/verifier/model/section_reading.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostTableBytes = std::size_t{1} << 28;
constexpr std::array<const char*, 6> kToolNames = {"x", "y", "z", "roll", "pitch", "yaw"};

/// A number that a column may give: its name, its unit in the model, and where the file has it.
struct Given {
  std::string name, unit, place;
};

std::vector<SectionPose> pose_of_model(const WrittenValues& model) {
  if (const auto section = read_section(model)) return section->pose();
  constexpr std::string_view kTable = "pose.";
  std::vector<SectionPose> pose;
  for (auto at = model.lower_bound(kTable); at != model.end() && at->first.starts_with(kTable);
       ++at)
    pose.push_back({at->first.substr(kTable.size()), at->second.text});
  return pose;
}

/// Names that a pose parameter has, too, have the prefix.
void tell_apart(std::vector<Given>& names, const std::vector<Given>& pose, const char* prefix) {
  const auto is_taken = [&pose](const Given& name) {
    return std::ranges::find(pose, name.name, &Given::name) != pose.end();
  };
  if (std::ranges::any_of(names, is_taken))
    for (Given& name : names) name.name.insert(0, prefix);
}

/// The number of a cell in the unit of the model, as a model file has it. Throws Unfinished.
WrittenValue written(const WaypointTable& table, std::size_t row, std::size_t column,
                     const std::string& unit) {
  WrittenValue value;
  value.line = table.rows[row].line;
  value.text = table.rows[row].cells[column];
  const std::string factor = factor_of_column(table.columns[column], unit);
  if (factor.empty()) return value;
  value.text = '(' + value.text + ")*" + factor;
  value.is_string = true;
  return value;
}

/// The columns of one row, and what they give.
class RowReading {
 public:
  RowReading(const WaypointTable& table, std::size_t row, const Question& question,
             WrittenValues model)
      : table_(table), row_(row), motion_("motion." + question.motion + '.') {
    result_.values = std::move(model);
    name_numbers(question);
  }

  PlaceTable::AtRow read() {
    const std::size_t of_pose = take(pose_), of_other = take(other_);
    if (!pose_.empty() && of_pose > 0 && of_other > 0 && !is_arm_)
      throw Unfinished("the table has columns of the pose and of lengths");
    const std::size_t most = of_other > 0 ? other_.size() : pose_.size();
    result_.is_whole = (of_other > 0 ? of_other : of_pose) == most;
    result_.numbers = of_pose + of_other;
    if (result_.numbers == 0) throw Unfinished("no column of the table has a number of the place");
    if (of_other > 0 || is_robot_) result_.fixed.insert(kPlaceOption);
    for (const char* key : {"waypoints", "interpolation"}) result_.values.erase(motion_ + key);
    return std::move(result_);
  }

 private:
  void name_numbers(const Question& question) {
    const std::vector<SectionPose> pose = pose_of_model(result_.values);
    for (const SectionPose& p : pose) pose_.push_back({p.name, p.unit, motion_ + p.name});
    is_arm_ = question.solutions && question.solutions->arm;
    is_robot_ = question.solutions && (is_arm_ || !question.solutions->legs.empty());
    if (is_arm_) return name_tool();
    for (std::size_t i = 0; is_robot_ && i < question.solutions->legs.size(); ++i)
      other_.push_back({"rho_" + std::to_string(i + 1), pose.empty() ? "" : pose.front().unit,
                        motion_ + "legs[" + std::to_string(i) + ']'});
    tell_apart(other_, pose_, "leg_");
  }

  void name_tool() {
    const auto unit = result_.values.find("serial.unit");
    const std::string length = unit == result_.values.end() ? "" : unit->second.text,
                      angle = is_arm_in_degrees(result_.values) ? "deg" : "rad";
    for (std::size_t i = 0; i < kToolNames.size(); ++i)
      other_.push_back(
          {kToolNames[i], i < 3 ? length : angle, motion_ + "tool[" + std::to_string(i) + ']'});
    tell_apart(other_, pose_, "tool_");
  }

  /// Returns the number of columns that have these names.
  std::size_t take(const std::vector<Given>& names) {
    std::size_t count = 0;
    for (const Given& given : names) {
      const auto column =
          std::ranges::find(table_.columns, given.name, &WaypointTable::Column::name);
      if (column == table_.columns.end()) continue;
      for (const char* end : {"[0]", "[1]"}) result_.values.erase(given.place + end);
      result_.values.insert_or_assign(
          given.place,
          written(table_, row_, std::size_t(column - table_.columns.begin()), given.unit));
      result_.fixed.insert("range " + given.name);
      ++count;
    }
    return count;
  }

  const WaypointTable& table_;
  const std::size_t row_;
  const std::string motion_;  ///< "motion.NAME."
  std::vector<Given> pose_;   ///< its parameters
  std::vector<Given> other_;  ///< lengths of legs, or coordinates of the tool
  bool is_arm_ = false, is_robot_ = false;
  PlaceTable::AtRow result_;
};

std::string folder_of_file(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

}  // namespace

PlaceTable::PlaceTable(std::string file) : file_(std::move(file)) {
  std::string text;
  try {
    text = read_text(file_, kMostTableBytes);
  } catch (const std::runtime_error& why) {
    throw Unfinished(std::string("the places cannot be read: ") + why.what());
  }
  table_ = read_waypoint_table(text);
  std::set<std::string> names;
  for (const WaypointTable::Column& column : table_.columns)
    if (!names.insert(column.name).second)
      throw Unfinished("two columns of " + file_ + " have one name");
}

std::string PlaceTable::describe(std::size_t row) const {
  return "line " + std::to_string(table_.rows[row].line) + " of " + file_;
}

PlaceTable::AtRow PlaceTable::at(std::size_t row, const Question& question,
                                 WrittenValues model) const {
  return RowReading(table_, row, question, std::move(model)).read();
}

std::string table_of_motion(const WrittenValues& model, const std::string& motion,
                            const std::string& model_name) {
  const auto found = model.find("motion." + motion + ".waypoints");
  if (found == model.end()) return "";
  const std::string& file = found->second.text;
  return file.starts_with('/') ? file : folder_of_file(model_name) + file;
}

}  // namespace regulus::verifier
