// SPDX-License-Identifier: GPL-3.0-or-later
// [motion.NAME]: a box of poses, or poses that depend on parameters.
#include <algorithm>
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/reach.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

/// The names of a motion: its parameters, and the declared names if they may be used.
class MotionNames final : public Names {
 public:
  MotionNames(ModelReading& reading, Declarations* declared)
      : declarations_(reading.names), model_(reading.model), declared_(declared) {}

  void add(const MotionParameter& parameter) {
    parameters_.emplace(parameter.name, is_in_degrees(parameter.unit)
                                            ? angle_in_degrees(parameter.symbol)
                                            : variable(parameter.symbol));
  }

  const ParsedExpression* find(const std::string& name, int depth) override {
    if (const auto at = parameters_.find(name); at != parameters_.end()) return &at->second;
    const bool is_known = declared_ != nullptr || is_unknown(name);
    const ParsedExpression* meaning = is_known ? declarations_.find(name, depth) : nullptr;
    if (meaning && depends_on_unknown(model_, *meaning)) unknown_ = name;
    return meaning;
  }

  std::vector<std::string> all() const override {
    std::vector<std::string> names = declared_ ? declared_->all() : std::vector<std::string>{};
    for (const auto& [name, term] : parameters_) names.push_back(name);
    return names;
  }

  /// A name that was found and that depends on unknowns of [closure]; empty: none was.
  [[nodiscard]] const std::string& unknown() const { return unknown_; }

 private:
  [[nodiscard]] bool is_unknown(const std::string& name) const {
    return model_.closure &&
           std::ranges::find(model_.closure->unknowns, name, &PoseParameter::name) !=
               model_.closure->unknowns.end();
  }

  Declarations& declarations_;
  const Model& model_;
  Declarations* declared_;
  std::string unknown_;
  std::map<std::string, ParsedExpression> parameters_;
};

class MotionReader {
 public:
  MotionReader(ModelReading& reading, const TomlEntry& entry)
      : reading_(reading), toml_(reading.toml), entry_(entry) {}

  Motion read() {
    check_keys();
    motion_.name = entry_.key;
    if (toml_.optional(entry_, "waypoints").node) return read_waypoint_motion();
    if (const TomlEntry e = toml_.optional(entry_, "interpolation"); e.node)
      toml_.reject(e, "an interpolation needs way-points", "add waypoints = \"FILE.csv\"");
    if (auto motion = read_motion_by_place(reading_, entry_)) return *std::move(motion);
    read_parameters();
    read_ranges();
    read_pose();
    read_error();
    read_constraints();
    check_dimension();
    read_where();
    read_alpha();
    motion_.must_be_defined = distinct(motion_.must_be_defined);
    return std::move(motion_);
  }

 private:
  /// The equations of [closure] say what its unknowns are.
  void refuse_unknowns(const TomlEntry& table) const {
    if (!reading_.model.closure) return;
    for (const PoseParameter& u : reading_.model.closure->unknowns)
      if (const TomlEntry e = toml_.optional(table, u.name); e.node)
        toml_.reject(
            e,
            in_quotes(u.name) + " is an unknown of [closure], and " + e.path +
                " would give it a value",
            "remove it: a motion gives the pose parameters, here " + enumeration(pose_names()));
  }

  void check_keys() {
    refuse_unknowns(entry_);
    std::vector<std::string> known = pose_names();
    for (const char* key : {"parameters", "constraints", "error", "alpha", "waypoints",
                            "interpolation", "where", "legs", "tool"})
      known.push_back(key);
    (void)toml_.entries(entry_, known);
  }

  /// Reads a motion along the way-points of a file, which is read when the motion is chosen.
  Motion read_waypoint_motion() {
    if (const TomlEntry e = toml_.optional(entry_, "parameters"); e.node)
      toml_.reject(e, "a motion along way-points has no parameters", "remove one of them");
    WaypointSource source;
    source.file = toml_.label(toml_.required(entry_, "waypoints"));
    if (const TomlEntry e = toml_.optional(entry_, "interpolation"); e.node)
      source.interpolation = interpolation(e);
    motion_.waypoints = std::move(source);
    MotionNames names(reading_, nullptr);
    for (const PoseParameter& p : reading_.model.pose) {
      const TomlEntry given = toml_.optional(entry_, p.name);
      if (given.node && given.node->is_array())
        toml_.reject(given, "a motion along way-points has no ranges",
                     "write a value, or a column of the file");
      motion_.pose.push_back(given.node ? pose_expression(given, names, p.unit)
                                        : GiNaC::ex(p.symbol));
    }
    read_error();
    read_constraints();
    read_where();
    read_alpha();
    motion_.must_be_defined = distinct(motion_.must_be_defined);
    return std::move(motion_);
  }

