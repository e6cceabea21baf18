// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_legs.hpp"

#include <string_view>

#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/rational_in.hpp"
#include "runtime/formal/unrelated.hpp"
#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

class LegReader : FileKeys {
 public:
  LegReader(const WrittenValues& values, const LegNumbers& numbers, std::set<std::string>& read)
      : FileKeys(values), numbers_(numbers), algebra_(numbers.graph), read_(read) {}

  std::vector<CoqLeg> read() {
    std::vector<CoqLeg> legs;
    for (std::size_t i = 0; has_below("legs.leg" + index(i)); ++i) {
      place_ = "legs.leg" + index(i) + '.';
      number_ = std::to_string(i + 1);
      legs.push_back(read_leg());
      if (legs.back().values.is_planar != legs.front().values.is_planar)
        refuse_model("legs in the plane and in space");
    }
    return legs;
  }

 private:
  /// The place of a key of a leg, which may stand in [legs].
  [[nodiscard]] std::string shared(const std::string& key) const {
    return has(place_ + key) || has_below(place_ + key + '[') || has_below(place_ + key + '.')
               ? place_ + key
               : "legs." + key;
  }
  std::string word_of(const std::string& key, const char* otherwise) {
    read_.insert(place_ + key);
    return word(shared(key), otherwise);
  }

  CoqLeg read_leg() {
    const std::string word = word_of("type", "");
    const LegType* const type = find_leg_type(word);
    if (type == nullptr) refuse_model("legs of the type '" + word + '\'');
    for (const char* key : {"range[0]", "range[1]", "zero[0]", "zero[1]", "zero[2]"})
      read_.insert(place_ + key);
    leg_ = {};
    leg_.kind = type->kind;
    leg_.is_planar = type->is_planar;
    leg_.keeps_orientation = type->keeps_orientation;
    leg_.is_hinged = type->is_hinged;
    leg_.mode = word_of("mode", "+") == "+";
    const std::string usual = type->kind == LegKind::kTelescopic ? "2" : "1";
    if (const std::string driven = word_of("actuated", usual.c_str()); driven != usual)
      refuse_model(driven == "none" ? "a leg without a motor"
                                    : "a motor in joint " + driven + " of a leg " + word);
    text_ = word == "linear-delta" ? "linear_delta" : word;
    read_points();
    read_lengths();
    return {leg_, text_};
  }

  void read_points() {
    leg_.base = point("base", 'a');
    if (word("legs.orientation", "") == "point") {
      leg_.platform = algebra_.zero();
      text_ += leg_.is_planar ? " (0, 0)" : " (0, 0, 0)";
    } else {
      leg_.platform = point("platform", 'b');
    }
    const bool has_axis =
        leg_.kind == LegKind::kSlider ||
        (!leg_.is_planar && (leg_.kind == LegKind::kCrank || leg_.keeps_orientation));
    leg_.axis = {algebra_.number(0), algebra_.number(0), algebra_.number(1)};
    if (has_axis) leg_.axis = direction("axis");
    leg_.size = algebra_.dot(leg_.axis, leg_.axis);
    if (leg_.is_hinged) leg_.hinge = direction("hinge");
    leg_.bar = leg_.axis;
    if (leg_.kind == LegKind::kSlider && leg_.keeps_orientation) leg_.bar = direction("bar");
    if (leg_.is_hinged && leg_.kind == LegKind::kSlider && !are_across(leg_.axis, leg_.hinge))
      refuse_model("a hinge that is not across the rail");
  }

  void read_lengths() {
    if (leg_.kind == LegKind::kTelescopic) return;
    if (leg_.kind == LegKind::kCrank) leg_.crank = length("crank");
    leg_.rod = length("rod");
    text_ += leg_.mode ? " 1" : " (-1)";
  }

  VectorNodes point(const std::string& side, char letter) {
    const SectionQuantity written =
        section_quantity(values_, place_ + side, {"legs." + side + "_tolerance", ""},
                         word("legs.tolerance_shape", "box") == "ball");
    LegNumbers::Places places;
    for (std::size_t i = 0; i < axes(); ++i)
      places.emplace_back(written.value + index(i), letter + number_ + '_' + kAxes[i]);
    return vector_of(numbers_.quantities(places, written));
  }
  VectorNodes vector_of(const std::vector<CoqNumber>& coordinates) {
    VectorNodes result = algebra_.zero();
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      result[i] = coordinates[i].node;
      texts.push_back(coordinates[i].text);
    }
    text_ += " (" + text_of(texts, ", ") + ')';
    return result;
  }

  NodeId length(const std::string& key) {
    const SectionQuantity written =
        section_quantity(values_, shared(key), {"legs." + key + "_tolerance", ""});
    const CoqNumber number =
        numbers_.quantities({{written.value, key + '_' + number_}}, written).front();
    text_ += ' ' + coq_argument(number.text);
    return number.node;
  }

  /// A direction stands as it is written if its length is 1, or else divided by its length: only the
  /// direction has a meaning.
  VectorNodes direction(const std::string& key) {
    const std::string place = shared(key);
    std::vector<CoqNumber> written;
    VectorNodes v = algebra_.zero();
    for (std::size_t i = 0; i < axes(); ++i) {
      if (!has(place + index(i))) refuse_model("a tolerance of an axis");
      written.push_back(numbers_.constant(place + index(i)));
      v[i] = written.back().node;
    }
    if (!has_length_1(v)) {
      v = unit(v);
      for (std::size_t i = 0; i < axes(); ++i) written[i] = {text_of_node(v[i]), v[i]};
    }
    return vector_of(written);
  }
  [[nodiscard]] std::string text_of_node(NodeId node) const {
    return coq_real(numbers_.graph, node, {});
  }
  /// v·√n/n, n = |v|²: it has no quotient by a root.
  VectorNodes unit(const VectorNodes& v) {
    const NodeId n = algebra_.dot(v, v);
    if (const auto length = rational_in(value_of(algebra_.root(n)))) {
      const NodeId number = numbers_.graph.number(*length);
      const NodeId quotient = algebra_.quotient(n, algebra_.square(number));
      if (algebra_.is_number(quotient, 1))
        return algebra_.scaled(algebra_.quotient(algebra_.number(1), number), v);
    }
    return algebra_.scaled(algebra_.quotient(algebra_.root(n), n), v);
  }

  [[nodiscard]] Ball value_of(NodeId node) const {
    if (has_variables(numbers_.graph, node)) refuse_model("a tolerance of an axis");
    const auto value = evaluate(numbers_.graph, {node}, {}, kBits);
    if (!value) refuse_model("an axis that has no value");
    return value->front();
  }
  [[nodiscard]] bool has_length_1(const VectorNodes& v) {
    return arb_contains_si(value_of(algebra_.dot(v, v)).get(), 1) != 0;
  }
  [[nodiscard]] bool are_across(const VectorNodes& u, const VectorNodes& v) {
    return arb_contains_zero(value_of(algebra_.dot(u, v)).get()) != 0;
  }

  [[nodiscard]] std::size_t axes() const { return leg_.is_planar ? 2 : 3; }

  static constexpr std::string_view kAxes = "xyz";
  static constexpr long kBits = 256;

  const LegNumbers& numbers_;
  GraphAlgebra algebra_;
  std::set<std::string>& read_;
  std::string place_, number_;
  LegValues leg_;
  std::string text_;
};

}  // namespace

std::vector<CoqLeg> read_coq_legs(const WrittenValues& values, const LegNumbers& numbers,
                                  std::set<std::string>& read) {
  return LegReader(values, numbers, read).read();
}

}  // namespace regulus::verifier
