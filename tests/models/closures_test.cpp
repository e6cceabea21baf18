// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanisms of models/ that are given by equations: each start is near a configuration that is
// computed here from the mechanism's own geometry, and the equations vanish for configurations that
// are built forward.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/models/shipped_model.hpp"
#include "tests/support/precise_number.hpp"

namespace regulus::detail::test {
namespace {

template <class T>
struct At {
  T x, y;
  friend At operator+(const At& a, const At& b) { return {a.x + b.x, a.y + b.y}; }
};

/// A vector of that length and angle.
template <class T>
At<T> polar(const T& length, const T& angle) {
  return {length * cos(angle), length * sin(angle)};
}

/// A point of a body that is turned counter-clockwise about its origin at `origin`.
template <class T>
At<T> point_of(const At<T>& origin, const T& angle, const At<T>& p) {
  return {origin.x + p.x * cos(angle) - p.y * sin(angle),
          origin.y + p.x * sin(angle) + p.y * cos(angle)};
}

template <class T>
T squared_distance(const At<T>& a, const At<T>& b) {
  const T x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

template <class T>
using Values = std::vector<T>;

/// The geometry that the files state, once more.
constexpr double kElbowCrank = 25;
template <class T>
At<T> base(std::size_t i) {
  const double all[3][2] = {{0, 0}, {60, 0}, {30, 52}};
  return {T(all[i][0]), T(all[i][1])};
}
template <class T>
At<T> platform(std::size_t i) {
  const double all[3][2] = {{-9, -5}, {9, -5}, {0, 10}};
  return {T(all[i][0]), T(all[i][1])};
}

/// The squared lengths of the bars that close a mechanism, of its motors (in radians) and unknowns.
template <class T>
Values<T> five_bar(const Values<T>& q, const Values<T>& u) {
  const At<T> P{u[0], u[1]}, left{T(-0.5), T(0)}, right{T(0.5), T(0)};
  return {squared_distance(P, left + polar(T(1), q[0])),
          squared_distance(P, right + polar(T(1), q[1]))};
}

template <class T>
Values<T> rrr(const Values<T>& q, const Values<T>& u) {
  Values<T> squares;
  for (std::size_t i = 0; i < 3; ++i)
    squares.push_back(squared_distance(point_of(At<T>{u[0], u[1]}, u[2], platform<T>(i)),
                                       base<T>(i) + polar(T(kElbowCrank), q[i])));
  return squares;
}

template <class T>
Values<T> double_butterfly(const Values<T>& q, const Values<T>& u) {
  const auto tenths = [](int x, int y) { return At<T>{T(x) / T(10), T(y) / T(10)}; };
  const At<T> pivot = tenths(-56, 42), t3{u[0], u[1]};
  const T clockwise = T(0) - q[0];
  const At<T> t4 = point_of(t3, u[2], tenths(-30, 40));
  const At<T> corner{T(-646) / T(100), T(269) / T(100)};
  return {squared_distance(t3, At<T>{T(0), T(0)}),
          squared_distance(point_of(t3, u[2], tenths(-30, 0)),
                           point_of(pivot, clockwise, tenths(-24, 18))),
          squared_distance(point_of(t4, u[3], tenths(-60, 0)),
                           point_of(pivot, clockwise, tenths(-20, 0))),
          squared_distance(point_of(t4, u[3], corner), At<T>{T(-13), T(0)})};
}

/// Crank and coupler against ground and rocker; unknowns are the angles of coupler and rocker.
Values<Precise> four_bar(const Values<Precise>& q, const Values<Precise>& u) {
  const At<Precise> C = polar(Precise("0.2"), q[0]) + polar(Precise("0.35355"), u[0]);
  const At<Precise> D = At<Precise>{Precise("0.45"), Precise(0)} + polar(Precise("0.25"), u[1]);
  return {C.x - D.x, C.y - D.y};
}

template <class T>
struct InSpace {
  T x, y, z;
};
template <class T>
T squared_distance(const InSpace<T>& a, const InSpace<T>& b) {
  return squared_distance(At<T>{a.x, a.y}, At<T>{b.x, b.y}) + (a.z - b.z) * (a.z - b.z);
}

/// A point of a platform at u = (x, y, z, roll, pitch, yaw): turned about x, then y, then z.
template <class T>
InSpace<T> on_platform(const Values<T>& u, InSpace<T> p) {
  const At<T> origin{T(0), T(0)};
  const At<T> rolled = point_of(origin, u[3], At<T>{p.y, p.z});
  const At<T> pitched = point_of(origin, u[4], At<T>{rolled.y, p.x});
  const At<T> turned = point_of(At<T>{u[0], u[1]}, u[5], At<T>{pitched.y, rolled.x});
  return {turned.x, turned.y, u[2] + pitched.x};
}

/// The end of a crank that swings in the vertical plane of direction `e` through (foot, 0).
template <class T>
InSpace<T> crank_end(const At<T>& foot, const At<T>& e, const T& length, const T& angle) {
  const At<T> lever = polar(length, angle);
  return {foot.x + lever.x * e.x, foot.y + lever.x * e.y, lever.y};
}

/// The six rods of the Delta, less their length: sums and differences of the two of a parallelogram.
Values<Precise> delta(const Values<Precise>& q, const Values<Precise>& u) {
  const Precise half = Precise(1) / Precise(2), width(50), lower(1244);
  const Precise root = Precise(2) * sin(Precise::pi() / Precise(3));
  const Precise base = Precise(567) * root / Precise(6), size = Precise(76) * root / Precise(3);
  Values<Precise> result;
  for (int i = 0; i < 3; ++i) {
    const At<Precise> e =
        polar(Precise(1), Precise::pi() * (Precise(i) * Precise(2) / Precise(3) - half));
    const At<Precise> t{Precise(0) - e.y, e.x};
    Precise rods[2];
    for (const int side : {0, 1}) {
      const Precise w = side == 0 ? width : Precise(0) - width;
      const InSpace<Precise> C =
          crank_end(At<Precise>{base * e.x + w * t.x, base * e.y + w * t.y}, e, Precise(524), q[i]);
      const InSpace<Precise> B =
          on_platform(u, {size * e.x + w * t.x, size * e.y + w * t.y, Precise(0)});
      rods[side] = squared_distance(C, B) - lower * lower;
    }
    result.push_back((rods[0] + rods[1]) / Precise(2));
    result.push_back((rods[0] - rods[1]) / (Precise(4) * width));
  }
  return result;
}

/// The squared lengths of the hexapod's rods.
Values<Precise> hexapod(const Values<Precise>& q, const Values<Precise>& u) {
  const char* const feet[] = {"74.9", "105.1", "194.9", "225.1", "314.9", "345.1"};
  const char* const joints[] = {"82.9", "97.1", "202.9", "217.1", "322.9", "337.1"};
  const char* const planes[] = {"0", "180", "120", "300", "240", "60"};
  const auto at = [](const char* radius, const char* degrees) {
    return polar(Precise(radius), Precise(degrees) * Precise::pi() / Precise(180));
  };
  Values<Precise> squares;
  for (std::size_t i = 0; i < 6; ++i) {
    const At<Precise> b = at("76.35", joints[i]);
    squares.push_back(
        squared_distance(crank_end(at("65.43", feet[i]), at("1", planes[i]), Precise(36), q[i]),
                         on_platform(u, {b.x, b.y, Precise(0)})));
  }
  return squares;
}

template <class Squares>
auto of_lengths(Squares squares, std::vector<const char*> lengths) {
  return [=](const Values<Precise>& q, const Values<Precise>& u) {
    Values<Precise> result = squares(q, u);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Precise length(lengths[i]);
      result[i] = result[i] - length * length;
    }
    return result;
  };
}

/// Checks the start of a model against the root of the mechanism's own equations.
template <class System>
void expect_start_near_root(const std::string& name, const System& system) {
  const ShippedModel shipped(name);
  const Model& model = shipped.model();
  const Closure& closure = model.closure.value();
  Values<Precise> q, u;
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const bool in_degrees = model.pose[i].unit == "deg";
    // Exact numbers of degrees: the pose times 180/pi is a rational number.
    const GiNaC::ex degrees =
        in_degrees ? closure.start_pose[i] : closure.start_pose[i] * 180 / GiNaC::Pi;
    ASSERT_TRUE(GiNaC::is_a<GiNaC::numeric>(degrees)) << degrees;
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(degrees);
    q.push_back(Precise(number.numer().to_double()) / Precise(number.denom().to_double()) *
                Precise::pi() / Precise(180));
  }
  for (const GiNaC::ex& start : closure.start) u.emplace_back(evaluate(start, {}));
  const Values<Precise> root = root_near([&](const Values<Precise>& x) { return system(q, x); }, u);
  for (const Precise& rest : system(q, root)) EXPECT_LT(abs(rest).to_double(), 1e-50) << name;
  for (std::size_t i = 0; i < u.size(); ++i)
    EXPECT_LT(abs(root[i] - u[i]).to_double(), evaluate(closure.start_radius[i], {}) / 2)
        << name << ' ' << closure.unknowns[i].name << " = " << root[i].to_double();
}

TEST(Closures, StartNearAConfigurationOfTheMechanism) {
  expect_start_near_root("four_bar", four_bar);
  expect_start_near_root("five_bar_closure", of_lengths(five_bar<Precise>, {"1.25", "1.25"}));
  expect_start_near_root("rrr_closure", of_lengths(rrr<Precise>, {"25", "25", "25"}));
  expect_start_near_root("delta_closure", delta);
  expect_start_near_root("hexapod_6rus_closure",
                         of_lengths(hexapod, {"125", "125", "125", "125", "125", "125"}));
  expect_start_near_root("double_butterfly",
                         of_lengths(double_butterfly<Precise>, {"11", "9", "7", "12"}));
}

/// The six configurations of the double butterfly at 67.38 deg, to five decimals.
TEST(Closures, OfTheDoubleButterflyHaveItsSixConfigurations) {
  const auto system = of_lengths(double_butterfly<Precise>, {"11", "9", "7", "12"});
  const double all[6][4] = {
      {-10.81285, -2.02048, -2.92286, -2.18392}, {-0.15399, 10.99892, -2.77840, 0.87629},
      {-10.79336, -2.12213, -1.39668, 3.07555},  {-10.99999, 0.01224, -1.00189, -1.05559},
      {-10.20140, 4.11478, 0.16299, -2.28605},   {6.74390, 8.69022, 0.51832, 1.29745}};
  const Values<Precise> q = {Precise("67.38") * Precise::pi() / Precise(180)};
  for (const auto& published : all) {
    const Values<Precise> near(std::begin(published), std::end(published));
    const Values<Precise> root =
        root_near([&](const Values<Precise>& x) { return system(q, x); }, near);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(abs(root[i] - near[i]).to_double(), 5.1e-6) << published[0];
  }
}

class Forward : public testing::Test {
 protected:
  /// The equations of a model at a place, with lengths that the place itself makes.
  void expect_closed(const ShippedModel& model, Point place, const Point& lengths) {
    for (const GeometryParameter& g : model.model().geometry)
      place.emplace(g.name, evaluate(g.value, {}));
    for (const auto& [name, length] : lengths) place[name] = length;
    for (const GiNaC::ex& equation : model.model().closure->equations)
      EXPECT_NEAR(evaluate(equation, place), 0, 2e-12 * scale_) << equation;
  }

