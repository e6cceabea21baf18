// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/plain_arithmetic.hpp"
#include "tests/bench/kernel/rival.hpp"

namespace regulus::detail::bench {
namespace {

using Function = void (*)(const double* v, const double* k, double* out) noexcept;

/// Computes with plain doubles at the midpoints of the boxes.
class PlainRival final : public Rival {
 public:
  PlainRival(Function function, const Sample& sample)
      : function_(function),
        variables_(sample.variables),
        points_(sample.points),
        K_(sample.K),
        out_(sample.outputs) {
    for (const Interval& x : sample.boxes) midpoints_.push_back(mid(x));
  }

  void pass() override {
    for (std::size_t b = 0; b < Sample::kBoxes; ++b) evaluate(b);
  }

  std::vector<Interval> entries(std::size_t box) override {
    evaluate(box);
    return {out_.begin(), out_.end()};
  }

 private:
  void evaluate(std::size_t b) {
    function_(&midpoints_[b * variables_], &K_[b * points_], out_.data());
  }

  Function function_;
  std::size_t variables_, points_;
  std::vector<double> midpoints_, K_, out_;
};

}  // namespace

std::unique_ptr<Rival> make_plain_scalar(const Sample& sample) {
  return std::make_unique<PlainRival>(plain_scalar, sample);
}
std::unique_ptr<Rival> make_plain_vectorised(const Sample& sample) {
  return std::make_unique<PlainRival>(plain_vectorised, sample);
}

}  // namespace regulus::detail::bench
