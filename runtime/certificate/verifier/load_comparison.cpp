// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/load_comparison.hpp"

namespace regulus::verifier {
namespace {

std::string at(std::size_t i) { return '[' + std::to_string(i) + ']'; }

class LoadComparison {
 public:
  LoadComparison(Question& q, const WrittenValues& values, const CompareValue& compare,
                 const std::function<void(const std::string&)>& note)
      : q_(q), values_(values), compare_(compare), note_(note) {}

  void run() {
    compare_limits();
    std::vector<std::size_t> all;
    for (std::size_t j = 0; j < q_.columns; ++j) all.push_back(j);
    const std::string load = "load." + q_.load->name + '.';
    compare_part(load + "wrench", all);
    compare_part(load + "force", columns_of('v'));
    compare_part(load + "moment", columns_of('w'));
  }

 private:
  /// The limits are one range for all rows, or a list of ranges.
  void compare_limits() {
    const std::string force = "actuators.force";
    const bool is_list = values_.contains(force + "[0][0]");
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const std::string place = is_list ? force + at(i) : force;
      compare_(place + "[0]", "least " + std::to_string(i));
      compare_(place + "[1]", "largest " + std::to_string(i));
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
      compare_(part + ".value" + at(c), "wrench " + number);
      compare_(part + ".tolerance", "wrench-spread " + number);
    }
    for (std::size_t b = 0; b < q_.load->balls.size(); ++b)
      if (q_.load->balls[b].members == columns)
        compare_(part + ".radius", "wrench-ball " + std::to_string(b));
  }

  void compare_component(const std::string& place, std::size_t column) {
    const std::string number = std::to_string(column);
    if (!values_.contains(place + "[0]")) return compare_(place, "wrench " + number);
    const NodeId middle = q_.load->middle[column], spread = q_.load->spread[column];
    const StatedValue& line = q_.stated.at("wrench " + number);
    const std::string text = line.text + " +- " + q_.stated.at("wrench-spread " + number).text;
    q_.stated.emplace("wrench-lower " + number,
                      StatedValue{q_.graph.add(Op::kSubtract, middle, spread), line.line, text});
    q_.stated.emplace("wrench-upper " + number,
                      StatedValue{q_.graph.add(Op::kAdd, middle, spread), line.line, text});
    compare_(place + "[0]", "wrench-lower " + number);
    compare_(place + "[1]", "wrench-upper " + number);
    note_("wrench " + number);
    note_("wrench-spread " + number);
  }

  Question& q_;
  const WrittenValues& values_;
  const CompareValue& compare_;
  const std::function<void(const std::string&)>& note_;
};

}  // namespace

void compare_load(Question& question, const WrittenValues& values, const CompareValue& compare,
                  const std::function<void(const std::string&)>& note) {
  LoadComparison(question, values, compare, note).run();
}

}  // namespace regulus::verifier
