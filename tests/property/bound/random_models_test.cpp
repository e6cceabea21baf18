// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets of random models against values that are computed directly, by Gaussian elimination, at
// random poses, loads and uncertain values: none may leave its bracket.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/decomposition.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::random_models {
namespace {

constexpr int kSamples = 2000;

/// A random model with the matrix diag(1/ρ)·M, M affine in x, y and an uncertain a, and its data.
/// The columns are two velocities and an angular velocity.
struct RandomModel {
  std::mt19937 random;
  // M(i, j) = c0 + cx·x + cy·y + ca·a
  std::array<std::array<std::array<int, 4>, 3>, 3> coefficients{};
  std::array<int, 3> rho{};  ///< ρ = rho + x²
  std::array<double, 3> load{}, spread{};
  std::vector<std::array<double, 2>> way;  ///< x and y of way-points; empty: a box
  double radius = 0;                       ///< of the force; 0: a box
  double tolerance = 0;

  explicit RandomModel(unsigned seed) : random(seed) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        coefficients[i][j] = {pick(-3, 3), pick(-1, 1), pick(-1, 1), pick(-1, 1)};
      coefficients[i][i][0] += 12;
      rho[i] = pick(1, 4);
      load[i] = pick(-2, 2);
      spread[i] = pick(0, 3) / 2.0;
    }
    radius = pick(0, 1) == 0 ? 0 : 1.5;
    tolerance = pick(0, 1) == 0 ? 0 : 0.25;
  }

  int pick(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); }
  double uniform(double lo, double hi) {
    // Extreme values are often at the ends.
    const int where = pick(0, 3);
    if (where < 2) return where == 0 ? lo : hi;
    return std::uniform_real_distribution<double>(lo, hi)(random);
  }

  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    out << "regulus = 1\nname = \"random\"\ncharacteristic_length = 2\n"
        << "[pose]\nx = \"m\"\ny = \"m\"\nphi = \"rad\"\n[geometry]\na = { value = 1, tolerance = "
        << tolerance << " }\n[matrix]\ntwist = [\"v_x\", \"v_y\", \"w\"]\nrows = [";
    for (const auto& row : coefficients) {
      out << "[";
      for (const auto& c : row)
        out << "\"" << c[0] << " + (" << c[1] << ")*x + (" << c[2] << ")*y + (" << c[3]
            << ")*a\", ";
      out << "], ";
    }
    out << "]\nrow_scale = [";
    for (const int r : rho) out << "\"1/(" << r << " + x^2)\", ";
    out << "]\n[load.w]\n";
    if (radius > 0)
      out << "force = { value = [" << load[0] << ", " << load[1] << "], radius = " << radius
          << " }\n";
    else
      out << "force = [" << range(0) << ", " << range(1) << "]\n";
    out << "moment = [" << range(2) << "]\n[twist.v]\ntwist = [" << range(0) << ", " << range(1)
        << ", " << range(2) << "]\n[actuators]\nerror = [0.5, 0.25, 1]\nstiffness = [2, 3, 4]\n"
        << "[motion.m]\nx = [-1, 1]\ny = [0, 1]\nphi = 0\n";
    return out.str();
  }

  [[nodiscard]] std::string range(int i) const {
    std::ostringstream out;
    out << "[" << load[i] - spread[i] << ", " << load[i] + spread[i] << "]";
    return out.str();
  }

  /// One place of the model.
  struct Place {
    Eigen::Matrix3d J;  ///< J⁻¹
    Eigen::Vector3d w, v, error;
  };

  /// Returns x and y of a place.
  std::array<double, 2> pose() {
    if (way.empty()) return {uniform(-1, 1), uniform(0, 1)};
    const auto segment = static_cast<std::size_t>(pick(0, static_cast<int>(way.size()) - 2));
    const double s = uniform(0, 1);
    const auto &from = way[segment], &to = way[segment + 1];
    return {from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])};
  }

  /// Chooses way-points, and returns the text of their file.
  std::string choose_way() {
    std::string text = "x,y\n";
    for (int k = 0; k < 6; ++k) {
      way.push_back({pick(-8, 8) / 8.0, pick(0, 8) / 8.0});
      text += std::to_string(way.back()[0]) + ',' + std::to_string(way.back()[1]) + '\n';
    }
    return text;
  }

  Place place() {
    const auto [x, y] = pose();
    const double a = uniform(1 - tolerance, 1 + tolerance);
    Place p;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto& c = coefficients[i][j];
        p.J(i, j) = (c[0] + c[1] * x + c[2] * y + c[3] * a) / (rho[i] + x * x);
      }
    for (int i = 0; i < 3; ++i) p.w(i) = p.v(i) = uniform(load[i] - spread[i], load[i] + spread[i]);
    if (radius > 0) {
      const double angle = uniform(0, 2 * M_PI), length = uniform(0, radius);
      p.w(0) = load[0] + length * std::cos(angle);
      p.w(1) = load[1] + length * std::sin(angle);
    }
    const std::array<double, 3> most{0.5, 0.25, 1};
    for (int i = 0; i < 3; ++i) p.error(i) = uniform(-most[i], most[i]);
    return p;
  }
};

