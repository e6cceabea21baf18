// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets of the example robots against values at 10⁵ random places, computed from the matrix alone
// by Gaussian elimination: none may leave its bracket.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "codegen/bound/bound_run.hpp"
#include "codegen/feasibility/force_problem.hpp"
#include "codegen/formulation/variety.hpp"
#include "codegen/model/twist.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/regularity/aligned_buffer.hpp"

namespace regulus::test {
namespace {

constexpr int kPlaces = 100'000;

struct Robot {
  const char* model;
  const char* motion;
};

void PrintTo(const Robot& robot, std::ostream* out) { *out << robot.model; }

Request request_of(const Robot& robot) {
  ModelOptions options;
  options.path = std::string(REGULUS_SOURCE_DIR "/models/") + robot.model + ".toml";
  options.motion = robot.motion;
  return read_request(options);
}

double number(const GiNaC::ex& e) { return mid(enclose_constant(e, "a number")); }

/// J⁻¹ at random places of a motion, eight at a time.
class Inverses {
 public:
  explicit Inverses(const Request& request)
      : prepared_(prepare(with_scaled_rows(request), 0, options())),
        kernel_(prepared_.kernel->functions()),
        boxes_(2 * kLanes * kernel_.functions().variables),
        values_(2 * kLanes * kernel_.functions().rows * kernel_.functions().columns),
        scaling_(prepared_.stages->formulation().scaling) {}

  /// Returns those of eight places that are defined.
  std::vector<Eigen::MatrixXd> next(std::mt19937& random) {
    const regulus_kernel& f = kernel_.functions();
    for (unsigned v = 0; v < f.variables; ++v)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Interval range =
            prepared_.variety.inner[v].value_or(Interval(mid(prepared_.variety.outer[v])));
        boxes_[lower_at(v, lane)] = boxes_[upper_at(v, lane)] = place_in(range, random);
      }
    const LaneMask undefined = kernel_.call(f.matrix, boxes_.get(), nullptr, values_.get());
    std::vector<Eigen::MatrixXd> found;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (has_lane(undefined, lane)) continue;
      Eigen::MatrixXd J(f.rows, f.columns);
      for (unsigned i = 0; i < f.rows; ++i)
        for (unsigned j = 0; j < f.columns; ++j) {
          const std::size_t e = i * f.columns + j;
          J(i, j) = std::ldexp((values_[lower_at(e, lane)] + values_[upper_at(e, lane)]) / 2,
                               scaling_.empty() ? 0 : -scaling_.rows[i] - scaling_.columns[j]);
        }
      found.push_back(std::move(J));
    }
    return found;
  }

 private:
  static SearchOptions options() {
    SearchOptions search;
    search.method = Method::kReg;
    search.engine = Engine::kInterpreted;
    return search;
  }
  /// Extreme values are often at the ends.
  static double place_in(const Interval& range, std::mt19937& random) {
    const unsigned where = random() % 6;
    if (where < 2) return where == 0 ? range.lo : range.hi;
    const double t = std::uniform_real_distribution<double>(0, 1)(random);
    return std::clamp((1 - t) * range.lo + t * range.hi, range.lo, range.hi);
  }

  PreparedSearch prepared_;
  Kernel kernel_;
  AlignedBuffer boxes_, values_;
  MatrixScaling scaling_;
};

/// Returns a vector of the set.
Eigen::VectorXd sample(const VectorSet& set, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd v(Eigen::Index(set.entries.size()));
  for (std::size_t k = 0; k < set.entries.size(); ++k) {
    const double side = random() % 2 == 0 ? -1 : 1;
    const double spread = set.entries[k].ball < 0 ? number(set.entries[k].tolerance) : 0;
    v(Eigen::Index(k)) = number(set.entries[k].value) + side * spread;
  }
  for (const ToleranceBall& ball : set.balls) {
    Eigen::VectorXd d(Eigen::Index(ball.members.size()));
    for (auto& x : d) x = normal(random);
    d *= number(ball.radius) / d.norm();
    for (std::size_t m = 0; m < ball.members.size(); ++m)
      v(Eigen::Index(ball.members[m])) += d(Eigen::Index(m));
  }
  return v;
}

