// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/model_comparison.hpp"

#include <algorithm>

#include "runtime/certificate/verifier/algebra.hpp"
#include "runtime/certificate/verifier/evaluation.hpp"
#include "runtime/certificate/verifier/load_comparison.hpp"
#include "runtime/certificate/verifier/model_expression.hpp"
#include "runtime/certificate/verifier/model_file.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProducts = 1 << 16;  ///< for one expression
constexpr long kBits = 2048;                  ///< of values at points, if algebra does not decide
constexpr int kPoints = 4;
constexpr std::size_t kLongestText = 120;

enum class Equality { kEqual, kAtPoints, kDifferent, kUnknown };

class Comparison {
 public:
  Comparison(Question& q, const Options& options, Verification& result,
             const std::vector<std::string>& compared)
      : q_(q),
        options_(options),
        result_(result),
        values_(read_model_values(options.model_text)),
        degrees_(poses_in_degrees(values_)),
        compared_(compared.begin(), compared.end()),
        used_(compared_) {}

  void run() {
    compare_geometry();
    compare_gough();
    compare_legs();
    compare_matrix();
    compare_motion();
    if (q_.load || q_.quantity) compare_load_lines();
    list_uncompared();
  }

 private:
  /// Returns the expression of a value in the file, whose names are those of `scope` and of [let].
  NodeId node_of(const WrittenValue& written, const Scope& scope, bool is_in_degrees) {
    if (!written.is_string) return number_of_toml(written.text, q_.graph);
    const NameMeaning meaning = [&](std::string_view name) -> NodeId {
      const auto known = scope.find(name);
      if (known != scope.end()) return known->second;
      return let(name, scope);
    };
    return parse_model_expression(written.text, meaning, q_.graph, depth_, degrees_, is_in_degrees);
  }

  NodeId let(std::string_view name, const Scope& scope) {
    auto& known = &scope == &q_.actual ? actual_lets_ : commanded_lets_;
    if (const auto found = known.find(name); found != known.end()) return found->second;
    const auto written = values_.find("let." + std::string(name));
    if (written == values_.end())
      throw Unfinished("the name " + std::string(name) + " is not known");
    if (++lets_ > kMostLets) throw Unfinished("[let] is nested too deeply");
    const NodeId result = node_of(written->second, scope, false);
    --lets_;
    known.emplace(name, result);
    return result;
  }

  /// `option`: the name of the option that may have changed the value; "" for none.
  void compare(const std::string& place, const std::string& stated, const Scope& scope,
               const std::string& option = "") {
    const auto written = values_.find(place);
    if (written == values_.end()) return;
    const auto found = q_.stated.find(stated);
    used_.insert(stated);
    NodeId node = kNoNode;
    try {
      node = node_of(written->second, scope, is_number_of_degrees(stated));
    } catch (const Rejection& why) {
      return leave_out(place, written->second, why.what());
    } catch (const Unfinished& why) {
      return leave_out(place, written->second, why.what());
    }
    if (found == q_.stated.end()) {
      // A spread that is not stated is 0.
      const NodeId zero = q_.graph.number("0");
      if (equality(node, zero) == Equality::kDifferent)
        differ(place, written->second, {zero, 0, "0"}, option);
      ++result_.numbers;
      return;
    }
    switch (equality(node, found->second.node)) {
      case Equality::kDifferent:
        return differ(place, written->second, found->second, option);
      case Equality::kUnknown:
        return leave_out(place, written->second, "the two expressions have no value at any point");
      default:
        ++result_.numbers;
    }
  }

  /// True for the range, the value and the error of a pose parameter in degrees.
  [[nodiscard]] bool is_number_of_degrees(const std::string& stated) const {
    const std::string kind = stated.substr(0, stated.find(' ')),
                      name = stated.substr(stated.find(' ') + 1);
    return (kind == "lower" || kind == "upper" || kind == "pose" || kind == "error") &&
           degrees_.contains(name);
  }

  static std::string shortened(const std::string& text) {
    return text.size() <= kLongestText ? text : text.substr(0, kLongestText) + "…";
  }

  void leave_out(const std::string& place, const WrittenValue& written, const std::string& why) {
    result_.uncompared.push_back(place + ", line " + std::to_string(written.line) + ": " + why);
  }

