// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/arm_comparison.hpp"

#include <algorithm>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/model/constant_rows.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfView = 1 << 19;  ///< for the entries of both matrices
constexpr std::uint64_t kProductsOfDeterminants = 1 << 23;
constexpr long kBitsOfArm = 512;
constexpr int kPointsOfArm = 6;

/// Six rows.
std::vector<NodeId> entries_of(const TwistColumns& twists) {
  std::vector<NodeId> result;
  for (std::size_t row = 0; row < 6; ++row)
    for (const TwistNodes& t : twists)
      result.push_back(row < 3 ? t.velocity[row] : t.spin[row - 3]);
  return result;
}

/// The Jacobian from one point of one link.
struct Seen {
  std::vector<NodeId> jacobian;
  std::vector<NodeId> chain;  ///< the same, with a column for each follower, for any pose
  std::vector<NodeId> poses;  ///< that are variables
};

/// It beside the certificate's matrix.
class View {
 public:
  /// `finds_units`: for joints that follow others by fractions. It is slow with many numbers as angles.
  View(Question& q, const Seen& seen, std::size_t joints, std::uint64_t products, bool finds_units)
      : q_(q),
        joints_(joints),
        jacobian_(seen.jacobian),
        chain_(seen.chain),
        budget_(products),
        algebra_(q.graph, none_, Algebra::Form::kFull, budget_) {
    algebra_.keep_whole(seen.poses);
    if (!finds_units) return;
    std::vector<NodeId> roots = jacobian_;
    roots.insert(roots.end(), chain_.begin(), chain_.end());
    roots.insert(roots.end(), q_.matrix.begin(), q_.matrix.end());
    algebra_.find_units(roots);
  }