/// Returns q at a place.
double value_of(const Component& c, const RandomModel::Place& p) {
  const Eigen::Matrix3d inverse = p.J.inverse();
  Eigen::Matrix3d in_one_unit = p.J;
  in_one_unit.col(2) /= 2;
  const Eigen::VectorXd singular = singular_values(in_one_unit);
  const Eigen::Matrix3d inverse_in_one_unit = in_one_unit.inverse();
  const auto row = Eigen::Index(c.row), column = Eigen::Index(c.column);
  double q = 0;
  switch (c.kind) {
    case QuantityKind::kForce:
      q = (inverse.transpose() * p.w)(row);
      break;
    case QuantityKind::kError: {
      const Eigen::Vector3d moved = inverse * p.error;
      q = c.part == PosePart::kLinear ? moved.head<2>().norm() : moved(column);
      break;
    }
    case QuantityKind::kSpeed:
      q = (p.J * p.v)(row);
      break;
    case QuantityKind::kSigmaMin:
      return singular(2);
    case QuantityKind::kSigmaMax:
      return singular(0);
    case QuantityKind::kCondition:
      return in_one_unit.row(row).lpNorm<1>() * inverse_in_one_unit.row(column).lpNorm<1>();
    case QuantityKind::kCondition2:
      return singular(0) / singular(2);
    case QuantityKind::kDeflection: {
      const Eigen::Vector3d force = inverse.transpose() * p.w;
      q = (inverse * force.cwiseQuotient(Eigen::Vector3d(2, 3, 4)))(column);
      break;
    }
    case QuantityKind::kDeterminant:
      return std::abs(p.J.determinant());
    case QuantityKind::kDeterminantMax:
      q = p.J.determinant();
      break;
    case QuantityKind::kFiniteError:
    case QuantityKind::kExpression:
      break;
  }
  return c.is_absolute ? std::abs(q) : q;
}

Bound bound_of(const Request& request, const QuantityOptions& options) {
  BoundSettings settings;
  settings.gap = 0.02;
  settings.search.engine = Engine::kAuto;
  settings.search.threads = 1;
  settings.search.time_limit = 5;
  settings.output.quiet = true;
  return bound_quantity(request, quantity_of(request.model, options), settings,
                        [](const ComponentBound&) {});
}

bool is_least(const Component& c) {
  return c.sign < 0 || c.kind == QuantityKind::kSigmaMin || c.kind == QuantityKind::kDeterminant;
}

/// Checks a bracket against samples; returns true if it is closed.
bool agrees(RandomModel& model, const ComponentBound& bound) {
  const bool least = is_least(bound.component);
  double extreme = least ? HUGE_VAL : -HUGE_VAL;
  for (int k = 0; k < kSamples; ++k) {
    const double q = value_of(bound.component, model.place());
    extreme = least ? std::min(extreme, q) : std::max(extreme, q);
  }
  const double slack = 1e-9 * (1 + std::abs(extreme));
  if (bound.proved) {
    EXPECT_TRUE(least ? extreme >= bound.proved->approx - slack
                      : extreme <= bound.proved->approx + slack)
        << bound.component.label << ": sampled " << extreme << ", proved " << bound.proved->approx;
  }
  if (bound.attained && bound.proved) {
    EXPECT_TRUE(least ? bound.attained->approx >= bound.proved->approx
                      : bound.attained->approx <= bound.proved->approx);
  }
  return bound.is_closed;
}

std::string name_of(const testing::TestParamInfo<QuantityOptions>& info) {
  std::string name = info.param.quantity;
  std::erase(name, '-');
  return name + info.param.norm +
         (info.param.least       ? "Least"
          : info.param.is_signed ? "Signed"
                                 : "");
}

class RandomModels : public testing::TestWithParam<QuantityOptions> {};

TEST_P(RandomModels, HaveNoValueBeyondABracket) {
  int closed = 0, all = 0;
  for (unsigned seed = 1; seed <= unsigned(trials(3, 10)); ++seed) {
    RandomModel model(seed);
    SCOPED_TRACE(model.text());
    Request request;
    request.model = parse_model(model.text(), "random.toml");
    request.motion = request.model.motions.front();
    const Bound bound = bound_of(request, GetParam());
    for (const ComponentBound& c : bound.components) {
      closed += agrees(model, c) ? 1 : 0;
      ++all;
    }
  }
  // A bracket about 0, or of a quantity that is nearly the same at many poses, needs more time.
  EXPECT_GE(closed, all * 2 / 5) << "of " << all;
}

TEST_P(RandomModels, HaveNoValueBeyondABracketAlongWayPoints) {
  const TemporaryDirectory folder;
  const std::string file = folder.path() / "way.csv";
  int closed = 0, all = 0;
  for (unsigned seed = 1; seed <= unsigned(trials(2, 5)); ++seed) {
    RandomModel model(seed);
    std::ofstream(file) << model.choose_way();
    SCOPED_TRACE(model.text());
    Request request;
    request.model = parse_model(model.text(), "random.toml");
    request.motion = request.model.motions.front();
    follow_waypoints(request.model, request.motion, file);
    const Bound bound = bound_of(request, GetParam());
    for (const ComponentBound& c : bound.components) {
      closed += agrees(model, c) ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GE(closed, all * 2 / 5) << "of " << all;
}

INSTANTIATE_TEST_SUITE_P(
    All, RandomModels,
    testing::Values(
        QuantityOptions{.quantity = "force"}, QuantityOptions{.quantity = "force", .least = true},
        QuantityOptions{.quantity = "force", .is_signed = true},
        QuantityOptions{.quantity = "speed"}, QuantityOptions{.quantity = "speed", .least = true},
        QuantityOptions{.quantity = "error"}, QuantityOptions{.quantity = "sigma-min"},
        QuantityOptions{.quantity = "sigma-max"}, QuantityOptions{.quantity = "condition"},
        QuantityOptions{.quantity = "condition", .norm = "2"},
        QuantityOptions{.quantity = "deflection"},
        QuantityOptions{.quantity = "deflection", .is_signed = true},
        QuantityOptions{.quantity = "determinant"},
        QuantityOptions{.quantity = "determinant", .least = true},
        QuantityOptions{.quantity = "determinant", .is_signed = true},
        QuantityOptions{.quantity = "determinant-max"}),
    name_of);

}  // namespace
}  // namespace regulus::detail::test::random_models
