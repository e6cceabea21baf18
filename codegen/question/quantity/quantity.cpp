// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/motor_rows.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/model/names.hpp"
#include "codegen/question/quantity/determinant_of_inverse.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/regularity/lanes.hpp"

namespace regulus {

using namespace detail;

namespace {

using Kind = TwistComponent::Kind;

/// Returns the set of that name, or the only one.
const VectorSet& choose_set(const std::vector<VectorSet>& sets, const std::string& wanted,
                            const std::string& option) {
  std::vector<std::string> names;
  for (const VectorSet& set : sets) names.push_back(set.name);
  if (sets.empty())
    throw UsageError(
        fmt::format("--{0}: the model has no [{0}.NAME]; add one to the model file", option));
  if (wanted.empty()) {
    if (sets.size() == 1) return sets.front();
    throw UsageError(
        fmt::format("--{}: the model has {}; choose one", option, fmt::join(names, ", ")));
  }
  const auto at = std::ranges::find(names, wanted);
  if (at == names.end())
    throw UsageError(fmt::format(
        "--{}: there is no {}; {}", option, in_quotes(wanted),
        suggestion(wanted, names, fmt::format("this model has {}", fmt::join(names, ", ")))));
  return sets[static_cast<std::size_t>(at - names.begin())];
}

void require_radians(const std::vector<PoseParameter>& coordinates, const std::string& what,
                     const char* why) {
  for (const PoseParameter& p : coordinates)
    if (is_in_degrees(p.unit))
      throw UsageError(
          fmt::format("{}: '{}' is in degrees, and {}; give it in rad", what, p.name, why));
}

/// Makes the components of one quantity.
class Components {
 public:
  Components(const Model& model, const QuantityOptions& options)
      : model_(model), options_(options) {}

  Quantity of(QuantityKind kind) {
    begin(kind);
    if (!model_.closure) {
      if (kind == QuantityKind::kFiniteError)
        throw UsageError(
            "only bound has the finite errors of a platform; ask for error, to first order");
      require_inverse();
      require_small_matrix();
    }
    const VectorSet* const set = choose_data();
    if (traits_->compares_units) require_one_unit();
    switch (components_) {
      case ComponentsOf::kWhole:
        add_whole();
        break;
      case ComponentsOf::kRows:
        add_rows(*set);
        break;
      case ComponentsOf::kFreedoms:
      case ComponentsOf::kNorms:
        add_freedoms(set);
        break;
      case ComponentsOf::kPairs:
        add_pairs();
        break;
    }
    return std::move(quantity_);
  }

  Quantity of_expression() {
    begin(QuantityKind::kExpression);
    quantity_.name = options_.quantity;
    quantity_.unit = "1";
    Component c = component();
    c.expression = model_.asked->value;
    c.must_be_defined = model_.asked->must_be_defined;
    quantity_.components.push_back(std::move(c));
    return std::move(quantity_);
  }

 private:
  void begin(QuantityKind kind) {
    traits_ = &traits_of(kind);
    components_ = traits_->components, data_ = traits_->data, has_signs_ = traits_->has_signs;
    quantity_.kind = kind;
    quantity_.name = traits_->description;
    if (model_.closure) take_traits_of_closure(closure_traits_of(kind));
    quantity_.is_least = options_.least || traits_->is_always_least;
    refuse_foreign_options();
  }

  void take_traits_of_closure(const ClosureTraits& traits) {
    if (*traits.description == '\0')
      throw UsageError(fmt::format("{}: {}", options_.quantity, traits.why));
    components_ = traits.components, data_ = traits.data, has_signs_ = traits.has_signs;
    quantity_.name = traits.description;
    const QuantityKind kind = quantity_.kind;
    if (kind == QuantityKind::kForce || kind == QuantityKind::kDeflection)
      require_radians(model_.pose, options_.quantity, "loads and moments are of radians");
    if (kind == QuantityKind::kForce || kind == QuantityKind::kDeflection ||
        traits_->compares_units)
      require_radians(model_.closure->unknowns, options_.quantity,
                      "loads, moments and a characteristic length are of radians");
    if (kind == QuantityKind::kDeterminant || kind == QuantityKind::kDeterminantMax)
      require_determinant_of_radians(model_, options_.quantity);
  }

