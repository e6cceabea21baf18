// SPDX-License-Identifier: Apache-2.0
// [legs]: a row for each motor, then one for each moment or force of a constraint, in the order of
// the legs.
#include "runtime/verifier/model/legs_reading.hpp"

#include <algorithm>

#include "runtime/verifier/model/leg_rows.hpp"
#include "runtime/verifier/model/orientation_reading.hpp"
#include "runtime/verifier/model/section_values.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kAxisLetters = "xyz", kLegWord = "legs.leg[";

/// Quantities of one kind: the letters of their names.
struct LegGroup {
  std::string letters;
  SectionTolerance tolerance;
};
const LegGroup kBase{"a", {"legs.base_tolerance", "tolerance base"}};
const LegGroup kPlatform{"b", {"legs.platform_tolerance", "tolerance platform"}};
const LegGroup kCranks{"crank_", {"legs.crank_tolerance", "tolerance cranks"}};
const LegGroup kRods{"rod_", {"legs.rod_tolerance", "tolerance rods"}};
const LegGroup kAxisGroup{"n", {"legs.axis_tolerance", "tolerance axes"}};
const LegGroup kHinges{"h", {"legs.axis_tolerance", "tolerance axes"}};

class LegsReading final : public SectionReading {
 public:
  explicit LegsReading(const WrittenValues& values) : values_(values) {
    for (auto at = values.lower_bound(kLegWord);
         at != values.end() && at->first.starts_with(kLegWord); ++at)
      count_ = std::max(count_, std::size_t(std::atoi(at->first.c_str() + kLegWord.size())) + 1);
    is_planar_ = count_ > 0 && type_of(0).is_planar;
    orientation_ = text("legs.orientation", is_planar_ ? kAngleInPlane : "");
    is_in_degrees_ = text("legs.angle_unit", "rad") != "rad";
  }

  [[nodiscard]] std::vector<SectionPose> pose() const override {
    const std::string unit = text("legs.unit", "1");
    std::vector<SectionPose> result;
    for (std::size_t i = 0; i < axes(); ++i)
      result.push_back({std::string(1, kAxisLetters[i]), unit});
    for (const std::string& name : angles())
      result.push_back({name, orientation_ == "quaternion" ? "1" : text("legs.angle_unit", "rad")});
    return result;
  }

  [[nodiscard]] NodeId name(std::string_view name, const Scope& scope,
                            SectionComparer& comparer) override {
    const std::size_t digits = name.find_first_of("0123456789");
    if (digits == std::string_view::npos) return kNoNode;
    const std::size_t end = std::min(name.find('_', digits), name.size());
    const std::string_view before = name.substr(0, digits), after = name.substr(end);
    const int number = std::atoi(std::string(name.substr(digits)).c_str());
    if (number < 1 || std::size_t(number) > count_) return kNoNode;
    const std::size_t axis = after.size() == 2 ? kAxisLetters.find(after[1]) : kAxisLetters.npos;
    if (!after.empty() && axis >= axes()) return kNoNode;
    GraphAlgebra algebra(comparer.question().graph);
    const LegValues& leg = values_of(std::size_t(number) - 1, comparer, algebra);
    LegAtPose at = at_pose(leg, scope, algebra);
    if (after.empty()) {
      if (before == "rho_") return at.rho;
      if (before == "s_") return at.place;
      if (before == "off_") return at.off;
      return before == "w" ? at.w : kNoNode;
    }
    if (before == "r" && orientation_ != "point") return at.r[axis];
    if (before == "e") return at.e[axis];
    return before == "d" && leg.kind != LegKind::kTelescopic ? at.d[axis] : kNoNode;
  }

  [[nodiscard]] std::optional<std::size_t> motors() const override {
    std::size_t motors = 0;
    for (std::size_t i = 0; i < count_; ++i) motors += actuated(i) != 0;
    return motors;
  }

  [[nodiscard]] std::optional<std::vector<NodeId>> range_constraints(
      SectionComparer& comparer) override {
    GraphAlgebra algebra(comparer.question().graph);
    std::vector<NodeId> result;
    for (std::size_t i = 0; i < count_; ++i) {
      const LegValues& leg = values_of(i, comparer, algebra);
      if (!leg.range) continue;
      for (const NodeId one : at_pose(leg, comparer.question().commanded, algebra).range())
        result.push_back(one);
    }
    return result;
  }