  double between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }

  /// Random motors and unknowns: the bars get the lengths that they have there.
  template <class Squares>
  void expect_bars_close(const std::string& name, const std::string& bar, const Squares& squares,
                         double size) {
    const ShippedModel model(name);
    scale_ = size * size;
    for (int trial = 0; trial < 100; ++trial) {
      Point place;
      Values<double> q, u;
      for (const PoseParameter& p : model.model().pose) {
        q.push_back(between(-3, 3));
        place[p.name] = p.unit == "deg" ? q.back() * 180 / std::numbers::pi : q.back();
      }
      for (const PoseParameter& p : model.model().closure->unknowns) {
        u.push_back(p.unit == "rad" ? between(-3, 3) : between(-size, size));
        place[p.name] = u.back();
      }
      Point lengths;
      const Values<double> all = squares(q, u);
      for (std::size_t i = 0; i < all.size(); ++i)
        lengths[bar + '_' + std::to_string(i + 1)] = std::sqrt(all[i]);
      expect_closed(model, place, lengths);
    }
  }

  double scale_ = 1;

 private:
  std::mt19937_64 random_{20260101};
};

TEST_F(Forward, BarsCloseTheEquations) {
  expect_bars_close("five_bar_closure", "coupler", five_bar<double>, 2);
  expect_bars_close("rrr_closure", "link", rrr<double>, 60);
  expect_bars_close("double_butterfly", "bar", double_butterfly<double>, 15);
}

