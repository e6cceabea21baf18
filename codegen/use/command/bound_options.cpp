// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/bound_options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

namespace regulus::detail {

void add_quantity_options(CLI::App& app, QuantityOptions& q) {
  app.add_option("--load", q.load, "Set of wrenches on the platform: NAME of a [load.NAME]")
      ->type_name("NAME");
  app.add_option("--twist", q.twist, "Set of twists of the platform: NAME of a [twist.NAME]")
      ->type_name("NAME");
  app.add_option("--leg", q.row, "Bound this leg, or row of the matrix, only")->type_name("N");
  app.add_option("--freedom", q.freedom,
                 "Bound the error or deflection of this freedom only: the name of a column, "
                 "position or rotation")
      ->type_name("NAME");
  app.add_flag("--min", q.least, "Bound the least value, with its sign");
  app.add_flag("--signed", q.is_signed,
               "Bound the largest value with its sign, not the largest absolute value");
  app.add_flag("--finite", q.is_finite,
               "Bound errors all the way, not to first order: how far errors and tolerances move "
               "the unknowns of a closure, or a platform on telescopic legs");
  app.add_option("--norm", q.norm,
                 "Norm of the condition number: 2 (largest by least singular value) or max "
                 "(default)")
      ->type_name("NORM");
}

BoundCommand with_quantity(BoundCommand command) {
  if (command.quantity.quantity.empty()) std::swap(command.quantity.quantity, command.model.motion);
  return command;
}

void add_bound_options(CLI::App& app, BoundCommand& command) {
  QuantityOptions& q = command.quantity;
  app.add_option("QUANTITY", q.quantity,
                 "force, error, speed, sigma-min, sigma-max, condition, deflection, determinant, "
                 "determinant-max, or an expression of the model in quotes");
  add_quantity_options(app, q);
  app.add_option("--limit", command.limit,
                 "Compare with L: WITHIN if every value is below L (with --min and sigma-min: "
                 "above), EXCEEDED if one is not")
      ->type_name("L");
  app.add_option("--gap", command.gap,
                 "Stop when the bracket is at most this part of its larger end")
      ->type_name("G")
      ->capture_default_str();
}

}  // namespace regulus::detail