  void compare(SectionComparer& comparer) override {
    GraphAlgebra algebra(comparer.question().graph);
    const Question& q = comparer.question();
    std::size_t row = 0;
    for (const bool of_motors : {true, false})
      for (std::size_t i = 0; i < count_; ++i) {
        const LegValues& leg = values_of(i, comparer, algebra);
        const bool is_constrained = leg.keeps_orientation || leg.is_hinged;
        if (of_motors ? leg.actuated == 0 : !is_constrained) continue;
        LegAtPose at = at_pose(leg, q.actual, algebra);
        const LegRow one = of_motors ? at.motor() : constraint(leg, at, algebra);
        compare_row(comparer, {place(i), 0, of_motors ? "a motor's row" : "a constraint"}, row++,
                    one);
      }
    if (row != q.rows)
      comparer.refuse({"legs", 0, std::to_string(row) + " rows"}, std::to_string(q.rows) + " rows");
  }

  [[nodiscard]] std::vector<SectionLeg> telescopic_legs(SectionComparer& comparer) override {
    std::vector<SectionLeg> legs;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::string_view name = type_of(i).name;
      const std::string driven(text(shared(i, "actuated"), "2"));
      if ((name != "RPR" && name != "UPS" && name != "SPS") || driven != "2")
        throw Unfinished("the legs of " + place(i) + " are not of variable length");
      SectionValues section(comparer, is_in_degrees_);
      legs.push_back({section.middle(place(i) + ".base", axes()),
                      section.middle(place(i) + ".platform", axes())});
    }
    return legs;
  }

  [[nodiscard]] std::vector<SectionLeg> uncertain_legs(SectionComparer& comparer) override {
    GraphAlgebra algebra(comparer.question().graph);
    std::vector<SectionLeg> legs;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::string number = std::to_string(i + 1), a = place(i) + ".base",
                        b = place(i) + ".platform";
      legs.push_back({{a, point(a, number, kBase, comparer, algebra)},
                      {b, point(b, number, kPlatform, comparer, algebra)}});
    }
    return legs;
  }

  [[nodiscard]] NodeId squared_length(const SectionLeg& leg, const Scope& pose,
                                      SectionComparer& comparer) override {
    return squared_length_at(leg, orientation_, is_in_degrees_, pose, comparer.question().graph);
  }

 private:
  static LegRow constraint(const LegValues& leg, LegAtPose& at, GraphAlgebra& algebra) {
    if (leg.is_hinged) return at.hinge_force();
    return {algebra.zero(), at.moment(), algebra.number(1)};
  }

  [[nodiscard]] std::string text(const std::string& place, const std::string& otherwise) const {
    const auto found = values_.find(place);
    return found == values_.end() ? otherwise : found->second.text;
  }
  static std::string place(std::size_t leg) {
    return std::string(kLegWord) + std::to_string(leg) + ']';
  }
  [[nodiscard]] bool has(const std::string& place) const {
    const auto at = values_.lower_bound(place);
    const auto below = [&](char next) { return at->first.starts_with(place + next); };
    return at != values_.end() && (at->first == place || below('[') || below('.'));
  }
  /// Returns the place of a key of a leg, which may stand in [legs].
  [[nodiscard]] std::string shared(std::size_t leg, const std::string& key) const {
    const std::string own = place(leg) + '.' + key;
    return has(own) ? own : "legs." + key;
  }
  [[nodiscard]] const LegType& type_of(std::size_t leg) const {
    const std::string word = text(shared(leg, "type"), "");
    const LegType* const type = find_leg_type(word);
    if (type == nullptr) throw Unfinished("the leg type '" + word + "' is not known");
    return *type;
  }
  /// Returns the number of the driven joint, from the base; 0: none.
  [[nodiscard]] int actuated(std::size_t leg) const {
    const std::string driven = text(shared(leg, "actuated"), "");
    if (driven.empty()) return type_of(leg).kind == LegKind::kTelescopic ? 2 : 1;
    return driven == "none" ? 0 : std::atoi(driven.c_str());
  }
  [[nodiscard]] std::size_t axes() const { return is_planar_ ? 2 : 3; }
  [[nodiscard]] std::vector<std::string> angles() const { return orientation_names(orientation_); }

  static std::string element(const std::string& list, std::size_t i) {
    return list + '[' + std::to_string(i) + ']';
  }

  NodeId written(const std::string& place, SectionComparer& comparer) const {
    return SectionValues(comparer, is_in_degrees_).constant(place);
  }

  /// Returns true if the value has no names but those of exact constants.
  bool is_number(const std::string& place, SectionComparer& comparer) {
    if (!has_exact_constants_) read_exact_constants(comparer);
    has_exact_constants_ = true;
    return number_at(place, exact_constants_, comparer) != kNoNode;
  }

  static NodeId number_at(const std::string& place, const Scope& scope, SectionComparer& comparer) {
    if (!comparer.values().contains(place)) return kNoNode;
    try {
      return comparer.expression_at(place, scope);
    } catch (const Unfinished&) {
      return kNoNode;
    }
  }

  /// The constants of [geometry] without a tolerance and without a group.
  void read_exact_constants(SectionComparer& comparer) {
    constexpr std::string_view kTable = "geometry.";
    for (auto at = values_.lower_bound(kTable);
         at != values_.end() && at->first.starts_with(kTable); ++at) {
      const std::string place = at->first.substr(0, at->first.find_first_of(".[", kTable.size()));
      const std::size_t list = at->first.find('[');
      if (at->first == place + ".tolerance" || at->first == place + ".radius") continue;
      std::string name = place.substr(kTable.size());
      if (list != std::string::npos)
        name += '_' + std::to_string(std::atoi(at->first.c_str() + list + 1) + 1);
      const NodeId value =
          is_exact_constant(place, comparer) ? number_at(at->first, no_names_, comparer) : kNoNode;
      if (value != kNoNode) exact_constants_.emplace(std::move(name), value);
    }
  }

  bool is_exact_constant(const std::string& place, SectionComparer& comparer) {
    const Graph& graph = comparer.question().graph;
    for (const char* key : {".tolerance", ".radius"}) {
      if (!values_.contains(place + key)) continue;
      const NodeId spread = number_at(place + key, no_names_, comparer);
      if (spread == kNoNode || !is_zero_number(graph, spread)) return false;
    }
    return !values_.contains(place + ".group");
  }

  NodeId quantity(const std::string& place, const std::string& name, const LegGroup& group,
                  SectionComparer& comparer, std::vector<std::string>* names = nullptr) const {
    const SectionQuantity written = section_quantity(values_, place, group.tolerance);
    return SectionValues(comparer, is_in_degrees_)
        .quantity(written.value, name, written.tolerance, names);
  }

  VectorNodes point(const std::string& list, const std::string& number, const LegGroup& group,
                    SectionComparer& comparer, GraphAlgebra& algebra) {
    const SectionQuantity written = section_quantity(values_, list, group.tolerance,
                                                     text("legs.tolerance_shape", "box") == "ball");
    VectorNodes result = algebra.zero();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < axes(); ++i) {
      const std::string name = group.letters + number + '_' + kAxisLetters[i];
      result[i] = SectionValues(comparer, is_in_degrees_)
                      .quantity(element(written.value, i), name, written.tolerance, &names);
    }
    if (!names.empty() && written.is_ball)
      comparer.expect_ball(comparer.place_of(written.tolerance.key), names);
    return result;
  }

  VectorNodes numbers(const std::string& list, SectionComparer& comparer, GraphAlgebra& algebra) {
    VectorNodes result = algebra.zero();
    for (std::size_t i = 0; i < axes(); ++i) result[i] = written(element(list, i), comparer);
    return result;
  }

  /// An axis of numbers without a tolerance is taken by its direction alone.
  bool is_exact_axis(const std::string& list, SectionComparer& comparer) {
    bool is_exact = !values_.contains(kAxisGroup.tolerance.key);
    for (std::size_t i = 0; i < axes(); ++i)
      is_exact = is_exact && is_number(element(list, i), comparer);
    return is_exact;
  }

  VectorNodes axis(const std::string& list, const std::string& number, const LegGroup& group,
                   SectionComparer& comparer, GraphAlgebra& algebra) {
    if (is_exact_axis(list, comparer)) return algebra.unit(numbers(list, comparer, algebra));
    return point(list, number, group, comparer, algebra);
  }

  const LegValues& values_of(std::size_t index, SectionComparer& comparer, GraphAlgebra& algebra) {
    const auto known = legs_.find(index);
    if (known != legs_.end()) return known->second;
    if (!open_.insert(index).second) throw Unfinished(place(index) + " depends on itself");
    const LegType& type = type_of(index);
    if (type.is_planar != is_planar_) throw Unfinished("legs in the plane and in space");
    const std::string number = std::to_string(index + 1), own = place(index) + '.';
    LegValues leg;
    leg.kind = type.kind;
    leg.is_planar = type.is_planar;
    leg.keeps_orientation = type.keeps_orientation;
    leg.is_hinged = type.is_hinged;
    leg.actuated = actuated(index);
    leg.base = point(own + "base", number, kBase, comparer, algebra);
    leg.platform = orientation_ == "point"
                       ? algebra.zero()
                       : point(own + "platform", number, kPlatform, comparer, algebra);
    if (type.kind == LegKind::kCrank)
      leg.crank = quantity(shared(index, "crank"), "crank_" + number, kCranks, comparer);
    if (type.kind != LegKind::kTelescopic)
      leg.rod = quantity(shared(index, "rod"), "rod_" + number, kRods, comparer);
    read_directions(leg, index, number, comparer, algebra);
    leg.mode = text(shared(index, "mode"), "+") == "+";
    read_range(leg, index, comparer, algebra);
    return legs_.emplace(index, leg).first->second;
  }

  void read_directions(LegValues& leg, std::size_t index, const std::string& number,
                       SectionComparer& comparer, GraphAlgebra& algebra) {
    const bool crank = leg.kind == LegKind::kCrank, slider = leg.kind == LegKind::kSlider;
    leg.axis = {algebra.number(0), algebra.number(0), algebra.number(1)};
    leg.size = algebra.number(1);
    const std::string list = shared(index, "axis"), hinge = shared(index, "hinge");
    if (slider || (!leg.is_planar && (crank || leg.keeps_orientation))) {
      leg.axis = axis(list, number, kAxisGroup, comparer, algebra);
      if (!is_exact_axis(list, comparer)) leg.size = algebra.dot(leg.axis, leg.axis);
    }
    if (leg.is_hinged) {
      leg.hinge = axis(hinge, number, kHinges, comparer, algebra);
      leg.has_exact_directions =
          slider && is_exact_axis(list, comparer) && is_exact_axis(hinge, comparer);
    }
    if (!leg.keeps_orientation) return;
    leg.bar = leg.axis;
    if (slider) leg.bar = algebra.unit(numbers(shared(index, "bar"), comparer, algebra));
  }

  void read_range(LegValues& leg, std::size_t index, SectionComparer& comparer,
                  GraphAlgebra& algebra) {
    const std::string list = shared(index, "range");
    if (!has(list) || leg.actuated == 0) return;
    const bool is_length = leg.kind == LegKind::kTelescopic
                               ? leg.actuated == 2
                               : leg.kind == LegKind::kSlider && leg.actuated == 1;
    SectionValues section(comparer, is_in_degrees_);
    const auto end = [&](std::size_t i) {
      return is_length ? section.constant(element(list, i)) : section.angle(element(list, i));
    };
    leg.range.emplace(end(0), end(1));
    if (leg.kind == LegKind::kCrank && !leg.is_planar)
      leg.zero = algebra.unit(numbers(shared(index, "zero"), comparer, algebra));
  }

  static NodeId pose_of(const Scope& scope, const std::string& name) {
    const auto found = scope.find(name);
    if (found == scope.end()) throw Unfinished("the certificate has no pose parameter " + name);
    return found->second;
  }

  MatrixNodes rotation(const Scope& scope, GraphAlgebra& algebra) const {
    const OrientationNodes R = read_orientation(orientation_, scope, is_in_degrees_, algebra);
    MatrixNodes result = R.scaled;
    for (VectorNodes& row : result)
      for (NodeId& entry : row) entry = algebra.quotient(entry, R.size);
    return result;
  }

  LegAtPose at_pose(const LegValues& leg, const Scope& scope, GraphAlgebra& algebra) const {
    VectorNodes position = algebra.zero();
    for (std::size_t i = 0; i < axes(); ++i)
      position[i] = pose_of(scope, std::string(1, kAxisLetters[i]));
    return LegAtPose(leg, position, rotation(scope, algebra), algebra);
  }

  void compare_row(SectionComparer& comparer, const FilePlace& from, std::size_t row,
                   const LegRow& one) {
    std::vector<NodeId> entries(one.force.begin(), one.force.begin() + std::ptrdiff_t(axes()));
    if (orientation_ != "point")
      entries.insert(entries.end(), one.moment.begin() + (is_planar_ ? 2 : 0), one.moment.end());
    const Question& q = comparer.question();
    if (entries.size() != q.columns || row >= q.rows)
      comparer.refuse(from, "a matrix of another shape");
    for (std::size_t j = 0; j < entries.size(); ++j)
      comparer.compare(from, entries[j], "entry " + std::to_string(row * q.columns + j));
    comparer.compare(from, one.scale, "scale " + std::to_string(row));
    comparer.expect_defined(from, one.scale);
  }

  const WrittenValues& values_;
  const Scope no_names_;
  Scope exact_constants_;
  bool has_exact_constants_ = false;
  std::size_t count_ = 0;
  bool is_planar_ = false, is_in_degrees_ = false;
  std::string orientation_;
  std::map<std::size_t, LegValues> legs_;
  std::set<std::size_t> open_;  ///< legs whose values have been asked for
};

}  // namespace

std::unique_ptr<SectionReading> legs_reading(const WrittenValues& values) {
  return std::make_unique<LegsReading>(values);
}

}  // namespace regulus::verifier