  /// Returns true if the matrix, or its transpose, consists of rows of the Jacobian on which its other
  /// rows depend at all poses alike.
  bool has_rows_of_matrix() {
    const bool is_transposed = q_.columns != joints_ || (q_.rows < joints_);
    const std::size_t rows = is_transposed ? q_.columns : q_.rows;
    if ((is_transposed ? q_.rows : q_.columns) != joints_ || rows > 6) return false;
    std::vector<bool> kept(6, false);
    std::size_t next = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      while (next < 6 && !is_row(next, row, is_transposed)) ++next;
      if (next == 6) return false;
      kept[next++] = true;
    }
    return are_enough(kept, is_transposed);
  }

  /// Returns the rows of the Jacobian that do not depend on earlier ones; nullopt: unknown.
  std::optional<std::vector<std::size_t>> independent_rows() {
    ConstantSpan span(q_.graph, algebra_);
    std::vector<std::size_t> result;
    for (std::size_t row = 0; row < 6; ++row) {
      const auto answer = span.add(row_of(row));
      if (answer == ConstantSpan::Answer::kUnknown) return std::nullopt;
      if (answer == ConstantSpan::Answer::kIndependent) result.push_back(row);
    }
    return result;
  }

  /// Returns true if the determinants of the matrix and of these rows differ by a factor that is the
  /// same number, not 0, at all poses; with a threshold, by their signs at most.
  bool has_determinant_of_matrix(const std::vector<std::size_t>& rows) {
    if (q_.rows != joints_ || q_.columns != joints_ || rows.size() != joints_) return false;
    const Polynomial of_matrix = algebra_.determinant(q_.matrix, joints_);
    const Polynomial of_arm = algebra_.determinant(selected(rows), joints_);
    if (of_arm.is_zero() || of_matrix.is_zero())
      return algebra_.vanishes(of_arm) && algebra_.vanishes(of_matrix);
    const ConstantFactors ours = constant_factors(algebra_, of_arm),
                          theirs = constant_factors(algebra_, of_matrix);
    const auto& [powers, factor] = *ours.begin();
    const auto like = theirs.find(powers);
    if (like == theirs.end()) return false;
    ConstantSigns signs(q_.graph, algebra_);
    if (signs.of(factor) != ConstantSigns::Answer::kNonzero ||
        signs.of(like->second) != ConstantSigns::Answer::kNonzero)
      return false;
    if (q_.has_threshold && !are_equal_up_to_sign(factor, like->second)) return false;
    Polynomial difference = algebra_.product(of_matrix, factor);
    difference.add(algebra_.product(of_arm, like->second).scaled(Rational(-1)));
    return algebra_.vanishes(difference);
  }

  [[nodiscard]] std::vector<NodeId> selected(const std::vector<std::size_t>& rows) const {
    std::vector<NodeId> result;
    for (const std::size_t row : rows)
      for (std::size_t j = 0; j < joints_; ++j) result.push_back(jacobian_[row * joints_ + j]);
    return result;
  }

  std::size_t terms() {
    std::size_t count = 0;
    for (const NodeId entry : jacobian_) count += algebra_.of(entry).terms().size();
    return count;
  }

 private:
  PolynomialRow row_of(std::size_t row) {
    const std::size_t joints = chain_.size() / 6;
    PolynomialRow result;
    for (std::size_t j = 0; j < joints; ++j)
      result.push_back(algebra_.of(chain_[row * joints + j]));
    return result;
  }

  bool is_row(std::size_t own, std::size_t row, bool is_transposed) {
    for (std::size_t j = 0; j < joints_; ++j) {
      const NodeId stated =
          is_transposed ? q_.matrix[j * q_.columns + row] : q_.matrix[row * q_.columns + j];
      Polynomial difference = algebra_.of(jacobian_[own * joints_ + j]);
      difference.add(algebra_.of(stated).scaled(Rational(-1)));
      if (!algebra_.vanishes(difference)) return false;
    }
    return true;
  }

  /// Returns true if the other rows are combinations of these. If there are more joints than rows,
  /// no row must be a combination of others, either.
  bool are_enough(const std::vector<bool>& kept, bool is_transposed) {
    using Answer = ConstantSpan::Answer;
    ConstantSpan span(q_.graph, algebra_);
    for (std::size_t row = 0; row < 6; ++row)
      if (kept[row] && span.add(row_of(row)) == Answer::kDependent && is_transposed) return false;
    for (std::size_t row = 0; row < 6; ++row)
      if (!kept[row] && span.add(row_of(row)) != Answer::kDependent) return false;
    return true;
  }

  bool are_equal_up_to_sign(const Polynomial& a, const Polynomial& b) {
    for (const long sign : {1, -1}) {
      Polynomial difference = a;
      difference.add(b.scaled(Rational(sign)));
      if (algebra_.vanishes(difference)) return true;
    }
    return false;
  }

  Question& q_;
  const std::size_t joints_;
  const std::vector<NodeId> jacobian_, chain_, none_;
  AlgebraBudget budget_;
  Algebra algebra_;
};

class ArmComparison {
 public:
  ArmComparison(SectionComparer& comparer, const std::vector<ChainJoint>& chain,
                std::size_t columns)
      : comparer_(comparer),
        q_(comparer.question()),
        joints_(columns),
        free_chain_(chain),
        chain_view_(comparer, chain, columns),
        free_view_(comparer, free_chain_, columns) {
    for (ChainJoint& joint : free_chain_) {
      joint.value = joint.free_value;
      poses_.push_back(joint.free_pose);
    }
  }

  void run() {
    const FilePlace from{"serial.joints", 0, "the joints of an arm"};
    if (q_.load) return comparer_.leave_out(from, "an arm has no forces of motors");
    if (q_.quantity && q_.quantity->kind != format::kExpression)
      return comparer_.leave_out(from,
                                 "only expressions of an arm can be bounded: its matrix has a "
                                 "frame and a scale of its own");
    if (!q_.scale.empty()) comparer_.refuse(from, "row scales");
    if (is_shown()) {
      for (std::size_t e = 0; e < q_.matrix.size(); ++e)
        comparer_.note_compared("entry " + std::to_string(e));
      return;
    }
    if (is_refuted()) comparer_.refuse(from, "a matrix that is not that of their Jacobian");
    comparer_.leave_out(
        from, obstacle_.empty() ? "the matrix is not shown to be the Jacobian's" : obstacle_);
  }