/// Some vectors of a set, which are expensive to make.
std::vector<Eigen::VectorXd> samples(const VectorSet* set, std::mt19937& random) {
  std::vector<Eigen::VectorXd> all;
  for (int k = 0; set != nullptr && k < 64; ++k) all.push_back(sample(*set, random));
  return all;
}

Eigen::MatrixXd in_one_unit(Eigen::MatrixXd J, const Model& model) {
  const std::vector<TwistComponent> twist = twist_of(model);
  for (std::size_t j = 0; j < twist.size(); ++j)
    if (twist[j].kind == TwistComponent::Kind::kAngular && model.characteristic_length)
      J.col(Eigen::Index(j)) /= number(*model.characteristic_length);
  return J;
}

double value_of(const Component& c, const Model& model, const Eigen::MatrixXd& J,
                const Eigen::VectorXd& w) {
  switch (c.kind) {
    case QuantityKind::kForce:
      return J.transpose().partialPivLu().solve(w)(Eigen::Index(c.row));
    case QuantityKind::kSpeed:
      return J.row(Eigen::Index(c.row)).dot(w);
    case QuantityKind::kSigmaMin:
    case QuantityKind::kSigmaMax: {
      const Eigen::VectorXd s =
          Eigen::JacobiSVD<Eigen::MatrixXd>(in_one_unit(J, model)).singularValues();
      return c.kind == QuantityKind::kSigmaMin ? s.minCoeff() : s.maxCoeff();
    }
    case QuantityKind::kDeterminant:
      return std::abs(J.determinant());
    default:
      return std::nan("");
  }
}

class ExampleRobots : public testing::TestWithParam<Robot> {
 protected:
  Request request_ = request_of(GetParam());
  Inverses inverses_{request_};
  std::mt19937 random_{1};

  Bound bound_of(const QuantityOptions& options) {
    BoundSettings settings;
    settings.gap = 0.1;
    settings.search.engine = Engine::kAuto;
    settings.search.threads = 1;
    settings.search.time_limit = 20;
    settings.output.quiet = true;
    return bound_quantity(request_, quantity_of(request_.model, options), settings,
                          [](const ComponentBound&) {});
  }

  void expect_inside(const Bound& bound) {
    const Component& first = bound.components.front().component;
    const std::vector<Eigen::VectorXd> vectors = samples(first.set, random_);
    std::vector<double> extreme(bound.components.size(), bound.quantity.is_least ? HUGE_VAL : 0);
    for (int place = 0; place < kPlaces;) {
      for (const Eigen::MatrixXd& J : inverses_.next(random_)) {
        const Eigen::VectorXd w = vectors.empty() ? Eigen::VectorXd() : vectors[random_() % 64];
        for (std::size_t i = 0; i < extreme.size(); ++i) {
          const double q = std::abs(value_of(bound.components[i].component, request_.model, J, w));
          extreme[i] = bound.quantity.is_least ? std::min(extreme[i], q) : std::max(extreme[i], q);
        }
      }
      place += int(kLanes);
    }
    for (std::size_t i = 0; i < extreme.size(); ++i) {
      const ComponentBound& c = bound.components[i];
      if (!c.proved) continue;
      const double slack = 1e-9 * (1 + extreme[i]);
      if (bound.quantity.is_least)
        EXPECT_GE(extreme[i], c.proved->approx - slack) << bound.quantity.name << c.component.label;
      else
        EXPECT_LE(extreme[i], c.proved->approx + slack) << bound.quantity.name << c.component.label;
    }
  }
};

TEST_P(ExampleRobots, HaveNoValueBeyondABracket) {
  std::size_t proved = 0;
  for (const char* quantity : {"force", "speed", "sigma-min", "sigma-max", "determinant"}) {
    const Bound bound = bound_of({.quantity = quantity});
    expect_inside(bound);
    for (const ComponentBound& c : bound.components) proved += c.proved ? 1 : 0;
  }
  EXPECT_GE(proved, 3U);
}

INSTANTIATE_TEST_SUITE_P(All, ExampleRobots,
                         testing::Values(Robot{"robot_1", "table4_5"},
                                         Robot{"robot_2", "table5_20"}, Robot{"octahedral", "work"},
                                         Robot{"delta", "work"}, Robot{"orthoglide", "cube"}),
                         [](const auto& robot) { return std::string(robot.param.model); });

}  // namespace
}  // namespace regulus::test
