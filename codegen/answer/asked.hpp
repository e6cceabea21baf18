// SPDX-License-Identifier: GPL-3.0-or-later
// The questions, as values. A command line, a C++ program and a Python script make the same ones.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "codegen/model/model_options.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/margin/growing_size.hpp"
#include "codegen/question/quantity/quantity_options.hpp"

namespace regulus::detail {

/// Has the motion a singular pose?
struct AskCheck {
  ModelOptions model;
  SearchOptions search;
};

/// Where has it one?
struct AskPaving {
  ModelOptions model;
  SearchOptions search;
  std::string resolution{};  ///< part of each range, an expression; empty: by the number of ranges
};

/// How far can a tolerance, the threshold or a size grow? One of the model's tolerances, its alpha,
/// or `size` has a range LO:HI.
struct AskMargin {
  ModelOptions model;
  SearchOptions search;
  GrowingSize size;
  QuantityOptions quantity{};  ///< that must keep `limit`; empty: no singularity
  std::string limit{};         ///< empty without a quantity
  std::string gap = "0.01";    ///< the bracket is closed when (b − a)/b is at most this
};

/// What is the largest or least value of a quantity?
struct AskBound {
  ModelOptions model;
  SearchOptions search;
  QuantityOptions quantity;
  std::string limit{};  ///< compare with it; empty: bracket the value
  std::string gap = "0.01";
};

/// Do forces within the limits of the model hold a load?
struct AskLoad {
  ModelOptions model;
  SearchOptions search;
  std::string load{};  ///< empty if the model has only one
};

/// Where do they?
struct AskLoadPaving {
  ModelOptions model;
  SearchOptions search;
  std::string load{};
  std::string resolution{};  ///< as of AskPaving
};

/// All quantities that the model has the data for.
struct AskDatasheet {
  ModelOptions model;
  SearchOptions search;
  std::string gap = "0.01";
  bool markdown = false;
};

/// Asks for all configurations, poses or postures at one place, or at each of many.
struct AskSolve {
  enum class Places : std::uint8_t { kAny, kOne, kMany };

  ModelOptions model;
  SearchOptions search;
  std::vector<std::string> held{};  ///< joints of an arm that keep the values of the motion
  /// A table of places, as of way-points; each is asked for itself. Empty: there is one place, or
  /// the way-points of the motion.
  std::string table{};
  /// In the place of a table: of each place "NAME=VALUE" of its numbers.
  std::vector<std::vector<std::string>> places{};
  Places wanted = Places::kAny;  ///< what the asking program can take
};

using Asked = std::variant<AskCheck, AskPaving, AskMargin, AskBound, AskLoad, AskLoadPaving,
                           AskDatasheet, AskSolve>;

}  // namespace regulus::detail
