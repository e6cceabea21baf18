// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/model_comparison.hpp"

#include <algorithm>

#include "runtime/files/sha256.hpp"
#include "runtime/verifier/model/closure_comparison.hpp"
#include "runtime/verifier/model/load_comparison.hpp"
#include "runtime/verifier/model/motion_comparison.hpp"
#include "runtime/verifier/model/place_comparison.hpp"
#include "runtime/verifier/model/platform_comparison.hpp"
#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {
namespace {

std::string indexed(std::size_t i) { return '[' + std::to_string(i) + ']'; }

bool has_below(const WrittenValues& values, const std::string& table) {
  const auto first = values.lower_bound(table);
  return first != values.end() && first->first.starts_with(table);
}

/// Appends what follows the prefix in the keys that begin with it.
template <class Map>
void add_names_below(const std::string& prefix, const Map& map, std::vector<std::string>& names) {
  for (auto known = map.lower_bound(prefix); known != map.end() && known->first.starts_with(prefix);
       ++known)
    names.push_back(known->first.substr(prefix.size()));
}

/// Returns the names that the certificate gives the parts of a trajectory: those of `piecewise`, and
/// the parameter of a piece.
Names names_of_pieces(const std::vector<std::string>& compared) {
  Names names;
  for (const std::string_view kind : {"value ", "lower "})
    for (const std::string& key : compared)
      if (key.starts_with(kind)) names.insert(key.substr(kind.size()));
  return names;
}

class ModelComparison {
 public:
  ModelComparison(Question& q, const WrittenValues& values, const Options& options,
                  Verification& result, const std::vector<std::string>& compared, CutSides* sides)
      : q_(q),
        values_(values),
        section_(read_section(values)),
        comparer_(q, values, section_.get(), names_of_pieces(compared), sides, options, result),
        compared_(compared.begin(), compared.end()) {}

  void run() {
    if (q_.solutions && !q_.closure) return compare_solutions();
    compare_geometry();
    const bool is_known = compare_robot();
    compare_motion(comparer_, section_.get(), pose_names(), compared_);
    if (q_.load || q_.quantity) compare_load_lines();
    require_known_tables();
    comparer_.finish(is_known);
  }

 private:
  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }

  /// Of a section that no reader knows, those of the certificate: its entries are not compared.
  [[nodiscard]] std::vector<std::string> pose_names() const {
    std::vector<std::string> names;
    if (section_) {
      for (const SectionPose& pose : section_->pose()) names.push_back(pose.name);
      return names;
    }
    add_names_below("pose.", values_, names);
    if (names.empty()) add_names_below("pose ", q_.stated, names);
    return names;
  }

  void compare_solutions() {
    for (const char* other : {"matrix.", "pose.", "closure."})
      if (has_below(values_, other))
        comparer_.leave_out({other, 0, ""}, "the robot is described twice");
    const bool is_uncertain = !q_.variables.empty();
    if (is_uncertain) compare_geometry();
    compare_robot_at_place(comparer_, section_.get());
    require_known_tables();
    comparer_.finish(is_uncertain);
  }

  // The robot.

  void compare_geometry() {
    constexpr std::string_view kTable = "geometry.";
    std::set<std::string> names;
    for (auto known = values_.lower_bound(kTable);
         known != values_.end() && known->first.starts_with(kTable); ++known) {
      const std::string rest = known->first.substr(kTable.size());
      names.insert(rest.substr(0, rest.find_first_of(".[")));
    }
    for (const std::string& name : names) compare_constant(std::string(kTable) + name, name);
  }

  /// A number, a list of coordinates, or a table with one of them as its value.
  void compare_constant(const std::string& place, const std::string& name) {
    const bool is_table = has_below(values_, place + '.');
    const std::string value = is_table ? place + ".value" : place;
    std::vector<std::pair<std::string, std::string>> coordinates;  // place and name
    if (has(value)) coordinates.emplace_back(value, name);
    for (std::size_t i = 0; has(value + indexed(i)); ++i)
      coordinates.emplace_back(value + indexed(i), name + '_' + std::to_string(i + 1));
    const bool is_ball = has(place + ".radius");
    const std::string spread = is_ball ? place + ".radius" : place + ".tolerance";
    const auto group = values_.find(place + ".group");
    const std::string option = group == values_.end() ? "" : "tolerance " + group->second.text;
    std::vector<std::string> names;
    for (const auto& [coordinate, own] : coordinates) {
      comparer_.compare_constant_at(coordinate, "value " + own);
      comparer_.compare_or_zero(spread, "spread " + own, option);
      names.push_back(own);
    }
    if (is_ball) comparer_.expect_ball(comparer_.place_of(spread), names);
    require_known_keys(place, is_table, coordinates.size());
  }

  void require_known_keys(const std::string& place, bool is_table, std::size_t coordinates) {
    std::size_t known = coordinates, count = 0;
    if (is_table)
      for (const char* key : {".tolerance", ".radius", ".group"}) known += has(place + key);
    for (const char* next : {".", "["})
      for (auto below = values_.lower_bound(place + next);
           below != values_.end() && below->first.starts_with(place + next); ++below)
        ++count;
    if (count + has(place) != known)
      comparer_.leave_out(comparer_.place_of(place), "this reader does not know all of its keys");
  }