 private:
  bool is_shown() {
    if (is_shown_by_views()) return true;
    if (is_refuted()) return false;
    finds_units_ = true;
    views_.clear(), order_.clear(), tried_ = 0, obstacle_.clear();
    return is_shown_by_views();
  }

  bool is_shown_by_views() {
    for (const std::size_t link : chain_view_.links()) {
      const TwistColumns twists = chain_view_.with_followers(chain_view_.twists(link));
      const TwistColumns of_chain = free_view_.twists(link);
      for (const VectorNodes& point : chain_view_.points(link)) {
        views_.push_back({entries_of(chain_view_.moved_to(twists, point)),
                          entries_of(free_view_.moved_to(of_chain, point)), poses_});
        if (is_direct()) return true;
      }
    }
    if (q_.rows != joints_ || q_.columns != joints_) return false;
    std::ranges::stable_sort(order_, {}, &Sized::terms);
    return std::ranges::any_of(order_, [this](const Sized& view) { return has_determinant(view); });
  }

  /// Also notes how large the Jacobian is in the last view.
  bool is_direct() try {
    View view(q_, views_.back(), joints_, kProductsOfView, finds_units_);
    if (view.has_rows_of_matrix()) return true;
    const auto rows = view.independent_rows();
    if (rows && rows->size() == joints_) order_.push_back({view.terms(), views_.size() - 1, *rows});
    return false;
  } catch (const TooLarge& why) {
    obstacle_ = why.what();
    return false;
  }

  struct Sized {
    std::size_t terms, view;
    std::vector<std::size_t> rows;
  };

  bool has_determinant(const Sized& sized) try {
    if (++tried_ > kMostDeterminants) return false;
    View view(q_, views_[sized.view], joints_, kProductsOfDeterminants, finds_units_);
    return view.has_determinant_of_matrix(sized.rows);
  } catch (const TooLarge& why) {
    obstacle_ = why.what();
    return false;
  }

  bool is_refuted() { return has_other_determinant() || has_other_products(); }

  /// The determinant of six rows does not depend on the view.
  bool has_other_determinant() {
    if (q_.rows != joints_ || q_.columns != joints_ || order_.empty()) return false;
    if (joints_ == 6) return has_other_determinant_than(order_.front());
    return std::ranges::all_of(order_,
                               [this](const Sized& v) { return has_other_determinant_than(v); });
  }

  /// Finds two points at which the determinants certainly have different ratios.
  bool has_other_determinant_than(const Sized& view) {
    std::vector<NodeId> jacobian;
    for (const std::size_t row : view.rows)
      for (std::size_t j = 0; j < joints_; ++j)
        jacobian.push_back(views_[view.view].jacobian[row * joints_ + j]);
    std::vector<std::pair<Ball, Ball>> determinants;
    for (int number = 0; number < kPointsOfArm; ++number) {
      const std::vector<Ball> at = some_point(q_, number, kBitsOfArm);
      const auto ours = evaluate(q_.graph, jacobian, at, kBitsOfArm);
      const auto theirs = evaluate(q_.graph, q_.matrix, at, kBitsOfArm);
      if (!ours || !theirs) continue;
      const std::pair<Ball, Ball> now(determinant(*ours, joints_, kBitsOfArm),
                                      determinant(*theirs, joints_, kBitsOfArm));
      for (const auto& before : determinants)
        if (is_another_ratio(before, now)) return true;
      determinants.push_back(now);
      if (q_.has_threshold && is_another_size(now)) return true;
    }
    return false;
  }