/// Crank and coupler are laid out; a rocker of any angle then ends on the ground's line.
TEST_F(Forward, AFourBarClosesItsEquations) {
  const ShippedModel model("four_bar");
  for (int trial = 0; trial < 100; ++trial) {
    const double theta = between(-3, 3), phi = between(-3, 3), psi = between(0.3, 2.8);
    const double crank = between(0.1, 1), coupler = between(0.1, 1);
    const At<double> C = polar(crank, theta) + polar(coupler, phi);
    const double rocker = C.y / std::sin(psi), ground = C.x - rocker * std::cos(psi);
    expect_closed(model, {{"theta", theta}, {"phi", phi}, {"psi", psi}},
                  {{"crank", crank}, {"coupler", coupler}, {"rocker", rocker}, {"ground", ground}});
  }
}

struct CommandOfClosure {
  std::vector<std::string> words;  ///< MODEL stands for the file
  int exit_code;
  const char* phrase;  ///< of what it prints
};

TEST(Closures, AreShownOrRefusedByNameByEveryCommand) {
  const CommandOfClosure all[] = {
      {{"list", "MODEL"}, 0, "psi = 1.5708 rad ± 1/100"},
      {{"explain", "MODEL", "--stage", "matrix"}, 0, "F(2) = "},
      {{"explain", "MODEL", "inside"}, 0, "Occurrences"},
      {{"explain", "MODEL", "inside", "--stage", "text"}, 65, "[closure]"},
      {{"generate", "MODEL", "inside", "--output", "/nowhere"}, 65, "[closure]"},
      {{"check", "MODEL", "inside", "--load", "push"}, 64, "the model has no [load"},
      {{"check", "MODEL", "inside", "--method", "reg"}, 64, "method: for a [closure]"},
      {{"check", "MODEL", "inside", "--range", "theta=1:2"}, 65, "does not contain the start"},
      {{"check", "MODEL", "inside", "--range", "phi=1:2"}, 64, "'phi'"},
      {{"check", "MODEL", "inside", "--tube", "psi=1"}, 64, "'psi'"},
      {{"locate", "MODEL", "inside", "--load", "push"}, 64, "the model has no [load"},
      {{"bound", "MODEL", "inside", "error", "--finite"}, 64, "nothing has an error"},
      {{"bound", "MODEL", "inside", "speed", "--finite"}, 64, "--finite is about error"},
      {{"bound", "MODEL", "inside", "error", "--finite", "--method", "reg"},
       64,
       "method: for a [closure]"},
      {{"bound", "MODEL", "inside", "error"}, 64, "add [actuators] error"},
      {{"bound", "MODEL", "inside", "crank*cos(theta)"}, 64, "[closure]"},
      {{"datasheet", "MODEL", "inside"},
       0,
       "condition number of the equations' derivatives in the 2-norm"},
  };
  for (const CommandOfClosure& command : all) {
    std::vector<std::string> words = {REGULUS_BINARY_DIR "/bin/regulus"};
    std::string typed;
    for (const std::string& word : command.words) {
      words.push_back(word == "MODEL" ? ShippedModel("four_bar").path() : word);
      typed += word + ' ';
    }
    const CommandResult result = run_command(words);
    EXPECT_EQ(result.exit_code, command.exit_code) << typed << result.errors;
    EXPECT_NE((result.output + result.errors).find(command.phrase), std::string::npos)
        << typed << result.output << result.errors;
  }
}

}  // namespace
}  // namespace regulus::detail::test
