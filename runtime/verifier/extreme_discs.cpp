// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/extreme_discs.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::verifier {
namespace {

constexpr int kStepsOfWeights = 30;    ///< of the iteration for weights
constexpr double kShift = 0.3;         ///< keeps it from going to and fro
constexpr double kLeastWeight = 1e-9;  ///< relative to the largest
constexpr double kLeastSlack = 1e-6;   ///< the same

}  // namespace

ExtremeDiscs::ExtremeDiscs(const RotatedMatrix& B, std::size_t rows, std::size_t columns,
                           SingularClaim claim, double bound)
    : B_(B), m_(rows), n_(columns), claim_(claim), T_(bound) {
  bound_entries();
}

void ExtremeDiscs::bound_entries() {
  for (std::size_t e = 0; e < B_.center.size(); ++e) {
    double sum = up(mag(B_.center[e]) + B_.rest[e]);
    for (std::size_t k = 0; k < B_.slopes.size(); ++k)
      sum = up(sum + up(mag(B_.slopes[k][e]) * B_.radius[k]));
    off_.push_back(sum);
  }
}

bool ExtremeDiscs::keep_claim() {
  return claim_ == SingularClaim::kRatioBelow     ? are_apart()
         : claim_ == SingularClaim::kLargestBelow ? are_below()
                                                  : are_above();
}

bool ExtremeDiscs::are_below() {
  high_slack_.clear();
  for (std::size_t i = 0; i < n_; ++i) high_slack_.push_back(T_ - off_[i * n_ + i]);
  high_ = find_weights(true);
  const std::vector<Disc> highest = discs(high_, m_);
  return std::all_of(highest.begin(), highest.end(), [&](const Disc& high) {
    const double top = high.i < n_ ? up(high.alpha.hi * off_[high.i * n_ + high.i]) : 0.0;
    return up(top + high.beta) < T_;
  });
}

bool ExtremeDiscs::are_above() {
  low_slack_.clear();
  for (std::size_t i = 0; i < n_; ++i) low_slack_.push_back(least(i) - T_);
  low_ = find_weights(false);
  const std::vector<Disc> lowest = discs(low_, n_);
  return std::all_of(lowest.begin(), lowest.end(), [&](const Disc& low) {
    return least(low.i) > 0.0 && down(down(low.alpha.lo * least(low.i)) - low.beta) > T_;
  });
}

/// B_ii is at least that all over the box.
double ExtremeDiscs::least(std::size_t i) const {
  const std::size_t e = i * n_ + i;
  double least = down(B_.center[e].lo - B_.rest[e]);
  for (std::size_t k = 0; k < B_.slopes.size(); ++k)
    least = down(least - up(mag(B_.slopes[k][e]) * B_.radius[k]));
  return least;
}

bool ExtremeDiscs::are_apart() {
  high_ = low_ = {Doubles(m_, 1.0), Doubles(n_, 1.0)};
  // A column that is not 0 has one singular value.
  if (n_ == 1) return T_ > 1.0 && least(0) > 0.0;
  high_slack_.assign(n_, kInfinity), low_slack_.assign(n_, kInfinity);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t l = 0; l < n_; ++l) {
      high_slack_[i] = std::min(high_slack_[i], slack(i, l));
      low_slack_[l] = std::min(low_slack_[l], slack(i, l) / T_);
    }
  high_ = find_weights(true);
  low_ = find_weights(false);
  const std::vector<Disc> highest = discs(high_, m_), lowest = discs(low_, n_);
  return std::all_of(lowest.begin(), lowest.end(), [&](const Disc& low) {
    return is_positive(low) && std::all_of(highest.begin(), highest.end(),
                                           [&](const Disc& high) { return is_apart(high, low); });
  });
}

/// The least T·B_ll − B_ii over the box, roughly.
double ExtremeDiscs::slack(std::size_t i, std::size_t l) const {
  const std::size_t ii = i * n_ + i, ll = l * n_ + l;
  double least = T_ * (mid(B_.center[ll]) - B_.rest[ll]) - mid(B_.center[ii]) - B_.rest[ii];
  for (std::size_t k = 0; k < B_.slopes.size(); ++k)
    least -= mag(B_.slopes[k][ii] - T_ * B_.slopes[k][ll]) * B_.radius[k];
  return least;
}

