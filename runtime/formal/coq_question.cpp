// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_question.hpp"

#include <algorithm>
#include <set>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

namespace {

/// Turns the lines of a question that has been read without a fault into definitions of Coq.
class QuestionWriter {
 public:
  QuestionWriter(std::vector<std::string> lines, const Question& question,
                 const std::vector<std::string>& piece_names)
      : lines_(std::move(lines)), q_(question), piece_names_(piece_names) {
    for (std::size_t k = 0; k < piece_names.size(); ++k)
      of_piece_[piece_names[k]] = "(nth " + std::to_string(k) + " piece no_entry)";
    declare_variables();
    if (q_.closure) sort_closure_lines();
    for (const std::string& line : lines_) read(line);
  }

  [[nodiscard]] CoqQuestion result() const {
    return {text(), has_uncertain_ ? parameters_ : q_.variables.size(), actual_};
  }

 private:
  [[nodiscard]] std::string text() const {
    if (q_.closure) return closure_text();
    std::string text = "(** The names: the variables, then the definitions of the question. *)\n" +
                       names_text_ +
                       "\n(** The question, in the order of its certificate: the ranges of the "
                       "variables, the definitions,\n    the constraints, more expressions that "
                       "must have a value, the matrix and its number of columns. *)\n"
                       "Definition the_question " +
                       argument() + ": question := Question\n";
    for (const auto* list : {&ranges_, &definitions_, &constraints_, &defined_})
      text += "  " + coq_list(*list, "   ") + "\n";
    text += "  " + matrix() + "\n  " + std::to_string(q_.columns) + ".\n";
    if (q_.has_threshold) text += threshold();
    if (!limits_.empty()) return text + limits();
    if (!factors_.empty()) return text + factors();
    return loads_.empty() ? text : text + load();
  }

  /// The variables come first, whatever the order of their lines.
  void declare_variables() {
    for (const std::string& line : lines_) {
      std::string_view rest = line;
      const std::string_view key = take_until(rest, " ");
      if (key == "pose" && rest.find(" +- ") != std::string_view::npos)
        with_error_.emplace(take_until(rest, " = "));
    }
    for (const Variable& v : q_.variables) {
      parameters_ += v.kind == VariableKind::kParameter;
      has_uncertain_ |= v.kind == VariableKind::kUncertain;
      const bool is_error = v.kind == VariableKind::kError;
      const std::string name = is_error ? v.name.substr(0, v.name.find(' ')) : v.name;
      const bool is_square = v.name.starts_with("square ");
      const std::string identifier = fresh(is_square  ? "_square'" + v.name.substr(7)
                                           : is_error ? error_of(name)
                                           : with_error_.contains(name) ? commanded(name)
                                                                        : coq_identifier(name));
      declare(identifier);
      if (is_square) actual_[v.name] = identifier;
      if (!is_error) commanded_[name] = identifier;
      if (v.kind == VariableKind::kUncertain) actual_[name] = identifier;
    }
  }

  static std::string commanded(std::string_view name) {
    return coq_identifier(name) + "'commanded";
  }
  static std::string error_of(std::string_view name) { return coq_identifier(name) + "'error"; }

  /// The constants of a piece.
  [[nodiscard]] std::string argument() const {
    return piece_names_.empty() ? "" : "(piece : list expression) ";
  }

  /// A shared expression may have the name of a parameter that the matrix does not use.
  std::string fresh(std::string identifier) {
    while (!declared_.insert(identifier).second) identifier += '\'';
    return identifier;
  }

  void declare(const std::string& identifier) {
    names_text_ += "Definition " + identifier + " := Name " + std::to_string(next_name_++) + ".\n";
  }

  void define(const std::string& identifier, const std::string& expression) {
    declare(identifier);
    (has_unknowns_ ? further_ : definitions_).push_back({identifier, expression});
  }

  /// The unknowns are names after the shared expressions that do not use them.
  void sort_closure_lines() {
    std::set<std::string, std::less<>> moving(q_.closure->names.begin(), q_.closure->names.end());
    std::set<std::string, std::less<>> others;
    for (const auto& [name, value] : q_.commanded) others.insert(name);
    for (const auto& [name, text] : q_.closure->lets) {
      if (!others.insert(name).second)
        throw Unfinished("there is no theorem about a closure with two quantities of the name '" +
                         name + "' yet");
      if (uses_one_of(text, moving)) moving.insert(name);
    }
    const auto rank = [&moving](std::string_view line) {
      const std::string_view key = take_until(line, " ");
      if (key == "unknown" || key == "start") return 1;
      if (key == "equation" || key == "defined") return 3;
      return key == "let" && moving.contains(take_until(line, " = ")) ? 2 : 0;
    };
    std::ranges::stable_sort(lines_, std::ranges::less(), rank);
  }

  static bool uses_one_of(const std::string& text,
                          const std::set<std::string, std::less<>>& names) {
    const auto used = names_used({"entry " + text}, false);
    return std::ranges::any_of(used, [&](const std::string& name) { return names.contains(name); });
  }

