// SPDX-License-Identifier: GPL-3.0-or-later
void use_robots();
void use_questions();

int main() {
  use_robots();
  use_questions();
}
