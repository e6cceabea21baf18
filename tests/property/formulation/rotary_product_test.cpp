// SPDX-License-Identifier: GPL-3.0-or-later
// K·A with symbols for the parts of rotary legs is K·A: the oracle is A itself, multiplied by K in
// intervals. Its derivatives obey the mean value theorem.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "runtime/interval/arithmetic.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/lanes.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus {
namespace {

using Random = test::RandomSource;
using Box = std::vector<Interval>;

class RotaryKernel {
 public:
  RotaryKernel(const Model& model, const Motion& motion, ExpansionForm form)
      : formulation_(formulate(model, motion, options(form))),
        module_(lower(formulation_)),
        kernel_(select(module_), best_isa()),
        variety_(enclose_variety(model, motion, formulation_.variables)) {}

  [[nodiscard]] const regulus_kernel& kernel() const { return *kernel_.get(); }
  [[nodiscard]] const Box& range() const { return variety_.outer; }
  [[nodiscard]] std::size_t variables() const { return kernel().variables; }
  [[nodiscard]] std::size_t m() const { return kernel().rows; }
  [[nodiscard]] std::size_t n() const { return kernel().columns; }

  /// True if K·A was formed with a crank that is turned by an angle.
  [[nodiscard]] bool uses_angles() const {
    for (const Function& f : module_.functions)
      if (f.name == "left_product" || f.name == "nominal_product")
        for (const Node& node : f.program.nodes)
          if (node.op == Op::kAtan2) return true;
    return false;
  }

  /// Empty where the function is undefined.
  [[nodiscard]] Box values(regulus_function f, std::size_t outputs, const Box& box) const {
    AlignedBuffer in(2 * kLanes * box.size()), out(2 * kLanes * outputs), K(kLanes * m() * n());
    for (std::size_t e = 0; e < m() * n(); ++e) std::fill_n(K.get() + point_at(e, 0), kLanes, k(e));
    for (std::size_t v = 0; v < box.size(); ++v) {
      std::fill_n(in.get() + lower_at(v, 0), kLanes, box[v].lo);
      std::fill_n(in.get() + upper_at(v, 0), kLanes, box[v].hi);
    }
    Box result;
    if (CheckedKernel(kernel()).call(f, in.get(), K.get(), out.get()) != 0) return result;
    for (std::size_t e = 0; e < outputs; ++e)
      result.emplace_back(out[lower_at(e, 0)], out[upper_at(e, 0)]);
    return result;
  }

  /// An entry of K.
  [[nodiscard]] static double k(std::size_t e) {
    return 0.25 * static_cast<double>((5 * e) % 7) - 0.625;
  }

  /// K·A from A; empty where it is undefined.
  [[nodiscard]] Box product_of(const Box& box) const {
    const Box A = values(kernel().matrix, m() * n(), box);
    Box result;
    if (A.empty()) return result;
    for (std::size_t i = 0; i < n(); ++i)
      for (std::size_t j = 0; j < n(); ++j) {
        Interval entry(0.0);
        for (std::size_t l = 0; l < m(); ++l)
          entry = entry + Interval(k(i * m() + l)) * A[l * n() + j];
        result.push_back(entry);
      }
    return result;
  }

 private:
  static FormulationOptions options(ExpansionForm form) {
    FormulationOptions options;
    options.expansion = form;
    return options;
  }

  Formulation formulation_;
  Module module_;
  machine::MachineKernel kernel_;
  Variety variety_;
};

double magnitude(const Box& values) {
  double most = 0;
  for (const Interval& x : values) most = std::max(most, mag(x));
  return most;
}

/// Tests entries against others that enclose the same numbers.
void expect_same(const Box& found, const Box& expected, const char* what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t e = 0; e < found.size(); ++e)
    EXPECT_FALSE(certain_disjoint(found[e], expected[e]))
        << what << ' ' << e << ": [" << found[e].lo << ", " << found[e].hi << "] and ["
        << expected[e].lo << ", " << expected[e].hi << ']';
}

/// What was compared, so that a test that compares nothing is seen.
struct Count {
  int points = 0, boxes = 0, steps = 0, second_steps = 0, turned = 0;
};

using Places = std::map<std::array<unsigned, 4>, Interval>;

Places listed(const RotaryKernel& f, const regulus_derivatives& d, const Box& box) {
  Places result;
  if (d.count == 0) return result;
  const Box all = f.values(d.function, d.count, box);
  for (unsigned i = 0; i < all.size(); ++i)
    result[{d.list[i].row, d.list[i].column, d.list[i].first, d.list[i].second}] = all[i];
  return result;
}

Interval at(const Places& places, std::array<unsigned, 4> place) {
  const auto found = places.find(place);
  return found == places.end() ? Interval(0.0) : found->second;
}

