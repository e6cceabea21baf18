// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a robot as the model file that `regulus check` and the other commands take.
#include <iostream>

#include "regulus/codegen/model/robot.hpp"

int main() try {
  const regulus::codegen::Robot robot = regulus_model();
  static_cast<void>(robot.model());  // says what is wrong in terms of the C++, not of the file
  std::cout << robot.model_file();
  return std::cout.flush() ? 0 : 74;
} catch (const regulus::codegen::InputError& error) {
  std::cerr << error.what() << '\n';
  return 65;
}
