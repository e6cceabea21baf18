// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/arm_view.hpp"

#include <algorithm>
#include <optional>

#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/rational_in.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/model/arm_comparison.hpp"
#include "runtime/verifier/model/chain_view.hpp"
#include "runtime/verifier/model/file_expressions.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfView = 512;
constexpr int kPoints = 3;
constexpr std::size_t kTwist = 6;

/// Reads the joints of the file as the verifier does, and compares nothing.
class ArmFileReader final : public SectionComparer {
 public:
  ArmFileReader(Question& question, const WrittenValues& values)
      : q_(question),
        values_(values),
        degrees_(poses_in_degrees(values)),
        expressions_(question, values, degrees_, hidden_,
                     [](std::string_view, const Scope&) { return kNoNode; }) {}

  Question& question() override { return q_; }
  const WrittenValues& values() const override { return values_; }
  FilePlace place_of(const std::string& place) const override { return {place, 0, ""}; }
  NodeId expression_at(const std::string& place, const Scope& scope) override {
    return expressions_.at(place, scope);
  }
  void compare(const FilePlace&, NodeId, const std::string&, const std::string&) override {}
  void expect_ball(const FilePlace&, const std::vector<std::string>&) override {}
  void expect_defined(const FilePlace&, NodeId) override {}
  void note_compared(const std::string&) override {}
  void leave_out(const FilePlace&, const std::string&) override {}
  void refuse(const FilePlace& from, const std::string&) override {
    throw Unfinished(from.place + " is not that of the certificate");
  }

 private:
  Question& q_;
  const WrittenValues& values_;
  const Names degrees_, hidden_;
  FileExpressions expressions_;
};

bool is_zero(const Ball& x) { return arb_contains_zero(x.get()) != 0; }

class ViewSearch {
 public:
  ViewSearch(const Question& question, const WrittenValues& values,
             const std::vector<std::string>& names)
      : q_(question),
        names_(names),
        reader_(q_, values),
        chain_(read_chain(reader_)),
        joints_(chain_names(values).size()),
        view_(reader_, chain_, joints_) {
    for (int number = 0; number < kPoints; ++number) {
      points_.push_back(some_point(q_, number, kBitsOfView));
      const auto at = evaluate(q_.graph, q_.matrix, points_.back(), kBitsOfView);
      if (!at) throw Unfinished("the matrix of the certificate has no value at some point");
      of_certificate_.push_back(*at);
    }
  }

  ArmView run() {
    for (const std::size_t link : view_.links()) {
      const TwistColumns twists = view_.with_followers(view_.twists(link));
      for (const VectorNodes& point : view_.points(link))
        if (is_polynomial(point)) consider(link, point, view_.moved_to(twists, point));
    }
    if (!best_)
      throw Unfinished(
          "the matrix of the certificate is no part of the Jacobian of the arm as seen from a "
          "link" +
          std::string(needs_zeros_ ? ", with zeros in the other rows," : ",") +
          " nor has it its determinant");
    return *best_;
  }

 private:
  [[nodiscard]] bool is_polynomial(const VectorNodes& point) const {
    return std::ranges::all_of(
        ingredients(q_.graph, {point.begin(), point.end()}), [this](NodeId part) {
          const Op op = q_.graph.nodes()[std::size_t(part)].op;
          return op == Op::kConstant || op == Op::kVariable || op == Op::kNegate ||
                 op == Op::kAdd || op == Op::kSubtract || op == Op::kMultiply;
        });
  }

  /// Keeps the view if it is the simplest so far that fits.
  void consider(std::size_t link, const VectorNodes& point, const TwistColumns& twists) {
    std::vector<NodeId> entries;
    for (std::size_t row = 0; row < kTwist; ++row)
      for (const TwistNodes& t : twists)
        entries.push_back(row < 3 ? t.velocity[row] : t.spin[row - 3]);
    std::vector<std::vector<Ball>> values;
    for (const auto& at : points_) {
      auto jacobian = evaluate(q_.graph, entries, at, kBitsOfView);
      if (!jacobian) return;
      values.push_back(std::move(*jacobian));
    }
    const std::size_t nonzero =
        std::size_t(std::ranges::count_if(values[0], [](const Ball& x) { return !is_zero(x); }));
    const std::pair cost(nonzero, ingredients(q_.graph, entries).size());
    if (best_ && cost >= least_) return;
    std::optional<ArmView> fitting = fit(values);
    if (!fitting) return;
    fitting->link = link;
    for (const NodeId coordinate : point)
      fitting->point.push_back(coq_real(q_.graph, coordinate, names_));
    best_ = fitting;
    least_ = cost;
  }