  void read_unknown(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    const std::string value = coq_expression(take_until(rest, " +- "), of_piece_);
    has_unknowns_ = true;
    actual_[name] = fresh(coq_identifier(name));
    declare(actual_[name]);
    near_.push_back({actual_[name], "(" + value + ", " + coq_expression(rest, of_piece_) + ")"});
  }

  /// Uncertain quantities and errors start at their middles.
  [[nodiscard]] std::vector<CoqItem> starts() const {
    std::vector<CoqItem> items;
    auto next = starts_.begin();
    for (const Variable& v : q_.variables) {
      const bool is_uncertain = v.kind == VariableKind::kUncertain;
      items.push_back({"", v.kind == VariableKind::kParameter ? *next++
                           : is_uncertain                     ? middles_.find(v.name)->second
                                                              : "0"});
    }
    return items;
  }

  [[nodiscard]] std::string closure_text() const {
    std::string text =
        "(** The names: the variables, the definitions that use no unknowns, the unknowns, and the "
        "other\n    definitions. *)\n" +
        names_text_ +
        "\n(** The mechanism. First the set: the ranges of the variables, the definitions, the "
        "constraints, and more\n    expressions that must have a value. Then the number of "
        "unknowns, the definitions that use them, the\n    equations, more expressions that must "
        "have a value, " +
        std::string(q_.solutions ? "the middles of the variables, and where solutions are\n    "
                                   "looked for: within a radius of a value, for each unknown"
                                 : "the place of the start, and the values of the\n    unknowns "
                                   "there with their radii") +
        ". *)\nDefinition the_closure " + argument() + ": closure := Closure\n  (Question\n";
    for (const auto* list : {&ranges_, &definitions_, &constraints_, &defined_})
      text += "  " + coq_list(*list, "   ") + "\n";
    text += "  [] 0)\n  " + std::to_string(q_.closure->names.size()) + "\n";
    const auto start = starts();
    for (const auto* list : {&further_, &equations_, &also_, &start, &near_})
      text += "  " + coq_list(*list, "   ") + (list == &near_ ? ".\n" : "\n");
    return text;
  }

  void read(const std::string& line) {
    std::string_view rest = line;
    const std::string_view key = take_until(rest, " ");
    if (key == "parameter") {
      read_parameter(rest);
    } else if (key == "constant") {
      const std::string name(take_until(rest, " = "));
      commanded_[name] = actual_[name] = fresh(coq_identifier(name));
      define(actual_[name], constant(name, rest));
    } else if (key == "uncertain") {
      read_uncertain(rest);
    } else if (key == "ball") {
      read_ball(rest);
    } else if (key == "pose") {
      read_pose(rest);
    } else if (key == "unknown") {
      read_unknown(rest);
    } else if (key == "leg") {
      read_square(rest.substr(rest.rfind(" | ") + 3));
    } else if (key == "alpha") {
      threshold_ = coq_expression(rest, {});
    } else if (key == "let") {
      const std::string name(take_until(rest, " = "));
      const std::string expression = coq_expression(rest, actual_);
      actual_[name] = fresh(coq_identifier(name));
      define(actual_[name], expression);
    } else {
      read_list(key, rest);
    }
  }

  [[nodiscard]] std::string constant(const std::string& name, std::string_view value) const {
    const auto found = std::find(piece_names_.begin(), piece_names_.end(), name);
    if (found == piece_names_.end()) return coq_expression(value, of_piece_);
    return "nth " + std::to_string(found - piece_names_.begin()) + " piece no_entry";
  }

