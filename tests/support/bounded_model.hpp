// SPDX-License-Identifier: GPL-3.0-or-later
// Models of robots whose bounds a test compares with its own: the equations are solved in doubles, by
// elimination. None of the code under test.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

using nlohmann::json;

using Row = std::vector<double>;

/// Solves M·x = b by elimination.
inline Row solved(std::vector<Row> M, Row b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::fabs(M[r][c]) > std::fabs(M[pivot][c])) pivot = r;
    std::swap(M[c], M[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = M[r][c] / M[c][c];
      for (std::size_t k = c; k < n; ++k) M[r][k] -= factor * M[c][k];
      b[r] -= factor * b[c];
    }
  }
  for (std::size_t c = 0; c < n; ++c) b[c] /= M[c][c];
  return b;
}

inline std::vector<Row> transposed(const std::vector<Row>& M) {
  std::vector<Row> result(M.front().size(), Row(M.size()));
  for (std::size_t i = 0; i < M.size(); ++i)
    for (std::size_t j = 0; j < M[i].size(); ++j) result[j][i] = M[i][j];
  return result;
}

/// Returns column `k` of the inverse.
inline Row column_of_inverse(const std::vector<Row>& M, std::size_t k) {
  Row unit(M.size(), 0.0);
  unit[k] = 1;
  return solved(M, unit);
}

inline const double kThird = 2 * std::acos(-1.0) / 3;

class BoundedModel : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(model_) << text; }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] CommandResult bound(const Words& words) const {
    Words all{kCommand, "bound", model_};
    all.insert(all.end(), words.begin(), words.end());
    return run_command(all);
  }
  /// Returns the components of a bound by their labels.
  [[nodiscard]] std::map<std::string, json> components(Words words) const {
    words.emplace_back("--json");
    const CommandResult result = bound(words);
    std::map<std::string, json> found;
    if (result.output.empty()) {
      ADD_FAILURE() << result.errors;
      return found;
    }
    const json report = json::parse(result.output);
    for (const json& one : report["components"]) found[one["label"]] = one;
    return found;
  }
  static void expect_bracket(const json& one, double value) {
    EXPECT_LE(one["attained"].get<double>(), value * 1.0001 + 1e-12) << one;
    EXPECT_GE(one["proved"].get<double>(), value * 0.9999 - 1e-12) << one;
  }
  [[nodiscard]] CommandResult verify(const std::string& certificate) const {
    return run_command({kVerify, certificate, "--model", model_});
  }

  TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "model.toml";
};

inline std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace regulus::detail::test