  [[nodiscard]] std::optional<ArmView> fit(const std::vector<std::vector<Ball>>& jacobians) const {
    if (q_.rows != q_.columns) return fit_rows(jacobians);
    if (q_.columns != joints_ || joints_ > kTwist) return std::nullopt;
    std::vector<bool> chosen(kTwist, false);
    std::fill_n(chosen.begin(), joints_, true);
    do {
      std::vector<std::size_t> rows;
      for (std::size_t row = 0; row < kTwist; ++row)
        if (chosen[row]) rows.push_back(row);
      if (needs_zeros_ && !are_others_zero(jacobians, rows)) continue;
      if (const auto ratio = ratio_of(jacobians, rows)) return ArmView{0, {}, rows, ratio->text()};
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    return std::nullopt;
  }

  /// The columns depend on each other if those of the chosen rows do.
  [[nodiscard]] bool are_others_zero(const std::vector<std::vector<Ball>>& jacobians,
                                     const std::vector<std::size_t>& rows) const {
    for (std::size_t row = 0; row < kTwist; ++row)
      for (std::size_t j = 0; j < joints_ && std::ranges::find(rows, row) == rows.end(); ++j)
        for (const std::vector<Ball>& jacobian : jacobians)
          if (!is_zero(jacobian[row * joints_ + j])) return false;
    return true;
  }

  [[nodiscard]] std::optional<ArmView> fit_rows(
      const std::vector<std::vector<Ball>>& jacobians) const {
    const bool is_wide = q_.rows == joints_ && q_.columns == kTwist;
    if (!is_wide && (q_.columns != joints_ || q_.rows > kTwist)) return std::nullopt;
    ArmView view;
    for (std::size_t row = 0; row < kTwist && view.rows.size() < count_of_rows(is_wide); ++row)
      if (is_row(jacobians, row, view.rows.size(), is_wide)) view.rows.push_back(row);
    return view.rows.size() == count_of_rows(is_wide) ? std::optional(view) : std::nullopt;
  }

  [[nodiscard]] std::size_t count_of_rows(bool is_wide) const { return is_wide ? kTwist : q_.rows; }

  /// The row of the Jacobian is a row of the certificate's matrix, or a column of it.
  [[nodiscard]] bool is_row(const std::vector<std::vector<Ball>>& jacobians, std::size_t row,
                            std::size_t stated_row, bool is_wide) const {
    for (std::size_t number = 0; number < jacobians.size(); ++number)
      for (std::size_t j = 0; j < joints_; ++j) {
        const std::size_t stated = is_wide ? j * kTwist + stated_row : stated_row * joints_ + j;
        if (arb_overlaps(jacobians[number][row * joints_ + j].get(),
                         of_certificate_[number][stated].get()) == 0)
          return false;
      }
    return true;
  }

  /// The same at all points, and not 0.
  [[nodiscard]] std::optional<Rational> ratio_of(const std::vector<std::vector<Ball>>& jacobians,
                                                 const std::vector<std::size_t>& rows) const {
    std::optional<Rational> ratio;
    for (std::size_t number = 0; number < jacobians.size(); ++number) {
      std::vector<Ball> part;
      for (const std::size_t row : rows)
        for (std::size_t j = 0; j < joints_; ++j)
          part.push_back(jacobians[number][row * joints_ + j]);
      const Ball ours = determinant(part, joints_, kBitsOfView),
                 theirs = determinant(of_certificate_[number], joints_, kBitsOfView);
      if (is_zero(ours) || is_zero(theirs)) return std::nullopt;
      Ball quotient;
      arb_div(quotient.get(), ours.get(), theirs.get(), kBitsOfView);
      if (!ratio) ratio = rational_in(quotient);
      if (!ratio || arb_contains_fmpq(quotient.get(), ratio->get()) == 0) return std::nullopt;
    }
    return ratio;
  }

  Question q_;
  const std::vector<std::string>& names_;
  ArmFileReader reader_;
  const std::vector<ChainJoint> chain_;
  const std::size_t joints_;
  ChainView view_;
  std::vector<std::vector<Ball>> points_, of_certificate_;
  const bool needs_zeros_ = q_.singular && !q_.has_threshold;
  std::optional<ArmView> best_;
  std::pair<std::size_t, std::size_t> least_;
};

}  // namespace

ArmView find_arm_view(const Question& question, const WrittenValues& values,
                      const std::vector<std::string>& names) {
  return ViewSearch(question, values, names).run();
}

}  // namespace regulus::verifier