  void differ(const std::string& place, const WrittenValue& written, const StatedValue& stated,
              const std::string& option) {
    std::string text = "line " + std::to_string(written.line) + ": " + place + " is '" +
                       shortened(written.text) + "', but the certificate has '" +
                       shortened(stated.text) + '\'';
    if (stated.line > 0) text += " in line " + std::to_string(stated.line);
    const bool is_allowed =
        !option.empty() && (options_.all_overridden || options_.overridden.contains(option));
    if (!is_allowed)
      throw OtherModel("the certificate is not about " + options_.model_name + ": " + text);
    result_.differences.push_back(text);
  }

  Equality equality(NodeId a, NodeId b) {
    if (a == b) return Equality::kEqual;
    const NodeId difference = q_.graph.add(Op::kSubtract, a, b);
    AlgebraBudget budget(kProducts);
    const std::vector<NodeId> none;
    try {
      Algebra algebra(q_.graph, none, Algebra::Form::kFull, budget);
      algebra.find_units({difference});
      const Polynomial& p = algebra.of(difference);
      if (algebra.vanishes(p)) return Equality::kEqual;
      if (p.is_constant()) return Equality::kDifferent;
    } catch (const TooLarge&) {
      return at_points(difference);
    }
    return at_points(difference);
  }

  /// Returns kDifferent if they differ at some point; otherwise they agree to many digits at a few.
  Equality at_points(NodeId difference) {
    Equality result = Equality::kUnknown;
    for (int number = 0; number < kPoints; ++number) {
      const auto value = evaluate(q_.graph, {difference}, point(number), kBits);
      if (!value) continue;
      if (arb_is_nonzero((*value)[0].get()) != 0 || arb_contains_zero((*value)[0].get()) == 0)
        return Equality::kDifferent;
      result = Equality::kAtPoints;
    }
    return result;
  }

  /// Returns some point of the ranges.
  std::vector<Ball> point(int number) {
    std::vector<Ball> result(q_.variables.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
      const Variable& v = q_.variables[k];
      const auto ends = evaluate(q_.graph, {v.lo, v.hi}, {}, kBits);
      if (!ends) continue;
      Ball& x = result[k];
      arb_sub(x.get(), (*ends)[1].get(), (*ends)[0].get(), kBits);
      arb_mul_ui(x.get(), x.get(), ulong(13 + 29 * number + 17 * int(k)) % 97, kBits);
      arb_div_ui(x.get(), x.get(), 97, kBits);
      arb_add(x.get(), x.get(), (*ends)[0].get(), kBits);
      arb_get_mid_arb(x.get(), x.get());
    }
    return result;
  }

