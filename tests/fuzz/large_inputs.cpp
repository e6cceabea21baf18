// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs of about a megabyte, as seeds of a fuzzer: large_inputs NAME FOLDER SEED... repeats each
// seed many times, and for models writes parts that a large model consists of. A fuzzer that starts
// from small files does not reach large ones in a minute.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLarge = 1'000'000;

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Repeats the second half of the seed; the beginning of the file occurs once.
std::string many_times(const std::string& seed) {
  std::string bytes = seed;
  const std::string half = seed.substr(seed.size() / 2);
  while (!half.empty() && bytes.size() + half.size() <= kLarge) bytes += half;
  return bytes;
}

/// Returns `head`, then `part` with a number for each % until the text is large or has `most`
/// parts, then `tail`.
std::string filled(std::string head, const std::string& part, const std::string& tail,
                   int most = 1'000'000) {
  for (int i = 1; i <= most && head.size() + tail.size() + 2 * part.size() < kLarge; ++i)
    for (const char c : part) {
      if (c == '%')
        head += std::to_string(i);
      else
        head += c;
    }
  return head + tail;
}

/// Returns 64 rows of 64 entries.
std::string matrix_of(const std::string& entry) {
  const std::string row = filled("[", "\"" + entry + "\",", "],\n", 64);
  std::string rows = "[matrix]\nrows = [\n";
  for (int i = 0; i < 64; ++i) rows += row;
  return rows + "]\n";
}

void write_models(const fs::path& folder) {
  const std::string head = "regulus = 1\nname = \"large\"\n[pose]\nx = \"cm\"\ny = \"cm\"\n";
  const std::string matrix = "[matrix]\nrows = [[\"x\", \"y\"], [\"y\", 1]]\n";
  const std::string motion = "[motion.m]\nx = [0, 1]\ny = [1, 2.5]\n";
  const auto model = [&](const char* name, const std::string& section, const std::string& part,
                         const std::string& end) {
    write(folder / name, filled(head + section, part, end));
  };
  const std::string rest = matrix + motion;
  model("constants", "[geometry]\n",
        "g% = { value = 0.12345678901234567890123, tolerance = 1e-3 }\n", rest);
  model("points", "[geometry]\n", "p% = { value = [0x1f, -1_0.5, \"sqrt(2)\"], radius = 1 }\n",
        rest);
  model("one_line", "[geometry]\np = [", "%.5, ", "1]\n" + rest);
  model("lets", "[let]\n", "q% = \"x*y/(1 + x^2) + sqrt(y)\"\n", rest);
  model("chain", "[let]\nq = \"x/y\"\n", "q% = \"q + y*%\"\n", rest);
  model("constraints", rest + "constraints = [\n", "\"x^2 + y^2 - %\", # \u00e4\n", "]\n");
  model("strings", rest + "[let]\na = \"\"\"\\\n", " \\\n\\u0031\\u0020+ ", "1\"\"\"\n");
  write(folder / "motions",
        filled(head + matrix, "[motion.m%]\nx = [-%, 1]\ny = \"1/%\"\n", "", 9000));
  write(folder / "dotted",
        filled(head + rest + "[geometry]\n", "g%.value = 1\ng%.tolerance = \"1/%\"\n", "", 4900));
  write(folder / "matrix", head + matrix_of("x*y^2/(x + %) - 0.5") + motion);
  write(folder / "shared", head + filled("[let]\nq = \"", "sqrt(x + %) + ", "1\"\n", 3700) +
                               matrix_of("q + %") + motion);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 64;
  const fs::path folder = argv[2];
  fs::create_directories(folder);
  for (int i = 3; i < argc; ++i)
    write(folder / fs::path(argv[i]).filename(), many_times(read(argv[i])));
  if (std::string(argv[1]) == "model_file") write_models(folder);
}
