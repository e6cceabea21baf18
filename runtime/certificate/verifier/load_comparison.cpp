// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/load_comparison.hpp"

#include <optional>

namespace regulus::verifier {
namespace {

std::string at(std::size_t i) { return '[' + std::to_string(i) + ']'; }

class LoadComparison {
 public:
  LoadComparison(Question& q, const WrittenValues& values, const LoadComparer& comparer)
      : q_(q), values_(values), comparer_(comparer) {}

  bool run() {
    if (!first_in("load." + q_.load->name)) return false;
    compare_limits();
    std::vector<std::size_t> all;
    for (std::size_t j = 0; j < q_.columns; ++j) all.push_back(j);
    const std::string load = "load." + q_.load->name + '.';
    compare_part(load + "wrench", all);
    compare_part(load + "force", columns_of('v'));
    compare_part(load + "moment", columns_of('w'));
    return true;
  }

 private:
  /// Returns a place at or below this one; nullopt if the file has none.
  [[nodiscard]] std::optional<std::string> first_in(const std::string& place) const {
    for (const char* next : {".", "["})
      if (const auto at = values_.lower_bound(place + next);
          at != values_.end() && at->first.starts_with(place + next))
        return at->first;
    return std::nullopt;
  }

  /// The limits are one range for all rows, or a list of ranges.
  void compare_limits() {
    const std::string force = "actuators.force";
    const bool is_list = values_.contains(force + "[0][0]");
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const std::string place = is_list ? force + at(i) : force;
      compare(place + "[0]", "least " + std::to_string(i));
      compare(place + "[1]", "largest " + std::to_string(i));
    }
  }

  /// Returns the columns whose names begin with a letter; empty if they are not known here.
  [[nodiscard]] std::vector<std::size_t> columns_of(char letter) const {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < q_.columns; ++j) {
      const auto named = values_.find("matrix.twist" + at(j));
      if (named != values_.end() && named->second.text.starts_with(letter)) columns.push_back(j);
      const bool is_platform =
          q_.columns == 6 && (values_.contains("gough.base[0][0]") ||
                              values_.lower_bound("legs.") != values_.lower_bound("legs/"));
      if (named == values_.end() && is_platform && (j < 3) == (letter == 'v')) columns.push_back(j);
    }
    return columns;
  }

  void compare_part(const std::string& part, const std::vector<std::size_t>& columns) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string number = std::to_string(columns[c]);
      compare_component(part + at(c), columns[c]);
      compare(part + ".value" + at(c), "wrench " + number);
      compare(part + ".tolerance", "wrench-spread " + number);
    }
    compare(part + ".radius", "wrench-ball " + ball_of(columns));
    if (const auto place = first_in(part); place && columns.empty()) comparer_.leave_out(*place);
  }

  /// Returns the number of the ball of these components; a number that no ball has, if there is none.
  [[nodiscard]] std::string ball_of(const std::vector<std::size_t>& columns) const {
    std::size_t b = 0;
    while (b < q_.load->balls.size() && q_.load->balls[b].members != columns) ++b;
    return std::to_string(b);
  }

  void compare(const std::string& place, const std::string& stated) const {
    comparer_.compare(place, stated);
  }

  void compare_component(const std::string& place, std::size_t column) {
    const std::string number = std::to_string(column);
    if (!values_.contains(place + "[0]")) return compare(place, "wrench " + number);
    const NodeId middle = q_.load->middle[column], spread = q_.load->spread[column];
    const StatedValue& line = q_.stated.at("wrench " + number);
    const std::string text = line.text + " +- " + q_.stated.at("wrench-spread " + number).text;
    q_.stated.emplace("wrench-lower " + number,
                      StatedValue{q_.graph.add(Op::kSubtract, middle, spread), line.line, text});
    q_.stated.emplace("wrench-upper " + number,
                      StatedValue{q_.graph.add(Op::kAdd, middle, spread), line.line, text});
    compare(place + "[0]", "wrench-lower " + number);
    compare(place + "[1]", "wrench-upper " + number);
    comparer_.note("wrench " + number);
    comparer_.note("wrench-spread " + number);
  }

  Question& q_;
  const WrittenValues& values_;
  const LoadComparer& comparer_;
};

}  // namespace

bool compare_load(Question& question, const WrittenValues& values, const LoadComparer& comparer) {
  return LoadComparison(question, values, comparer).run();
}

}  // namespace regulus::verifier