  /// Returns false if the section that describes the robot was not compared.
  bool compare_robot() {
    if (q_.closure && (!section_ || has_below(values_, "closure."))) {
      for (const char* other : {"matrix.", "gough.", "legs.", "serial."})
        if (has_below(values_, other))
          comparer_.leave_out({"[closure]", 0, ""}, "the robot is described twice");
      compare_closure(comparer_);
      return true;
    }
    if (section_) {
      if (has_below(values_, "matrix.") || has_below(values_, "pose."))
        comparer_.leave_out({"[matrix] or [pose]", 0, ""}, "the robot is described twice");
      q_.closure ? compare_platform(comparer_, *section_) : section_->compare(comparer_);
      return true;
    }
    for (const char* section : {"gough", "legs", "serial"})
      if (has_below(values_, std::string(section) + '.')) {
        comparer_.leave_out({'[' + std::string(section) + ']', 0, ""},
                            "this reader does not form its matrix");
        return false;
      }
    compare_matrix();
    return true;
  }

  void compare_matrix() {
    require_shape();
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      comparer_.compare_at("matrix.rows" + indexed(e / q_.columns) + indexed(e % q_.columns),
                           "entry " + std::to_string(e), q_.actual);
    const std::string scales = "matrix.row_scale";
    for (std::size_t i = 0; has(scales + indexed(i)); ++i) {
      const NodeId scale =
          comparer_.compare_at(scales + indexed(i), "scale " + std::to_string(i), q_.actual);
      if (scale == kNoNode) continue;
      comparer_.definedness().require(scales + indexed(i), scale);
      comparer_.definedness().require_positive(scales + indexed(i), scale);
    }
    for (auto stated = q_.stated.lower_bound("scale ");
         stated != q_.stated.end() && stated->first.starts_with("scale "); ++stated)
      if (!comparer_.is_compared(stated->first)) comparer_.refuse_stated(stated->first);
  }

  void require_shape() const {
    const std::string rows = "matrix.rows";
    std::size_t count = 0;
    for (auto known = values_.lower_bound(rows + '[');
         known != values_.end() && known->first.starts_with(rows + '['); ++known)
      ++count;
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      count -= has(rows + indexed(e / q_.columns) + indexed(e % q_.columns));
    if (count != 0 || !has(rows + indexed(q_.rows - 1) + indexed(q_.columns - 1)))
      comparer_.refuse_model("the matrix of the file is not " + std::to_string(q_.rows) + " x " +
                             std::to_string(q_.columns) + ", as in the certificate");
  }

  // Loads and quantities.

  void compare_load_lines() {
    const LoadComparer comparer{
        [&](const std::string& place, const std::string& stated) {
          comparer_.compare_constant_at(place, stated);
        },
        [&](const std::string& stated) { comparer_.note_compared(stated); },
        [&](const std::string& place) {
          comparer_.leave_out(comparer_.place_of(place),
                              "the columns of the matrix have no names here");
        },
        [&](const std::string& stated) { comparer_.refuse_stated(stated); },
        [&](const std::string& key, std::size_t row) {
          comparer_.refuse_model("it gives the motor of row " + std::to_string(row + 1) +
                                 " a value in [actuators] " + key +
                                 ", which the certificate does not have");
        },
        [&](const std::string& stated) { return comparer_.is_compared(stated); },
        section_.get()};
    if (q_.load ? !compare_load(q_, values_, comparer) : !compare_quantity(q_, values_, comparer))
      comparer_.refuse_model("it has no " +
                             (q_.load ? "load '" + q_.load->name
                                      : q_.quantity->set_kind + " '" + q_.quantity->set->name) +
                             "'");
  }

  /// What this reader does not know may change the question.
  void require_known_tables() {
    static const std::set<std::string, std::less<>> kKnown{"actuators", "characteristic_length",
                                                           "drawing",   "geometry",
                                                           "gough",     "legs",
                                                           "let",       "load",
                                                           "matrix",    "motion",
                                                           "name",      "pose",
                                                           "regulus",   "serial",
                                                           "source",    "twist"};
    for (const auto& [place, written] : values_)
      if (!kKnown.contains(place.substr(0, place.find_first_of(".["))) &&
          !(q_.closure && place.starts_with("closure.")))
        comparer_.leave_out(comparer_.place_of(place), "this reader does not know it");
    if (has("regulus") && values_.at("regulus").text != "1")
      comparer_.leave_out(comparer_.place_of("regulus"), "another version of the format");
  }

  Question& q_;
  const WrittenValues& values_;
  const std::unique_ptr<SectionReading> section_;
  QuestionComparer comparer_;
  const std::set<std::string> compared_;  ///< the keys that are compared elsewhere
};

/// `differs`: what the reader is told of a file with another text.
void require_labels(const Question& question, const WrittenValues& values, const Options& options,
                    const char* differs) {
  const auto refuse = [&options](const std::string& why) {
    throw OtherModel("the certificate is not about " + options.model_name + ": " + why);
  };
  if (question.sha256 != "-" && question.sha256 != detail::sha256(options.model_text))
    refuse(differs);
  const auto name = values.find("name");
  const bool is_plain = name != values.end() && name->second.text.find('\\') == std::string::npos;
  if (is_plain && name->second.text != question.model)
    refuse("line " + std::to_string(name->second.line) + ": name is '" + name->second.text +
           "', but the certificate has '" + question.model + "'");
}

}  // namespace

void compare_with_model(Question& question, const WrittenValues& values, const Options& options,
                        Verification& result, const std::vector<std::string>& compared,
                        CutSides* sides) {
  ModelComparison(question, values, options, result, compared, sides).run();
}

void compare_with_file(Question& question, const WrittenValues& values, const Options& options,
                       Verification& result, const std::vector<std::string>& compared,
                       CutSides* sides) {
  try {
    compare_with_model(question, values, options, result, compared, sides);
  } catch (const Unfinished&) {
    require_labels(question, values, options, "the SHA-256 of that file differs");
    throw;
  }
  require_labels(question, values, options,
                 "the values of this question are equal, but the SHA-256 of that file differs: its "
                 "text was changed, perhaps a unit; make the certificate again");
}

}  // namespace regulus::verifier