  void read_list(std::string_view key, std::string_view rest) {
    if (key == "start")
      starts_.push_back(coq_expression(rest, {}));
    else if (key == "equation")
      equations_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "entry")
      entries_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "scale")
      scales_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "load")
      loads_.push_back({"", coq_expression(rest, actual_)});
    else if (key == "factor")
      factors_.push_back({"", coq_expression(rest, {})});
    else if (key == "limits")
      limits_.push_back(limits_of_row(rest));
    else if (key == "defined")
      (q_.closure ? also_ : defined_).push_back({"", coq_expression(rest, actual_)});
    else if (key == "motion-defined")
      defined_.push_back({"", coq_expression(rest, commanded_)});
    else if (key == "reach")
      constraints_.push_back({"reach", "- (" + coq_expression(rest, commanded_) + ")"});
    else if (key == "constraint")
      constraints_.push_back({"", coq_expression(rest, commanded_)});
  }

  void read_parameter(std::string_view rest) {
    const std::string_view name = take_until(rest, " in ");
    const std::string lower = coq_expression(take_until(rest, " : "), {});
    ranges_.push_back(
        {commanded_.find(name)->second, "(" + lower + ", " + coq_expression(rest, {}) + ")"});
  }

  void read_uncertain(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    const std::string middle = coq_expression(take_until(rest, " +- "), of_piece_);
    const std::string spread = coq_expression(rest, of_piece_);
    ranges_.push_back({actual_[name], "within (" + middle + ") (" + spread + ")"});
    middles_[name] = middle;
    spreads_[name] = spread;
  }

  /// The squared length of a leg is a variable if it varies.
  void read_square(std::string_view rest) {
    const std::string middle = coq_expression(take_until(rest, " +- "), {});
    if (!rest.empty())
      ranges_.push_back({"", "within (" + middle + ") (" + coq_expression(rest, {}) + ")"});
  }

  /// A ball is the constraint that the squared distance from its middle is at most ρ².
  void read_ball(std::string_view names) {
    std::string sum, radius;
    while (!names.empty()) {
      const std::string name(take_until(names, " "));
      sum += (sum.empty() ? "(" : " + (") + actual_[name] + " - (" + middles_[name] + ")) ^ 2";
      radius = spreads_[name];
    }
    constraints_.push_back({"ball", sum + " - (" + radius + ") ^ 2"});
  }

  /// Poses are read before `let`, so a pose is defined by parameters and constants alone.
  void read_pose(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    const std::string expression = coq_expression(take_until(rest, " +- "), pose_scope());
    const bool has_error = with_error_.contains(name);
    if (!commanded_.contains(name)) {
      commanded_[name] = fresh(has_error ? commanded(name) : coq_identifier(name));
      define(commanded_[name], expression);
    }
    actual_[name] = has_error ? fresh(coq_identifier(name)) : commanded_[name];
    if (!has_error) return;
    ranges_.push_back({error_of(name), "within 0 (" + coq_expression(rest, of_piece_) + ")"});
    define(actual_[name], commanded_[name] + " + " + error_of(name));
  }

  /// A pose cannot use an earlier one unless that is a parameter.
  const CoqNames& pose_scope() {
    if (pose_scope_.empty()) {
      pose_scope_ = commanded_;
      pose_scope_.insert(of_piece_.begin(), of_piece_.end());
    }
    return pose_scope_;
  }

  [[nodiscard]] std::string threshold() const {
    return "\n(** The scales of the rows, and the threshold. *)\n"
           "Definition the_scales : list expression :=\n  " +
           coq_list(scales_, "   ") + ".\nDefinition the_threshold : expression := " + threshold_ +
           ".\n";
  }

  /// `least : largest`.
  static CoqItem limits_of_row(std::string_view rest) {
    if (rest == format::kFree) throw Unfinished("there is no theorem about forces without limits");
    const std::string least = coq_expression(take_until(rest, " : "), {});
    return {"", "(" + least + ", " + coq_expression(rest, {}) + ")"};
  }

  [[nodiscard]] std::string limits() const {
    return "\n(** The scales of the rows, the load, and the least and the largest force of each "
           "row. "
           "*)\nDefinition the_scales : list expression :=\n  " +
           coq_list(scales_, "   ") + ".\nDefinition the_load : list expression :=\n  " +
           coq_list(loads_, "   ") +
           ".\nDefinition the_limits : list (expression * expression) :=\n  " +
           coq_list(limits_, "   ") + ".\n";
  }

  [[nodiscard]] std::string factors() const {
    return "\n(** The scales of the rows, and the factors of the columns. *)\n"
           "Definition the_scales : list expression :=\n  " +
           coq_list(scales_, "   ") + ".\nDefinition the_factors : list expression :=\n  " +
           coq_list(factors_, "   ") + ".\n";
  }

  [[nodiscard]] std::string load() const {
    return "\n(** The load, divided by the scale of the row. *)\n"
           "Definition the_load : list expression :=\n  " +
           coq_list(loads_, "   ") + ".\n";
  }

  [[nodiscard]] std::string matrix() const {
    std::vector<CoqItem> rows;
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const auto begin = entries_.begin() + std::ptrdiff_t(i * q_.columns);
      rows.push_back(
          {"", coq_list({begin, begin + std::ptrdiff_t(q_.columns)}, std::string(4, ' '))});
    }
    return coq_list(rows, "   ");
  }

  std::vector<std::string> lines_;
  const Question& q_;
  const std::vector<std::string> piece_names_;
  std::size_t next_name_ = 0, parameters_ = 0;
  bool has_uncertain_ = false;
  std::set<std::string, std::less<>> with_error_;  ///< poses with a control error
  std::set<std::string> declared_;
  CoqNames of_piece_;  ///< the constants of a piece, as what they are
  CoqNames commanded_, actual_, pose_scope_, middles_, spreads_;
  std::string names_text_, threshold_;
  bool has_unknowns_ = false;  ///< what is defined from now on may use them
  std::vector<CoqItem> further_, equations_, also_, near_;  ///< of a closure
  std::vector<std::string> starts_;
  std::vector<CoqItem> ranges_, definitions_, constraints_, defined_, entries_, scales_, loads_,
      factors_, limits_;
};

}  // namespace

CoqQuestion coq_question(std::vector<std::string> lines, const Question& question,
                         const std::vector<std::string>& piece_names) {
  return QuestionWriter(std::move(lines), question, piece_names).result();
}

}  // namespace regulus::verifier