  /// If all six rows are there: ω_i·ω_j and v_i·ω_j + ω_i·v_j do not depend on frame and point.
  bool has_other_products() {
    const bool is_transposed = q_.columns == 6 && q_.rows == joints_ && joints_ > 6;
    if (views_.empty() ||
        (!is_transposed && (q_.rows != 6 || q_.columns != joints_ || joints_ == 6)))
      return false;
    for (int number = 0; number < kPointsOfArm; ++number) {
      const std::vector<Ball> at = some_point(q_, number, kBitsOfArm);
      const auto ours = evaluate(q_.graph, views_.front().jacobian, at, kBitsOfArm);
      auto theirs = evaluate(q_.graph, q_.matrix, at, kBitsOfArm);
      if (!ours || !theirs) continue;
      if (is_transposed) {
        const std::vector<Ball> rows = *theirs;
        for (std::size_t e = 0; e < rows.size(); ++e) (*theirs)[e % 6 * joints_ + e / 6] = rows[e];
      }
      for (std::size_t i = 0; i < joints_; ++i)
        for (std::size_t j = i; j < joints_; ++j)
          for (const std::size_t first : {0, 3}) {
            const Ball a = product(*ours, i, j, first), b = product(*theirs, i, j, first);
            if (arb_overlaps(a.get(), b.get()) == 0) return true;
          }
    }
    return false;
  }

  /// With `first` 3: ω_i·ω_j, with 0: v_i·ω_j + ω_i·v_j.
  Ball product(const std::vector<Ball>& J, std::size_t i, std::size_t j, std::size_t first) const {
    Ball result;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t row, std::size_t column) {
        return J[(row + k) * joints_ + column].get();
      };
      arb_addmul(result.get(), at(first, i), at(3, j), kBitsOfArm);
      if (first == 0) arb_addmul(result.get(), at(3, i), at(0, j), kBitsOfArm);
    }
    return result;
  }

  static bool is_another_ratio(const std::pair<Ball, Ball>& x, const std::pair<Ball, Ball>& y) {
    Ball difference;
    arb_mul(difference.get(), x.first.get(), y.second.get(), kBitsOfArm);
    arb_submul(difference.get(), x.second.get(), y.first.get(), kBitsOfArm);
    return arb_contains_zero(difference.get()) == 0;
  }

  static bool is_another_size(const std::pair<Ball, Ball>& x) {
    Ball sum, difference;
    arb_add(sum.get(), x.first.get(), x.second.get(), kBitsOfArm);
    arb_sub(difference.get(), x.first.get(), x.second.get(), kBitsOfArm);
    return arb_contains_zero(sum.get()) == 0 && arb_contains_zero(difference.get()) == 0;
  }

  static constexpr int kMostDeterminants = 3;

  SectionComparer& comparer_;
  Question& q_;
  const std::size_t joints_;
  std::vector<ChainJoint> free_chain_;
  ChainView chain_view_, free_view_;
  std::vector<NodeId> poses_;
  std::vector<Seen> views_;
  std::vector<Sized> order_;
  int tried_ = 0;
  bool finds_units_ = false;
  std::string obstacle_;
};

}  // namespace

std::vector<Ball> some_point(const Question& q, int number, long bits) {
  std::vector<Ball> result(q.variables.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto ends = evaluate(q.graph, {q.variables[k].lo, q.variables[k].hi}, {}, bits);
    if (!ends) continue;
    Ball& x = result[k];
    arb_sub(x.get(), (*ends)[1].get(), (*ends)[0].get(), bits);
    arb_mul_ui(x.get(), x.get(), ulong(11 + 31 * number + 19 * int(k)) % 89, bits);
    arb_div_ui(x.get(), x.get(), 89, bits);
    arb_add(x.get(), x.get(), (*ends)[0].get(), bits);
    arb_get_mid_arb(x.get(), x.get());
  }
  return result;
}

void compare_arm(SectionComparer& comparer, const std::vector<ChainJoint>& chain,
                 std::size_t columns) {
  ArmComparison(comparer, chain, columns).run();
}

}  // namespace regulus::verifier