  std::string interpolation(const TomlEntry& entry) const {
    static const std::array<std::string, 3> kKnown = {"linear", "cubic", "hermite"};
    const std::string word = toml_.text(entry, alternatives(kKnown));
    if (std::ranges::find(kKnown, word) == kKnown.end()) toml_.refuse(entry, alternatives(kKnown));
    return word;
  }

  std::vector<std::string> pose_names() const {
    std::vector<std::string> names;
    for (const PoseParameter& p : reading_.model.pose) names.push_back(p.name);
    return names;
  }

  void read_parameters() {
    const TomlEntry parameters = toml_.optional(entry_, "parameters");
    if (!parameters.node) return;
    for (const TomlEntry& parameter : toml_.entries(parameters)) {
      require_free_name(parameter.key, toml_.place(parameter));
      if (reading_.names.find(parameter.key, 0))
        toml_.reject(parameter,
                     in_quotes(parameter.key) + " is declared twice, here as " + parameter.path,
                     "choose another name");
      motion_.parameters.push_back(
          {GiNaC::realsymbol(parameter.key), parameter.key, "1", range(parameter, "1")});
    }
    if (motion_.parameters.empty())
      toml_.refuse(parameters, "no parameter in " + parameters.path,
                   "at least one, with its range");
  }

  /// Pose parameters with a range are motion parameters themselves.
  void read_ranges() {
    for (const PoseParameter& p : reading_.model.pose) {
      const TomlEntry given = toml_.required(entry_, p.name);
      if (given.node->is_array())
        motion_.parameters.push_back({p.symbol, p.name, p.unit, range(given, p.unit)});
    }
  }

  /// A parameter that only constraints contain, the size of a shape for example, is no dimension of
  /// the motion.
  void check_dimension() const {
    const auto has = [](const std::vector<GiNaC::ex>& expressions, const GiNaC::ex& symbol) {
      return std::ranges::any_of(expressions, [&](const GiNaC::ex& e) { return e.has(symbol); });
    };
    const auto is_size = [&](const MotionParameter& p) {
      return !has(motion_.pose, p.symbol) && has(motion_.constraints, p.symbol);
    };
    const std::size_t sizes =
        static_cast<std::size_t>(std::ranges::count_if(motion_.parameters, is_size));
    const std::size_t dimension = motion_.parameters.size() - sizes;
    if (dimension > reading_.model.pose.size())
      toml_.refuse(
          entry_, std::to_string(dimension) + " parameters in " + entry_.path,
          "at most as many as pose parameters, " + std::to_string(reading_.model.pose.size()));
  }

  void read_pose() {
    MotionNames names(reading_, nullptr);
    for (const MotionParameter& parameter : motion_.parameters) names.add(parameter);
    for (const PoseParameter& p : reading_.model.pose) {
      const TomlEntry given = toml_.required(entry_, p.name);
      motion_.pose.push_back(given.node->is_array() ? GiNaC::ex(p.symbol)
                                                    : pose_expression(given, names, p.unit));
    }
  }

  GiNaC::ex pose_expression(const TomlEntry& given, MotionNames& names, const std::string& unit) {
    const ParsedExpression term = expression(given, names, number_unit(unit));
    if (term.constant && !approx_value(term.value))
      toml_.refuse(given, "a finite number, a range or an expression");
    if (term.constant)
      warn_about_angle(motion_.warnings, {term.value, term.value}, unit, toml_.place(given));
    return recorded(term, given);
  }

  void read_error() {
    motion_.error.assign(reading_.model.pose.size(), 0);
    const TomlEntry error = toml_.optional(entry_, "error");
    if (!error.node) return;
    refuse_unknowns(error);
    const std::vector<std::string> names = pose_names();
    for (const TomlEntry& given : toml_.entries(error, names)) {
      const auto at = std::ranges::find(names, given.key) - names.begin();
      const std::size_t i = static_cast<std::size_t>(at);
      const std::string& unit = reading_.model.pose[i].unit;
      motion_.error[i] = nonnegative(given, number_unit(unit));
      warn_about_angle(motion_.warnings, {-motion_.error[i], motion_.error[i]}, unit,
                       toml_.place(given));
    }
  }

