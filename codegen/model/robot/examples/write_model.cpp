// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a robot as the model file that `regulus check` and the other commands take.
#include <iostream>
#include <regulus/regulus.hpp>

int main() try {
  const regulus::Robot robot = regulus_model();
  static_cast<void>(robot.model());  // reports mistakes with the place in C++, not in the file
  std::cout << robot.model_file();
  return std::cout.flush() ? 0 : 74;
} catch (const regulus::InputError& error) {
  std::cerr << error.what() << '\n';
  return 65;
}
