// SPDX-License-Identifier: Apache-2.0
// [gough]: a leg from a_i to X + R·b_i has the row (d, R·b × d) and the scale 1/|d|.
#include "runtime/verifier/model/gough_reading.hpp"

#include "runtime/verifier/model/orientation_reading.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kAxes = "xyz";

class GoughReading final : public SectionReading {
 public:
  explicit GoughReading(const WrittenValues& values)
      : orientation_(text(values, "orientation", "")),
        unit_(text(values, "unit", "1")),
        angle_unit_(text(values, "angle_unit", "rad")),
        shape_(text(values, "tolerance_shape", "box")) {}

  [[nodiscard]] std::vector<SectionPose> pose() const override {
    std::vector<SectionPose> result;
    for (const char axis : kAxes) result.push_back({std::string(1, axis), unit_});
    for (const std::string& name : orientation_names(orientation_))
      result.push_back({name, orientation_ == "quaternion" ? "1" : angle_unit_});
    return result;
  }

  void compare(SectionComparer& comparer) override {
    GraphAlgebra algebra(comparer.question().graph);
    if (orientation_names(orientation_).empty() || orientation_ == kAngleInPlane)
      throw Unfinished("the orientation '" + orientation_ + "' is not known");
    const OrientationNodes R =
        read_orientation(orientation_, comparer.question().actual, angle_unit_ != "rad", algebra);
    if (orientation_ == "quaternion")
      comparer.expect_defined(comparer.place_of("gough.orientation"),
                              algebra.quotient(algebra.number(1), R.size));
    VectorNodes X{};
    for (std::size_t i = 0; i < 3; ++i) X[i] = named(comparer, std::string(1, kAxes[i]));
    for (std::size_t leg = 0; leg < 6; ++leg) {
      const VectorNodes a = anchor(comparer, "base", 'a', leg);
      const VectorNodes b = anchor(comparer, "platform", 'b', leg);
      // All lengths are multiplied by the size of R.
      const VectorNodes Rb = algebra.product(R.scaled, b);
      const VectorNodes from_a = algebra.difference(X, a);
      const VectorNodes d = algebra.sum(algebra.scaled(R.size, from_a), Rb);
      compare_row(comparer, algebra, leg, d, algebra.cross(Rb, from_a));
    }
  }

  [[nodiscard]] std::vector<SectionLeg> telescopic_legs(SectionComparer& comparer) override {
    std::vector<SectionLeg> legs;
    const auto at = [](const char* side, std::size_t leg) {
      return std::string("gough.") + side + '[' + std::to_string(leg) + ']';
    };
    for (std::size_t leg = 0; leg < 6; ++leg)
      legs.push_back({SectionValues(comparer, false).middle(at("base", leg)),
                      SectionValues(comparer, false).middle(at("platform", leg))});
    return legs;
  }

  [[nodiscard]] std::vector<SectionLeg> uncertain_legs(SectionComparer& comparer) override {
    std::vector<SectionLeg> legs;
    for (std::size_t leg = 0; leg < 6; ++leg) {
      const std::string at = '[' + std::to_string(leg) + ']';
      legs.push_back({{"gough.base" + at, anchor(comparer, "base", 'a', leg)},
                      {"gough.platform" + at, anchor(comparer, "platform", 'b', leg)}});
    }
    return legs;
  }

  [[nodiscard]] NodeId squared_length(const SectionLeg& leg, const Scope& pose,
                                      SectionComparer& comparer) override {
    return squared_length_at(leg, orientation_, angle_unit_ != "rad", pose,
                             comparer.question().graph);
  }

 private:
  static std::string text(const WrittenValues& values, const char* key,
                          const std::string& otherwise) {
    const auto found = values.find(std::string("gough.") + key);
    return found == values.end() ? otherwise : found->second.text;
  }

  static NodeId named(SectionComparer& comparer, const std::string& name) {
    const auto found = comparer.question().actual.find(name);
    if (found == comparer.question().actual.end())
      throw Unfinished("the certificate has no line for " + name);
    return found->second;
  }

  VectorNodes anchor(SectionComparer& comparer, const std::string& side, char letter,
                     std::size_t leg) const {
    const std::string place = "gough." + side + '[' + std::to_string(leg) + ']';
    const SectionQuantity written =
        section_quantity(comparer.values(), place,
                         {"gough." + side + "_tolerance", "tolerance " + side}, shape_ == "ball");
    VectorNodes result{};
    std::vector<std::string> names;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] =
          SectionValues(comparer, false)
              .quantity(written.value + '[' + std::to_string(axis) + ']',
                        std::string(1, letter) + std::to_string(leg + 1) + '_' + kAxes[axis],
                        written.tolerance, &names);
    if (written.is_ball) comparer.expect_ball(comparer.place_of(written.tolerance.key), names);
    return result;
  }

  /// The moment R·b × d is R·b × (X − a).
  static void compare_row(SectionComparer& comparer, GraphAlgebra& algebra, std::size_t leg,
                          const VectorNodes& d, const VectorNodes& moment) {
    const FilePlace from{"gough", 0, "leg " + std::to_string(leg + 1)};
    for (std::size_t i = 0; i < 3; ++i) {
      comparer.compare(from, d[i], "entry " + std::to_string(6 * leg + i));
      comparer.compare(from, moment[i], "entry " + std::to_string(6 * leg + 3 + i));
    }
    comparer.compare(from, algebra.quotient(algebra.number(1), algebra.root(algebra.dot(d, d))),
                     "scale " + std::to_string(leg));
  }

  const std::string orientation_, unit_, angle_unit_, shape_;
};

}  // namespace

std::unique_ptr<SectionReading> gough_reading(const WrittenValues& values) {
  return std::make_unique<GoughReading>(values);
}

}  // namespace regulus::verifier
