// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets of every quantity of the example robots against values at 10⁶ random places, computed
// from the matrix alone by Gaussian elimination: none may leave its bracket.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/bound/datasheet.hpp"
#include "codegen/question/load/force_problem.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/regularity/aligned_buffer.hpp"

namespace regulus::detail::test {
namespace {

constexpr int kPlaces = 1'000'000;
/// A value is computed from a matrix of rounded entries, in doubles, with condition numbers up to
/// 2·10³. The true value is nearer to it than this part, so a value that keeps so far away from the
/// proved end is certainly within the bracket.
constexpr double kRounding = 1e-9;

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
  CheckedKernel kernel_;
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

/// The numbers of a model, which are expensive to compute.
struct Machine {
  explicit Machine(const Model& model)
      : error(numbers(model.actuators.error)),
        stiffness(numbers(model.actuators.stiffness)),
        twist(twist_of(model)),
        to_one_unit(Eigen::VectorXd::Ones(Eigen::Index(model.matrix.cols()))) {
    for (std::size_t j = 0; j < twist.size(); ++j)
      if (twist[j].kind == TwistComponent::Kind::kAngular && model.characteristic_length)
        to_one_unit(Eigen::Index(j)) = 1 / number(*model.characteristic_length);
  }

  static Eigen::VectorXd numbers(const std::vector<GiNaC::ex>& list) {
    Eigen::VectorXd all(Eigen::Index(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) all(Eigen::Index(i)) = number(list[i]);
    return all;
  }

  Eigen::VectorXd error, stiffness;
  std::vector<TwistComponent> twist;
  Eigen::VectorXd to_one_unit;
};

/// All values at one place. A quantity without a formula here gives NaN.
class Values {
 public:
  Values(const Machine& machine, const Eigen::MatrixXd& J)
      : machine_(machine), J_(J), in_one_unit_(J * machine.to_one_unit.asDiagonal()) {
    if (J.rows() == J.cols()) inverse_ = J.partialPivLu().inverse();
  }

  /// `w`: of the component's load or twist; `signs`: of the errors of the motors.
  [[nodiscard]] double of(const Component& c, const Eigen::VectorXd& w,
                          const Eigen::VectorXd& signs) {
    const auto row = Eigen::Index(c.row), column = Eigen::Index(c.column);
    switch (c.kind) {
      case QuantityKind::kForce:
        return inverse_.col(row).dot(w);
      case QuantityKind::kSpeed:
        return J_.row(row).dot(w);
      case QuantityKind::kError:
        return freedom(inverse_ * signs.cwiseProduct(machine_.error), c);
      case QuantityKind::kDeflection: {
        const Eigen::VectorXd forces = inverse_.transpose() * w;
        return freedom(inverse_ * forces.cwiseQuotient(machine_.stiffness), c);
      }
      case QuantityKind::kSigmaMin:
        return singular_values().minCoeff();
      case QuantityKind::kSigmaMax:
        return singular_values().maxCoeff();
      case QuantityKind::kCondition:
        return in_one_unit_.row(row).cwiseAbs().sum() * inverse_.row(column).cwiseAbs().sum() /
               machine_.to_one_unit(column);
      case QuantityKind::kCondition2:
        return singular_values().maxCoeff() / singular_values().minCoeff();
      case QuantityKind::kDeterminant:
        return std::abs(J_.determinant());
      default:
        return std::nan("");
    }
  }

 private:
  /// Returns one freedom of a displacement, or the length of a part of it.
  [[nodiscard]] double freedom(const Eigen::VectorXd& dx, const Component& c) const {
    if (c.part == PosePart::kColumn) return dx(Eigen::Index(c.column));
    const auto kind = c.part == PosePart::kLinear ? TwistComponent::Kind::kLinear
                                                  : TwistComponent::Kind::kAngular;
    double sum = 0;
    for (std::size_t k = 0; k < machine_.twist.size(); ++k)
      if (machine_.twist[k].kind == kind) sum += dx(Eigen::Index(k)) * dx(Eigen::Index(k));
    return std::sqrt(sum);
  }

  [[nodiscard]] const Eigen::VectorXd& singular_values() {
    if (singular_values_.size() == 0) {
      const Eigen::MatrixXd square = in_one_unit_.transpose() * in_one_unit_;
      singular_values_ =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(square, Eigen::EigenvaluesOnly)
              .eigenvalues()
              .cwiseMax(0)
              .cwiseSqrt();
    }
    return singular_values_;
  }