  [[nodiscard]] bool has_freedoms() const {
    return components_ == ComponentsOf::kFreedoms || components_ == ComponentsOf::kNorms;
  }

  /// An option that does not belong to the quantity would be ignored.
  void refuse_foreign_options() const {
    const bool has_load = data_ == NeededData::kLoad || data_ == NeededData::kLoadAndStiffness;
    const auto refuse = [&](bool given, bool has_meaning, const char* option) {
      if (given && !has_meaning)
        throw UsageError(fmt::format("--{}: has no meaning for {}", option, options_.quantity));
    };
    refuse(!options_.row.empty(), components_ == ComponentsOf::kRows, "leg");
    refuse(!options_.freedom.empty(), has_freedoms(), "freedom");
    refuse(!options_.load.empty(), has_load, "load");
    refuse(!options_.twist.empty(), data_ == NeededData::kTwist, "twist");
    refuse(options_.is_signed, has_signs_, "signed");
    refuse(!options_.norm.empty(), *traits_->norm != '\0', "norm");
    refuse(options_.least, has_signs_ || traits_->may_be_least, "min");
  }

  /// Returns the load or the twist; nullptr if the quantity has none.
  [[nodiscard]] const VectorSet* choose_data() const {
    const Actuators& motors = model_.actuators;
    switch (data_) {
      case NeededData::kNone:
        break;
      case NeededData::kMotorErrors:
        require(motors.error, "error", "the error of each motor");
        break;
      case NeededData::kMotorSpeeds:
        require(motors.speed, "speed", "the largest speed of each motor");
        break;
      case NeededData::kLoadAndStiffness:
        require(motors.stiffness, "stiffness", "the stiffness of each motor");
        [[fallthrough]];
      case NeededData::kLoad:
        return &choose_set(model_.loads, options_.load, "load");
      case NeededData::kTwist:
        return &choose_set(model_.twists, options_.twist, "twist");
    }
    return nullptr;
  }

  void require_inverse() const {
    const auto rows = model_.matrix.rows(), columns = model_.matrix.cols();
    if (traits_->needs_inverse && model_.matrix_kind != MatrixKind::kInverse)
      throw UsageError(
          fmt::format("{}: the matrix of a serial robot is its Jacobian in a frame of "
                      "its own; bound an expression of the model instead",
                      options_.quantity));
    if (traits_->needs_square && rows != columns)
      throw UsageError(
          fmt::format("{}: the {}×{} matrix is not square, so it has no inverse; "
                      "sigma-min, sigma-max, speed and condition --norm 2 can be bounded",
                      options_.quantity, rows, columns));
  }

  /// A matrix of both orders has the singular values.
  void require_small_matrix() const {
    const std::size_t rows = model_.matrix.rows(), columns = model_.matrix.cols();
    const QuantityKind kind = quantity_.kind;
    if (kind == QuantityKind::kDeterminantMax && rows > kMostRowsOfDeterminant)
      throw UsageError(
          fmt::format("{}: the matrix has {} rows; a determinant of at most {} is multiplied out",
                      options_.quantity, rows, kMostRowsOfDeterminant));
    if ((kind == QuantityKind::kSigmaMin || kind == QuantityKind::kSigmaMax) &&
        rows + columns > kMaxColumns)
      throw UsageError(
          fmt::format("{}: the {}×{} matrix has {} rows and columns together; of more than {}, "
                      "condition --norm 2 can be bounded",
                      options_.quantity, rows, columns, rows + columns, kMaxColumns));
  }

  void require(const std::vector<GiNaC::ex>& values, const char* key, const char* meaning) const {
    if (values.empty())
      throw UsageError(fmt::format("{}: the model does not give {}; add [actuators] {} = …",
                                   options_.quantity, meaning, key));
  }