  /// Compares the value and the spread of a constant, or of the coordinates of a point.
  void compare_constant(const std::string& place, const std::string& name) {
    const Scope none;
    compare(place, "value " + name, none);
    const std::string list = place + '[';
    for (auto at = values_.lower_bound(list); at != values_.end() && at->first.starts_with(list);
         ++at) {
      const std::string digits = at->first.substr(list.size(), at->first.size() - list.size() - 1);
      if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 6)
        continue;
      compare(at->first, "value " + name + '_' + std::to_string(std::stoul(digits) + 1), none);
    }
  }

  void compare_spread(const std::string& place, const std::string& name,
                      const std::string& option) {
    const Scope none;
    if (q_.stated.contains("value " + name)) return compare(place, "spread " + name, none, option);
    const std::string coordinate = "value " + name + '_';
    std::vector<std::string> names;
    for (auto at = q_.stated.lower_bound(coordinate);
         at != q_.stated.end() && at->first.starts_with(coordinate); ++at)
      names.push_back(at->first.substr(std::string_view("value ").size()));
    for (const std::string& one : names) compare(place, "spread " + one, none, option);
  }

  void compare_geometry() {
    constexpr std::string_view kTable = "geometry.";
    std::set<std::string> names;
    for (auto at = values_.lower_bound(kTable);
         at != values_.end() && at->first.starts_with(kTable); ++at) {
      const std::string rest = at->first.substr(kTable.size());
      names.insert(rest.substr(0, rest.find_first_of(".[")));
    }
    for (const std::string& name : names) {
      const std::string place = std::string(kTable) + name;
      compare_constant(place, name);
      compare_constant(place + ".value", name);
      const auto group = values_.find(place + ".group");
      const std::string option = group == values_.end() ? "" : "tolerance " + group->second.text;
      compare_spread(place + ".tolerance", name, option);
      compare_spread(place + ".radius", name, option);
    }
  }

  void compare_gough() {
    const Scope none;
    for (const auto& [table, letter] : {std::pair("base", 'a'), std::pair("platform", 'b')})
      for (std::size_t leg = 0; leg < 6; ++leg)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::string name =
              std::string(1, letter) + std::to_string(leg + 1) + '_' + "xyz"[axis];
          const std::string place = std::string("gough.") + table;
          compare(place + '[' + std::to_string(leg) + "][" + std::to_string(axis) + ']',
                  "value " + name, none);
          compare(place + "_tolerance", "spread " + name, none, std::string("tolerance ") + table);
        }
  }

  /// Compares the numbers of legs. An expression of names has no value of its own in the certificate.
  void compare_legs() {
    for (std::size_t leg = 0; leg < format::kMostVariables; ++leg) {
      const std::string place = "legs.leg[" + std::to_string(leg) + "].";
      const std::string number = std::to_string(leg + 1);
      for (const auto& [key, letter] :
           {std::pair("base", "a"), std::pair("platform", "b"), std::pair("axis", "n")})
        for (std::size_t axis = 0; axis < 3; ++axis)
          compare_length(place, key + ('[' + std::to_string(axis) + ']'),
                         letter + number + '_' + "xyz"[axis], key);
      compare_length(place, "crank", "crank_" + number, "crank");
      compare_length(place, "rod", "rod_" + number, "rod");
    }
  }

  /// The key may stand in [legs], for all legs.
  void compare_length(const std::string& leg, const std::string& key, const std::string& name,
                      const std::string& kind) {
    if (!q_.stated.contains("value " + name)) return;
    const Scope none;
    const bool is_own = values_.contains(leg + key);
    compare(is_own ? leg + key : "legs." + key, "value " + name, none);
    const std::string group = kind == "base" || kind == "platform" ? kind
                              : kind == "axis"                     ? "axes"
                                                                   : kind + 's';
    compare("legs." + kind + "_tolerance", "spread " + name, none, "tolerance " + group);
  }

  void compare_matrix() {
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      compare("matrix.rows[" + std::to_string(e / q_.columns) + "][" +
                  std::to_string(e % q_.columns) + ']',
              "entry " + std::to_string(e), q_.actual);
    for (std::size_t i = 0; i < q_.rows; ++i)
      if (q_.stated.contains("scale 0"))
        compare("matrix.row_scale[" + std::to_string(i) + ']', "scale " + std::to_string(i),
                q_.actual);
  }

  void compare_motion() {
    const std::string motion = "motion." + q_.motion + '.';
    const Scope none;
    bool is_within_reach = false;
    for (auto at = values_.lower_bound(motion);
         at != values_.end() && at->first.starts_with(motion); ++at) {
      const std::string rest = at->first.substr(motion.size());
      if (rest == "waypoints" || rest == "interpolation") continue;  // waypoints.hpp
      if (rest == "where")
        is_within_reach = true;
      else if (rest == "alpha" && (q_.load || q_.quantity))
        continue;  // forces and bounds have no threshold
      else if (rest == "alpha")
        compare(at->first, "alpha ", none, "alpha");
      else if (rest.starts_with("error."))
        compare(at->first, "error " + rest.substr(6), none, "tube " + rest.substr(6));
      else if (rest.starts_with("constraints["))
        compare(at->first, "constraint " + rest.substr(12, rest.size() - 13), q_.commanded);
      else if (!is_replaced(rest))
        compare_range(at->first, rest.starts_with("parameters.") ? rest.substr(11) : rest);
    }
    compare_reach(is_within_reach);
  }

  /// True for what way-points take the place of: parameters, and the pose parameters that they give.
  [[nodiscard]] bool is_replaced(const std::string& rest) const {
    return !compared_.empty() && (rest.starts_with("parameters.") ||
                                  compared_.contains("pose " + rest.substr(0, rest.find('['))));
  }

  /// Each line `reach` is that of a root of the model, which was checked when it was read. A question
  /// that leaves out poses although the file does not is another question.
  void compare_reach(bool is_within_reach) {
    if (q_.is_within_reach && !is_within_reach)
      throw OtherModel("the certificate is not about " + options_.model_name +
                       ": it leaves out the poses out of reach, but the motion has no 'where'");
    for (const auto& [key, stated] : q_.stated)
      if (key.starts_with("reach ")) used_.insert(key);
  }

  void compare_load_lines() {
    const Scope none;
    const LoadComparer comparer{
        [&](const std::string& place, const std::string& stated) { compare(place, stated, none); },
        [&](const std::string& stated) { used_.insert(stated); },
        [&](const std::string& place) {
          leave_out(place, values_.at(place), "the columns of the matrix have no names here");
        },
        [&](const std::string& stated) { refuse(stated); },
        [&](const std::string& stated) { return used_.contains(stated); }};
    if (q_.load ? !compare_load(q_, values_, comparer) : !compare_quantity(q_, values_, comparer))
      throw OtherModel("the certificate is not about " + options_.model_name + ": it has no " +
                       (q_.load ? "load '" + q_.load->name
                                : q_.quantity->set_kind + " '" + q_.quantity->set->name) +
                       "'");
  }

  [[noreturn]] void refuse(const std::string& stated) const {
    const StatedValue& value = q_.stated.at(stated);
    throw OtherModel("the certificate is not about " + options_.model_name + ": line " +
                     std::to_string(value.line) + " states '" + shortened(value.text) +
                     "', which the file does not have");
  }

  void compare_range(const std::string& place, const std::string& rest) {
    const Scope none;
    const std::string name = rest.substr(0, rest.find('['));
    const std::string option = "range " + name;
    const bool is_range = q_.stated.contains("lower " + name);
    if (rest.ends_with("[0]"))
      compare(place, (is_range ? "lower " : "pose ") + name, none, option);
    else if (rest.ends_with("[1]"))
      compare(place, (is_range ? "upper " : "pose ") + name, none, option);
    else if (is_range)
      for (const char* end : {"lower ", "upper "}) compare(place, end + name, none, option);
    else
      compare(place, "pose " + name, q_.commanded, option);
  }

  [[nodiscard]] bool may_set_tolerances() const {
    return options_.all_overridden ||
           std::any_of(options_.overridden.begin(), options_.overridden.end(),
                       [](const std::string& option) { return option.starts_with("tolerance "); });
  }

  /// Lists, with counts for each kind, the values of the certificate that the file does not state.
  void list_uncompared() {
    std::map<std::string, std::size_t> kinds;
    for (const auto& [key, stated] : q_.stated) {
      const std::string kind = key.substr(0, key.find(' ')), name = key.substr(kind.size() + 1);
      const bool is_own_parameter = kind == "pose" && q_.stated.contains("lower " + name);
      const bool is_option = kind == "spread" && may_set_tolerances();
      if (!used_.contains(key) && stated.text != "0" && !is_own_parameter && !is_option)
        ++kinds[kind];
    }
    for (const auto& [kind, count] : kinds)
      result_.uncompared.push_back(std::to_string(count) + " of the lines '" + kind +
                                   "' of the certificate, which have no value of their own in the "
                                   "file");
  }

  static constexpr int kMostLets = 100;

  Question& q_;
  const Options& options_;
  Verification& result_;
  const WrittenValues values_;
  const Names degrees_;  ///< pose parameters in that unit
  std::map<std::string, NodeId, std::less<>> actual_lets_, commanded_lets_;
  const std::set<std::string> compared_;  ///< the keys that are compared elsewhere
  std::set<std::string> used_;            ///< keys of what the certificate states
  int depth_ = 0, lets_ = 0;
};

}  // namespace

void compare_with_model(Question& question, const Options& options, Verification& result,
                        const std::vector<std::string>& compared) {
  Comparison(question, options, result, compared).run();
}

}  // namespace regulus::verifier