  const Machine& machine_;
  const Eigen::MatrixXd& J_;
  Eigen::MatrixXd in_one_unit_, inverse_;
  Eigen::VectorXd singular_values_;
};

/// The extreme value of a component among the samples.
struct Extreme {
  const ComponentBound* bound;
  bool is_least;
  std::vector<Eigen::VectorXd> vectors;  ///< of its load or twist
  double value;

  void add(double q) {
    const Component& c = bound->component;
    q = c.is_absolute ? std::abs(q) : q;
    value = is_least ? std::min(value, q) : std::max(value, q);
  }
};

class ExampleRobots : public testing::TestWithParam<Robot> {
 protected:
  Datasheet datasheet() {
    BoundSettings settings;
    settings.gap = 0.1;
    settings.search.engine = Engine::kAuto;
    settings.search.threads = 1;
    settings.search.time_limit = 120;
    settings.output.quiet = true;
    return make_datasheet(request_, settings, [](const ComponentBound&) {});
  }

  std::vector<Extreme> extremes_of(const Datasheet& sheet) {
    std::vector<Extreme> all;
    for (const Bound& bound : sheet.bounds)
      for (const ComponentBound& c : bound.components) {
        const bool least = bound.quantity.is_least;
        if (c.proved)
          all.push_back(
              {&c, least, samples(c.component.set, random_), least ? HUGE_VAL : -HUGE_VAL});
      }
    return all;
  }

  void sample(std::vector<Extreme>& extremes) {
    const Machine machine(request_.model);
    Eigen::VectorXd signs;
    for (int place = 0; place < kPlaces; place += int(kLanes))
      for (const Eigen::MatrixXd& J : inverses_.next(random_)) {
        signs.resize(J.rows());
        for (auto& sign : signs) sign = random_() % 2 == 0 ? -1 : 1;
        Values values(machine, J);
        for (Extreme& extreme : extremes) {
          static const Eigen::VectorXd none;
          const auto& vectors = extreme.vectors;
          const auto& w = vectors.empty() ? none : vectors[random_() % vectors.size()];
          extreme.add(values.of(extreme.bound->component, w, signs));
        }
      }
  }

  Request request_ = request_of(GetParam());
  Inverses inverses_{request_};
  std::mt19937 random_{1};
};

TEST_P(ExampleRobots, HaveNoValueBeyondABracket) {
  const Datasheet sheet = datasheet();
  std::vector<Extreme> extremes = extremes_of(sheet);
  ASSERT_FALSE(extremes.empty());
  ASSERT_TRUE(request_.motion.constraints.empty());
  sample(extremes);
  for (const Extreme& extreme : extremes) {
    const double proved = extreme.bound->proved->approx, value = extreme.value;
    const double rounding = kRounding * std::abs(value);
    SCOPED_TRACE(std::to_string(int(extreme.bound->component.kind)) + " of " +
                 extreme.bound->component.label);
    ASSERT_TRUE(std::isfinite(value));
    // The motor does not touch this freedom.
    if (extreme.bound->proved->exact.is_zero()) {
      EXPECT_EQ(value, 0);
      continue;
    }
    if (extreme.is_least)
      EXPECT_GT(value - rounding, proved);
    else
      EXPECT_LT(value + rounding, proved);
  }
}

// Motions without constraints. Robots that are left out have no quantity, such as serial arms, or
// are singular everywhere.
INSTANTIATE_TEST_SUITE_P(All, ExampleRobots,
                         testing::Values(Robot{"robot_1", "table4_5"},
                                         Robot{"robot_2", "table5_20"}, Robot{"octahedral", "work"},
                                         Robot{"delta", "work"}, Robot{"orthoglide", "cube"},
                                         Robot{"hexapod_6rus", "work"}, Robot{"agile_eye", "wide"},
                                         Robot{"planar_3rpr", "regular"},
                                         Robot{"planar_3rrr", "regular"},
                                         Robot{"tsai_3upu", "inside"},
                                         Robot{"tsai_3upu_reduced", "wide"}),
                         [](const auto& robot) { return std::string(robot.param.model); });

}  // namespace
}  // namespace regulus::detail::test