  void read_constraints() {
    MotionNames names(reading_, &reading_.names);
    for (const MotionParameter& parameter : motion_.parameters) names.add(parameter);
    const TomlEntry constraints = toml_.optional(entry_, "constraints");
    if (!constraints.node) return;
    for (const TomlEntry& given : toml_.elements(constraints, "a list of expressions, each ≤ 0"))
      motion_.constraints.push_back(recorded(expression(given, names, NumberUnit::kPlain), given));
  }

  void read_where() {
    const TomlEntry given = toml_.optional(entry_, "where");
    if (!given.node) return;
    if (reading_.model.closure)
      toml_.reject(given, "a motion of a model with [closure] has no where",
                   "remove it: the claim says that the mechanism reaches all its poses");
    motion_.where = choice(
        toml_, given,
        std::array{std::pair{std::string(name(Where::kReachable)), Where::kReachable},
                   std::pair{std::string(name(Where::kWithinRanges)), Where::kWithinRanges}});
    if (motion_.where == Where::kWithinRanges) {
      if (reading_.joint_ranges.empty())
        toml_.reject(given, "no actuated joint has a range", "give legs a range, in [legs]");
      for (const ParsedExpression& range : reading_.joint_ranges)
        motion_.constraints.push_back(recorded(range, given));
    }
    restrict_to_reach(reading_.model, motion_);
  }

  void read_alpha() {
    const TomlEntry alpha = toml_.optional(entry_, "alpha");
    if (alpha.node) motion_.alpha = nonnegative(alpha, NumberUnit::kPlain);
  }

  Range range(const TomlEntry& entry, const std::string& unit) {
    const auto ends = toml_.elements(entry, "a range [lower, upper]");
    if (ends.size() != 2)
      toml_.refuse(entry, std::to_string(ends.size()) + " numbers in " + entry.path,
                   "a range [lower, upper]");
    const ParsedExpression lo = toml_.constant(ends[0], number_unit(unit));
    const ParsedExpression hi = toml_.constant(ends[1], number_unit(unit));
    append(motion_.must_be_defined, lo.must_be_defined);
    append(motion_.must_be_defined, hi.must_be_defined);
    const Range result = checked_range(lo, hi, toml_.place(entry));
    warn_about_angle(motion_.warnings, result, unit, toml_.place(entry),
                     reading_.model.arm != nullptr);
    return result;
  }

  GiNaC::ex nonnegative(const TomlEntry& entry, NumberUnit unit) {
    const ParsedExpression term = toml_.constant(entry, unit);
    append(motion_.must_be_defined, term.must_be_defined);
    return checked_nonnegative(term, toml_.place(entry));
  }

  ParsedExpression expression(const TomlEntry& given, MotionNames& names, NumberUnit unit) {
    ParsedExpression term = toml_.expression(given, names, unit);
    if (!names.unknown().empty())
      toml_.reject(given,
                   given.path + " uses " + in_quotes(names.unknown()) +
                       ", which depends on the unknowns of [closure]",
                   "write an expression of pose parameters and constants: the equations say what "
                   "the unknowns are");
    return term;
  }

  GiNaC::ex recorded(const ParsedExpression& term, const TomlEntry& entry) {
    reading_.count(term, entry);
    append(motion_.must_be_defined, term.must_be_defined);
    return term.value;
  }

  ModelReading& reading_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  Motion motion_;
};

}  // namespace

void read_motions(ModelReading& reading, const TomlEntry& motions) {
  for (const TomlEntry& entry : reading.toml.entries(motions)) {
    for (const Motion& known : reading.model.motions)
      if (known.name == entry.key)
        reading.toml.reject(
            entry, "the ranges of the joints already make a motion " + in_quotes(known.name),
            "choose another name");
    reading.model.motions.push_back(MotionReader(reading, entry).read());
  }
  if (reading.model.motions.empty())
    reading.toml.refuse(motions, "no motion", "at least one table [motion.NAME]");
}

}  // namespace regulus::detail
