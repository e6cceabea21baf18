// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iostream>

#include "regulus/certificate/verifier/verify.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: regulus-verify CERTIFICATE\n";
    return 64;
  }
  std::ifstream file(argv[1], std::ios::binary);
  if (!file) {
    std::cerr << "regulus-verify: cannot read " << argv[1] << '\n';
    return 74;
  }
  try {
    const auto v = regulus::verifier::verify(file);
    std::cerr << regulus::verifier::describe(v);
    std::cout << regulus::verifier::name(v.outcome) << '\n';
    return static_cast<int>(v.outcome);
  } catch (const std::exception& error) {
    std::cerr << "regulus-verify: " << argv[1] << ": " << error.what() << '\n';
    return 74;
  }
}
