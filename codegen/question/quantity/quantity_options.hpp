// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus {

/// The words of the command line about a quantity.
struct QuantityOptions {
  std::string quantity{};  ///< a word of quantity_words(), or an expression
  std::string load{};      ///< name; empty: the only load of the model
  std::string twist{};     ///< name; empty: the only twist of the model
  std::string row{};       ///< number of a leg or row, from 1; empty: all
  std::string freedom{};   ///< name of a column, "position" or "rotation"; empty: every column
  bool least = false;      ///< the least value in the place of the largest
  bool is_signed = false;  ///< the largest value with its sign, not the largest absolute value
  std::string norm{};      ///< of a condition number: "2" or "max"; empty: "max"
  bool is_finite = false;  ///< an error all the way, not to first order
};

}  // namespace regulus
