// SPDX-License-Identifier: GPL-3.0-or-later
// Tables IV–VII of the paper: what was checked, how, and how many seconds it took its author.
#pragma once

#include <span>

namespace regulus::test {

enum class PaperVerdict { kNone, kSingular };

/// One cell of a table.
struct PaperCell {
  const char* table;
  const char* model;
  const char* motion;
  const char* tolerance;    ///< of base and platform; "" = exact geometry
  const char* uncertainty;  ///< elements (D) or variables (V)
  const char* method;
  const char* seconds;  ///< as printed; "" where the paper has no such cell
  PaperVerdict verdict;
};

inline constexpr PaperVerdict kNone = PaperVerdict::kNone;
inline constexpr PaperVerdict kSingular = PaperVerdict::kSingular;

// clang-format off
inline constexpr PaperCell kPaperCells[] = {
    {"IV", "robot_1", "table4_1", "", "elements", "reg", "106.74", kNone},
    {"IV", "robot_1", "table4_1", "", "elements", "reg+rohn", "0.37", kNone},
    {"IV", "robot_1", "table4_1", "", "elements", "jk", "1.09", kNone},
    {"IV", "robot_1", "table4_1", "", "elements", "jk+rohn", "0.39", kNone},
    {"IV", "robot_1", "table4_1", "", "elements", "kj", "0.01", kNone},
    {"IV", "robot_1", "table4_1", "", "elements", "auto", "", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "reg", "338.9", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "reg+rohn", "0.4", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "jk", "4.3", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "jk+rohn", "0.42", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "kj", "0.01", kNone},
    {"IV", "robot_1", "table4_2", "", "elements", "auto", "", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "reg", "9076.2", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "reg+rohn", "2.6", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "jk", "34.79", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "jk+rohn", "2.8", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "kj", "0.01", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "kj-numeric", "70.22", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "jk-numeric", "79.13", kNone},
    {"IV", "robot_1", "table4_5", "", "elements", "auto", "", kNone},
    {"§V-C1a", "robot_1", "wide_15", "", "elements", "reg+rohn", "6028", kNone},
    {"§V-C1a", "robot_1", "wide_15", "", "elements", "kj", "0.19", kNone},
    {"§V-C1a", "robot_1", "wide_15", "", "elements", "auto", "", kNone},
    {"§V-C1a", "robot_1", "wide_40", "", "elements", "reg", "0.25", kSingular},
    {"§V-C1a", "robot_1", "wide_40", "", "elements", "reg+rohn", "0.27", kSingular},
    {"§V-C1a", "robot_1", "wide_40", "", "elements", "kj", "0.32", kSingular},
    {"§V-C1a", "robot_1", "wide_40", "", "elements", "jk", "0.32", kSingular},
    {"§V-C1a", "robot_1", "wide_40", "", "elements", "auto", "", kSingular},
    {"V", "robot_2", "table5_20", "", "elements", "reg", "12.66", kNone},
    {"V", "robot_2", "table5_20", "", "elements", "reg+rohn", "0.43", kNone},
    {"V", "robot_2", "table5_20", "", "elements", "jk", "1.9", kNone},
    {"V", "robot_2", "table5_20", "", "elements", "kj", "0.11", kNone},
    {"V", "robot_2", "table5_20", "", "elements", "kj+rohn", "0.43", kNone},
    {"V", "robot_2", "table5_20", "", "elements", "auto", "", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "reg", "94.31", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "reg+rohn", "2.9", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "jk", "11.88", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "kj", "0.94", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "kj+rohn", "1.9", kNone},
    {"V", "robot_2", "table5_30", "", "elements", "auto", "", kNone},
    {"V", "robot_2", "table5_40", "", "elements", "reg", "0.1", kSingular},
    {"V", "robot_2", "table5_40", "", "elements", "reg+rohn", "0.1", kSingular},
    {"V", "robot_2", "table5_40", "", "elements", "jk", "0.13", kSingular},
    {"V", "robot_2", "table5_40", "", "elements", "kj", "0.13", kSingular},
    {"V", "robot_2", "table5_40", "", "elements", "kj+rohn", "0.24", kSingular},
    {"V", "robot_2", "table5_40", "", "elements", "auto", "", kSingular},
    {"VI", "robot_1", "table6_5_5", "0.05", "elements", "kj", "0.01", kNone},
    {"VI", "robot_1", "table6_5_5", "0.05", "variables", "kj", "0.01", kNone},
    {"VI", "robot_1", "table6_5_5", "0.05", "elements", "auto", "", kNone},
    {"VI", "robot_1", "table6_5_15", "0.05", "elements", "kj", "0.23", kNone},
    {"VI", "robot_1", "table6_5_15", "0.05", "variables", "kj", "0.63", kNone},
    {"VI", "robot_1", "table6_5_15", "0.05", "elements", "auto", "", kNone},
    {"VI", "robot_1", "table6_15_15", "0.05", "elements", "kj", "5.5", kNone},
    {"VI", "robot_1", "table6_15_15", "0.05", "elements", "kj+rohn", "7.32", kNone},
    {"VI", "robot_1", "table6_15_15", "0.05", "variables", "kj", "14.07", kNone},
    {"VI", "robot_1", "table6_15_15", "0.05", "variables", "kj+rohn", "4.54", kNone},
    {"VI", "robot_1", "table6_15_15", "0.05", "elements", "auto", "", kNone},
    {"VI", "robot_1", "table6_5_5", "0.1", "elements", "kj", "0.01", kNone},
    {"VI", "robot_1", "table6_5_5", "0.1", "variables", "kj", "0.02", kNone},
    {"VI", "robot_1", "table6_5_5", "0.1", "elements", "auto", "", kNone},
    {"VI", "robot_1", "table6_5_15", "0.1", "elements", "kj", "4.47", kNone},
    {"VI", "robot_1", "table6_5_15", "0.1", "variables", "kj", "2.55", kNone},
    {"VI", "robot_1", "table6_5_15", "0.1", "elements", "auto", "", kNone},
    {"VI", "robot_1", "table6_15_15", "0.1", "elements", "kj", "1540.74", kNone},
    {"VI", "robot_1", "table6_15_15", "0.1", "elements", "kj+rohn", "514.5", kNone},
    {"VI", "robot_1", "table6_15_15", "0.1", "variables", "kj", "2614.55", kNone},
    {"VI", "robot_1", "table6_15_15", "0.1", "variables", "kj+rohn", "402.2", kNone},
    {"VI", "robot_1", "table6_15_15", "0.1", "elements", "auto", "", kNone},
    {"VII", "robot_1", "T1", "", "elements", "reg", "0.19", kNone},
    {"VII", "robot_1", "T1", "", "elements", "reg+rohn", "0.19", kNone},
    {"VII", "robot_1", "T1", "", "elements", "kj", "0.07", kNone},
    {"VII", "robot_1", "T1", "", "elements", "jk", "0.12", kNone},
    {"VII", "robot_1", "T1", "", "elements", "auto", "", kNone},
    {"VII", "robot_1", "T1_errors", "0.05", "elements", "reg", "0.51", kNone},
    {"VII", "robot_1", "T1_errors", "0.05", "elements", "reg+rohn", "0.29", kNone},
    {"VII", "robot_1", "T1_errors", "0.05", "elements", "kj", "0.01", kNone},
    {"VII", "robot_1", "T1_errors", "0.05", "elements", "jk", "0.22", kNone},
    {"VII", "robot_1", "T1_errors", "0.05", "elements", "auto", "", kNone},
    {"VII", "robot_1", "T2", "", "elements", "reg", "0.20", kNone},
    {"VII", "robot_1", "T2", "", "elements", "reg+rohn", "0.19", kNone},
    {"VII", "robot_1", "T2", "", "elements", "kj", "0.04", kNone},
    {"VII", "robot_1", "T2", "", "elements", "jk", "0.17", kNone},
    {"VII", "robot_1", "T2", "", "elements", "auto", "", kNone},
    {"VII", "robot_1", "T2_errors", "0.05", "variables", "reg", "15.52", kNone},
    {"VII", "robot_1", "T2_errors", "0.05", "variables", "reg+rohn", "2.22", kNone},
    {"VII", "robot_1", "T2_errors", "0.05", "variables", "kj", "0.27", kNone},
    {"VII", "robot_1", "T2_errors", "0.05", "variables", "jk", "2.3", kNone},
    {"VII", "robot_1", "T2_errors", "0.05", "elements", "auto", "", kNone},
};
// clang-format on

}  // namespace regulus::test