/// Let row i and column i use the same part λ of their slack q for the other entries: with
/// z_i = t_i + d_i, y_i = t_i − d_i and the sums S of |B_ij|y_j and S' of |B_ji|z_j that takes
/// λt_i = (S + S')/(2q) and d_i = ±(S − S')/(2(2B_ii ± λq)). Repeated, this finds t as an eigenvector
/// of λ, roughly. Rows that have no column of their own use half of theirs.
ExtremeDiscs::Weights ExtremeDiscs::find_weights(bool of_largest) const {
  const Doubles& slacks = of_largest ? high_slack_ : low_slack_;
  const std::size_t rows = of_largest ? m_ : n_;
  double most = 1e-300;
  for (const double x : slacks) most = std::max(most, std::fabs(x));
  Weights w{Doubles(rows, 1.0), Doubles(n_, 1.0)};
  const auto row_sum = [&](std::size_t i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n_; ++j) sum += off(i, j) * w.y[j];
    return sum;
  };
  for (int step = 0; step < kStepsOfWeights; ++step) {
    Doubles t(n_), d(n_);
    double largest = 1e-300;
    for (std::size_t i = 0; i < n_; ++i) {
      const double row = row_sum(i);
      double column = 0.0;
      for (std::size_t j = 0; j < rows; ++j) column += off(j, i) * w.z[j];
      const double room = std::max(slacks[i], kLeastSlack * most);
      const double value = std::fabs(mid(B_.center[i * n_ + i]));
      t[i] = (row + column) / (2.0 * room);
      d[i] = (of_largest ? row - column : column - row) / (4.0 * value + 2.0 * room);
      largest = std::max(largest, t[i]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      const double part = std::max(t[i] / largest, kLeastWeight);
      const double beside = std::clamp(d[i], -0.5 * part, 0.5 * part);
      w.z[i] = (part + beside + kShift * w.z[i]) / (1.0 + kShift);
      w.y[i] = (part - beside + kShift * w.y[i]) / (1.0 + kShift);
    }
    const double unit = claim_ == SingularClaim::kRatioBelow ? mid(B_.center[n_ * n_ - 1]) : 1.0;
    const double bound = T_ * std::fabs(unit);
    for (std::size_t i = n_; i < rows; ++i)
      w.z[i] = 2.0 * row_sum(i) / std::max(bound, 1e-300) + kLeastWeight;
  }
  return w;
}

/// Each row and each column gives a bound.
std::vector<ExtremeDiscs::Disc> ExtremeDiscs::discs(const Weights& w, std::size_t rows) const {
  std::vector<Disc> result;
  for (std::size_t i = 0; i < rows; ++i) {
    Disc disc{i, i < n_ ? point(w.y[i]) / point(w.z[i]) : Interval{}, 0.0};
    for (std::size_t j = 0; j < n_; ++j) disc.beta = up(disc.beta + up(off(i, j) * w.y[j]));
    disc.beta = up(disc.beta / w.z[i]);
    result.push_back(disc);
  }
  for (std::size_t j = 0; j < n_; ++j) {
    Disc disc{j, point(w.z[j]) / point(w.y[j]), 0.0};
    for (std::size_t i = 0; i < rows; ++i) disc.beta = up(disc.beta + up(off(i, j) * w.z[i]));
    disc.beta = up(disc.beta / w.y[j]);
    result.push_back(disc);
  }
  return result;
}

bool ExtremeDiscs::is_positive(const Disc& low) const {
  const std::size_t e = low.i * n_ + low.i;
  double least = down(term(low, B_.center).lo - up(low.alpha.hi * B_.rest[e]));
  for (std::size_t k = 0; k < B_.slopes.size(); ++k)
    least = down(least - up(mag(term(low, B_.slopes[k])) * B_.radius[k]));
  return down(least - low.beta) > 0.0;
}

/// high < T·low all over the box.
bool ExtremeDiscs::is_apart(const Disc& high, const Disc& low) const {
  const std::size_t e = low.i * n_ + low.i;
  double sum = (term(high, B_.center) - T_ * term(low, B_.center)).hi;
  for (std::size_t k = 0; k < B_.slopes.size(); ++k) {
    const Interval difference = term(high, B_.slopes[k]) - T_ * term(low, B_.slopes[k]);
    sum = up(sum + up(mag(difference) * B_.radius[k]));
  }
  if (high.i < n_) sum = up(sum + up(high.alpha.hi * B_.rest[high.i * n_ + high.i]));
  sum = up(sum + up(T_ * up(low.alpha.hi * B_.rest[e])));
  sum = up(sum + high.beta);
  return up(sum + up(T_ * low.beta)) < 0.0;
}

std::vector<double> ExtremeDiscs::parts() const {
  const std::size_t last = n_ - 1;
  const bool has_high = claim_ != SingularClaim::kLeastAbove,
             has_low = claim_ != SingularClaim::kLargestBelow;
  const double part_of_low = claim_ == SingularClaim::kRatioBelow ? T_ : 1.0;
  const double both = (has_high ? 1.0 : 0.0) + (has_low ? part_of_low : 0.0);
  Doubles result;
  for (std::size_t k = 0; k < B_.slopes.size(); ++k) {
    const auto size = [&](std::size_t i, std::size_t j) {
      return i == j ? 0.0 : mag(B_.slopes[k][i * n_ + j]) * B_.radius[k];
    };
    double above = 0.0, below = 0.0;
    for (std::size_t j = 0; j < n_; ++j) {
      if (has_high)
        above += size(0, j) * high_.y[j] / high_.z[0] + size(j, 0) * high_.z[j] / high_.y[0];
      if (has_low)
        below +=
            size(last, j) * low_.y[j] / low_.z[last] + size(j, last) * low_.z[j] / low_.y[last];
    }
    result.push_back(above + part_of_low * below + both * B_.share[k]);
  }
  return result;
}

}  // namespace regulus::verifier