/// The kernel's K·A at points and over boxes.
void compare_products(const RotaryKernel& f, const Box& point, const Box& box, Count& count) {
  const regulus_kernel& kernel = f.kernel();
  const Box expected = f.product_of(point);
  if (expected.empty() || kernel.left_product == nullptr) return;
  const std::size_t n = f.n();
  const Box left = f.values(kernel.left_product, n * n, point);
  if (!left.empty()) {
    ++count.points;
    expect_same(left, expected, "K·A at a point");
    for (const Interval& x : left)
      EXPECT_LE(x.hi - x.lo, 1e-8 * (1 + magnitude(expected))) << "a wide enclosure of a point";
  }
  const Box over = f.values(kernel.left_product, n * n, box);
  if (over.empty()) return;
  ++count.boxes;
  expect_same(over, expected, "K·A over a box");
}

/// Steps from a point along each variable: differences are steps times a value of the derivative.
void compare_derivatives(const RotaryKernel& f, const Box& point, const Box& box, Count& count) {
  const regulus_kernel& kernel = f.kernel();
  if (kernel.left_derivatives == nullptr || kernel.left_product == nullptr) return;
  const std::size_t n = f.n(), variables = f.variables();
  const Box before = f.product_of(point);
  const Box D_before = f.values(kernel.left_derivatives, variables * n * n, point);
  const Box D = f.values(kernel.left_derivatives, variables * n * n, box);
  if (before.empty() || D_before.empty() || D.empty()) return;
  const Places second = listed(f, kernel.expansion->second, box);
  for (std::size_t v = 0; v < variables; ++v) {
    Box moved = point;
    moved[v] = Interval(point[v].lo < mid(box[v]) ? box[v].hi : box[v].lo);
    const Interval step = moved[v] - point[v];
    const Box after = f.product_of(moved);
    if (after.empty()) continue;
    ++count.steps;
    for (std::size_t e = 0; e < n * n; ++e)
      EXPECT_FALSE(certain_disjoint(after[e] - before[e], step * D[v * n * n + e]))
          << "entry " << e << " by variable " << v;
    const Box D_after = f.values(kernel.left_derivatives, variables * n * n, moved);
    if (D_after.empty() || second.empty()) continue;
    ++count.second_steps;
    for (std::size_t w = 0; w < variables; ++w)
      for (std::size_t e = 0; e < n * n; ++e) {
        const Interval slope = at(second, {unsigned(e / n), unsigned(e % n),
                                           unsigned(std::min(v, w)), unsigned(std::max(v, w))});
        EXPECT_FALSE(
            certain_disjoint(D_after[w * n * n + e] - D_before[w * n * n + e], step * slope))
            << "derivative of entry " << e << " by " << w << " and " << v;
      }
  }
}

void compare(const Model& model, const Motion& motion, Random& random, Count& count) {
  const RotaryKernel f(model, motion, ExpansionForm::kAtBox);
  count.turned += f.uses_angles();
  for (int trial = 0; trial < 12; ++trial) {
    Box point, box;
    const double part = random.one_in(2) ? 0.01 : 0.2;
    for (const Interval& range : f.range()) {
      const double x = random.between(range.lo, range.hi), half = part * (range.hi - range.lo);
      box.emplace_back(std::max(range.lo, x - half * random.unit()),
                       std::min(range.hi, x + half * random.unit()));
      point.emplace_back(std::clamp(x, box.back().lo, box.back().hi));
    }
    compare_products(f, point, box, count);
    compare_derivatives(f, point, box, count);
  }
}

struct Vector {
  double x, y, z;
};