  /// Returns the unit of the force or the speed of a motor.
  [[nodiscard]] std::string unit_of_motor(std::size_t row) const {
    if (quantity_.kind == QuantityKind::kForce) return unit_of_motor_force(model_, row);
    return unit_of_coordinate(model_, row) + "/s";
  }

  [[nodiscard]] Component component() const {
    Component c;
    c.kind = quantity_.kind;
    c.unit = quantity_.unit;
    // The least singular value is a least value without --min, too.
    const bool is_least = options_.least && !traits_->is_always_least;
    const bool has_sign =
        is_least || options_.is_signed || quantity_.kind == QuantityKind::kExpression;
    c.is_absolute = !has_sign;
    c.sign = is_least ? -1 : 1;
    return c;
  }

  void add_rows(const VectorSet& set) {
    quantity_.name += (data_ == NeededData::kTwist ? " for " : " under ") + set.name;
    std::size_t first = 0, last = motor_count(model_);
    if (last == 0) throw UsageError(fmt::format("{}: this robot has no motors", options_.quantity));
    if (!options_.row.empty()) {
      first = row_of_leg(last);
      last = first + 1;
    }
    for (std::size_t i = first; i < last; ++i) {
      Component c = component();
      c.label = motor_name(model_, i);
      c.row = i;
      c.unit = unit_of_motor(i);
      c.set = &set;
      quantity_.components.push_back(std::move(c));
    }
    quantity_.unit = quantity_.components.front().unit;
  }

  /// Returns the row of the motor of a leg.
  [[nodiscard]] std::size_t row_of_leg(std::size_t motors) const {
    const std::string& text = options_.row;
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size())
      for (std::size_t i = 0; i < motors; ++i)
        if (leg_of_motor(model_, i) == value) return i;
    if (leg_of_motor(model_, motors - 1) == motors)
      throw UsageError(
          fmt::format("--leg: found {}, expected a number from 1 to {}", in_quotes(text), motors));
    std::vector<std::string> legs;
    for (std::size_t i = 0; i < motors; ++i)
      legs.push_back(std::to_string(leg_of_motor(model_, i)));
    throw UsageError(fmt::format("--leg: found {}, expected a leg with a motor: {}",
                                 in_quotes(text), fmt::join(legs, ", ")));
  }

  /// Adds the columns, and for errors the norms of the two parts of the pose.
  void add_freedoms(const VectorSet* set) {
    const std::vector<TwistComponent> twist = twist_of(model_);
    if (set) quantity_.name += " under " + set->name;
    std::vector<std::string> known;
    const auto offer = [&](const std::string& name, Component c) {
      known.push_back(name);
      if (!options_.freedom.empty() && options_.freedom != name) return;
      c.label = name;
      c.set = set;
      quantity_.components.push_back(std::move(c));
    };
    for (std::size_t k = 0; k < model_.matrix.cols(); ++k) {
      Component c = component();
      c.column = k;
      if (k < twist.size()) c.unit = twist[k].unit;
      if (data_ == NeededData::kMotorSpeeds) c.unit += "/s";
      offer(k < twist.size() ? twist[k].name : fmt::format("column {}", k + 1), std::move(c));
    }
    if (components_ == ComponentsOf::kNorms && !twist.empty()) {
      offer_part(twist, Kind::kLinear, "position", offer);
      offer_part(twist, Kind::kAngular, "rotation", offer);
    }
    if (quantity_.components.empty())
      throw UsageError(
          fmt::format("--freedom: there is no {}; {}", in_quotes(options_.freedom),
                      suggestion(options_.freedom, known,
                                 fmt::format("this model has {}", fmt::join(known, ", ")))));
  }

  template <class Offer>
  void offer_part(const std::vector<TwistComponent>& twist, Kind kind, const char* name,
                  const Offer& offer) const {
    const auto of_kind = [&](const TwistComponent& t) { return t.kind == kind; };
    if (std::ranges::count_if(twist, of_kind) < 2) return;
    Component c = component();
    c.part = kind == Kind::kLinear ? PosePart::kLinear : PosePart::kAngular;
    c.unit = std::ranges::find_if(twist, of_kind)->unit;
    offer(name, std::move(c));
  }

  /// Singular values and condition numbers compare velocities with angular velocities.
  void require_one_unit() {
    const std::vector<TwistComponent> twist = twist_of(model_);
    const auto is_angular = [](const TwistComponent& t) { return t.kind == Kind::kAngular; };
    const auto angular = std::ranges::count_if(twist, is_angular);
    if (angular == 0 || angular == std::ranges::ssize(twist)) return;
    if (!model_.characteristic_length)
      throw UsageError(
          fmt::format("{}: the matrix mixes lengths and angles; add characteristic_length = … to "
                      "the model, the "
                      "length that an angle of 1 rad stands for",
                      options_.quantity));
  }

  void add_whole() {
    quantity_.unit = "1";
    quantity_.components.push_back(component());
  }

  void add_pairs() {
    quantity_.unit = "1";
    for (std::size_t i = 0; i < model_.matrix.rows(); ++i)
      for (std::size_t k = 0; k < model_.matrix.cols(); ++k) {
        Component c = component();
        c.label = fmt::format("row {}, column {}", i + 1, k + 1);
        c.row = i;
        c.column = k;
        quantity_.components.push_back(std::move(c));
      }
  }

  const Model& model_;
  const QuantityOptions& options_;
  const QuantityTraits* traits_ = nullptr;
  ComponentsOf components_ = ComponentsOf::kWhole;
  NeededData data_ = NeededData::kNone;
  bool has_signs_ = false;
  Quantity quantity_;
};

/// Returns nullopt for a text that is no word of a quantity. The first of two with one word has the
/// norm that is meant without --norm.
std::optional<QuantityKind> kind_of(const std::string& word, const std::string& norm) {
  if (!norm.empty() && norm != "2" && norm != "max")
    throw UsageError(fmt::format("--norm: found {}, expected 2 or max", in_quotes(norm)));
  for (const QuantityTraits& traits : quantity_traits())
    if (word == traits.word && (norm.empty() || *traits.norm == '\0' || norm == traits.norm))
      return traits.kind;
  return std::nullopt;
}

}  // namespace

void require_determinant_of_radians(const Model& model, const std::string& what) {
  if (model.closure)
    require_radians(model.closure->unknowns, what,
                    "the determinant would be that of derivatives by degrees");
}

std::vector<std::string> quantity_words() {
  std::vector<std::string> words;
  for (const QuantityTraits& traits : quantity_traits())
    if (*traits.word != '\0' && (words.empty() || words.back() != traits.word))
      words.emplace_back(traits.word);
  return words;
}

bool is_quantity(const std::string& word) { return std::ranges::count(quantity_words(), word) > 0; }

Quantity quantity_of(const Model& model, const QuantityOptions& options) {
  Components components(model, options);
  std::optional<QuantityKind> kind =
      is_quantity(options.quantity) ? kind_of(options.quantity, options.norm) : std::nullopt;
  if (options.is_finite) {
    const auto is_called = [&](QuantityKind k) { return options.quantity == traits_of(k).word; };
    if (!is_called(QuantityKind::kError) && !is_called(QuantityKind::kFiniteError))
      throw UsageError("--finite is about error; " + options.quantity + " has no finite form");
    kind = QuantityKind::kFiniteError;
  }
  if (kind == QuantityKind::kDeterminant && (options.is_signed || options.least))
    kind = QuantityKind::kDeterminantMax;
  Quantity quantity = kind ? components.of(*kind) : components.of_expression();
  for (Component& c : quantity.components)
    if (c.unit.empty()) c.unit = quantity.unit;
  return quantity;
}

bool is_finite_error(const QuantityOptions& options) {
  return options.is_finite || options.quantity == traits_of(QuantityKind::kFiniteError).word;
}

const VectorSet& choose_load(const Model& model, const std::string& wanted) {
  return choose_set(model.loads, wanted, "load");
}

}  // namespace regulus