double norm(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Two digits, as people write dimensions.
double digits(double x) { return std::round(100 * x) / 100; }

/// A leg whose rod reaches the platform at home: crank and rod, or rail and rod.
std::string random_leg(const std::string& type, const Vector& home, Random& random) {
  static const Vector axes[] = {{1, 0, 0},      {0, -1, 0}, {0, 0, 1},  {3, 4, 0},
                                {0, 0.6, -0.8}, {1, 1, 0},  {-2, 1, 2}, {0.96, -0.28, 0}};
  const bool planar = type == "RRR";
  const auto point = [&](double size) {
    return Vector{digits(random.between(-size, size)), digits(random.between(-size, size)),
                  planar ? 0 : digits(random.between(-size / 8, size / 8))};
  };
  const Vector A = point(90), B = point(60), v = point(50);
  const Vector n = planar ? Vector{0, 0, 1} : axes[random.below(std::size(axes))];
  Vector u{n.y * v.z - n.z * v.y, n.z * v.x - n.x * v.z, n.x * v.y - n.y * v.x};
  if (type == "PUS") u = n;
  const double length = digits(random.between(25, 45)), scale = length / norm(u);
  const double rod =
      digits(norm({home.x + B.x - A.x - scale * u.x, home.y + B.y - A.y - scale * u.y,
                   home.z + B.z - A.z - scale * u.z}));
  std::ostringstream text;
  const auto write = [&](const char* key, const Vector& p) {
    text << key << " = [" << p.x << ", " << p.y;
    if (!planar) text << ", " << p.z;
    text << "]\n";
  };
  text << "[[legs.leg]]\ntype = \"" << type << "\"\n";
  write("base", A);
  write("platform", B);
  if (!planar) write("axis", n);
  if (type != "PUS") text << "crank = " << length << '\n';
  text << "rod = " << rod << "\nmode = \"" << (random.one_in(2) ? '+' : '-') << "\"\n";
  return text.str();
}

Model random_robot(const std::string& type, Random& random) {
  const bool planar = type == "RRR";
  const Vector home{digits(random.between(-30, 30)), digits(random.between(-30, 30)),
                    planar ? 0 : digits(random.between(60, 140) * (random.one_in(3) ? -1 : 1))};
  std::ostringstream text;
  text << "regulus = 1\nname = \"random\"\n[legs]\nunit = \"mm\"\n";
  if (!planar) text << "orientation = \"roll-pitch-yaw\"\n";
  for (int i = 0; i < (planar ? 3 : 6); ++i) text << random_leg(type, home, random);
  const auto range = [&](const char* name, double middle, double half) {
    text << name << " = [" << middle - half << ", " << middle + half << "]\n";
  };
  text << "[motion.work]\n";
  range("x", home.x, 3);
  range("y", home.y, 3);
  if (planar) {
    range("phi", 0, 0.05);
  } else {
    range("z", home.z, 3);
    for (const char* angle : {"roll", "pitch", "yaw"}) range(angle, 0, 0.05);
  }
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text.str();
  return load_model(path);
}

void compare_random(const std::string& type, int robots, std::uint64_t seed, Count& count) {
  Random random(seed);
  for (int i = 0; i < robots; ++i) {
    const Model model = random_robot(type, random);
    compare(model, find_motion(model, "work"), random, count);
    if (::testing::Test::HasFailure()) break;
  }
}

TEST(RotaryProductProperty, IsTheNumericProductOfRandomRobotsWithCranks) {
  Count count;
  compare_random("RUS", 6, 11, count);
  EXPECT_GE(count.points, 20);
  EXPECT_GE(count.boxes, 10);
  EXPECT_GE(count.steps, 50);
  EXPECT_GE(count.second_steps, 50);
  EXPECT_GE(count.turned, 3);
}

TEST(RotaryProductProperty, IsTheNumericProductOfRandomRobotsInThePlane) {
  Count count;
  compare_random("RRR", 40, 12, count);
  EXPECT_GE(count.points, 100);
  EXPECT_GE(count.second_steps, 100);
  EXPECT_GE(count.turned, 20);
}

TEST(RotaryProductProperty, IsTheNumericProductOfRandomRobotsOnRails) {
  Count count;
  compare_random("PUS", 6, 13, count);
  EXPECT_GE(count.points, 20);
  EXPECT_GE(count.steps, 50);
}

TEST(RotaryProductProperty, IsTheNumericProductOfTheModels) {
  Count count;
  Random random(14);
  for (const auto& [file, motion] :
       {std::pair("hexapod_6rus", "work"), std::pair("hexapod_6rus", "orbit"),
        std::pair("delta", "work"), std::pair("planar_3rrr", "regular"),
        std::pair("planar_3rrr", "circle")}) {
    Model model = load_model(std::string(REGULUS_SOURCE_DIR "/models/") + file + ".toml");
    compare(model, find_motion(model, motion), random, count);
  }
  EXPECT_GE(count.points, 50);
  EXPECT_GE(count.second_steps, 100);
  EXPECT_EQ(count.turned, 5);
}

TEST(RotaryProductProperty, HoldsForUncertainLengths) {
  Count count;
  Random random(15);
  Model model = load_model(REGULUS_SOURCE_DIR "/models/hexapod_6rus.toml");
  set_tolerance(model, "cranks,rods,platform", "0.05");
  compare(model, find_motion(model, "work"), random, count);
  Model planar = load_model(REGULUS_SOURCE_DIR "/models/planar_3rrr.toml");
  set_tolerance(planar, "links", "0.05");
  for (int i = 0; i < 4; ++i) compare(planar, find_motion(planar, "regular"), random, count);
  EXPECT_GE(count.points, 20);
  EXPECT_GE(count.steps, 100);
}

}  // namespace
}  // namespace regulus
