// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the commands of the manual's pages and compares their output. With REGULUS_UPDATE_MANUAL=1
// it rewrites the pages instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/manual/page.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = REGULUS_SOURCE_DIR;

/// Returns every Markdown file of the project with something to run or to compare.
std::vector<std::string> pages() {
  std::vector<std::string> result;
  const auto consider = [&](const fs::path& path) {
    if (path.extension() != ".md") return;
    for (const Block& block : read_page(path).blocks())
      if (block.language == "console" || !block.attribute.empty())
        return result.push_back(fs::relative(path, kSource));
  };
  for (const auto& entry : fs::directory_iterator(kSource)) consider(entry.path());
  for (const char* folder : {"codegen", "runtime", "models", "generated", "tests"})
    if (fs::exists(kSource / folder))
      for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
        consider(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

/// Makes a folder like the project, in which commands may write.
void prepare(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(kSource)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("build") && !name.starts_with("."))
      fs::create_symlink(entry.path(), folder / name);
  }
  fs::create_symlink(REGULUS_BINARY_DIR, folder / "build");
}

/// Returns the output of a command on both streams.
std::vector<std::string> run(const std::string& command, const fs::path& folder) {
  const std::string line =
      "cd '" + folder.string() + "' && exec 2>&1 </dev/null\n" + command + "\n";
  std::FILE* pipe = popen(line.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  pclose(pipe);
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

void write_file(const Block& block, const fs::path& folder) {
  const fs::path path = folder / block.value;
  fs::create_directories(path.parent_path());
  std::ofstream(path) << joined(block.lines);
}

void require_excerpt(const Block& block) {
  const auto lines = read_page(kSource / block.value).lines;
  EXPECT_NE(std::search(lines.begin(), lines.end(), block.lines.begin(), block.lines.end()),
            lines.end())
      << "line " << block.first_line << ": not in " << block.value;
}

class Manual : public ::testing::TestWithParam<std::string> {};

TEST_P(Manual, SaysWhatHappens) {
  const bool update = std::getenv("REGULUS_UPDATE_MANUAL") != nullptr;
  const TemporaryDirectory temporary;
  const fs::path folder = fs::path(temporary.path()) / "regulus";
  fs::create_directory(folder);
  prepare(folder);
  setenv("PATH", (REGULUS_BINARY_DIR "/bin:" + std::string(std::getenv("PATH"))).c_str(), 1);
  setenv("XDG_CACHE_HOME", temporary.path().c_str(), 1);
  setenv("XDG_STATE_HOME", temporary.path().c_str(), 1);

  Page page = read_page(kSource / GetParam());
  std::ptrdiff_t moved = 0;
  for (const Block& block : page.blocks()) {
    if (block.attribute == "file") write_file(block, folder);
    if (block.attribute == "from") require_excerpt(block);
    if (block.language != "console") continue;
    for (const Step& step : steps_of(block)) {
      // Its output depends on whether the library of theorems is compiled.
      EXPECT_EQ(step.command.find("--theorem"), std::string::npos)
          << "line " << step.first_line << ": show it in a block of another language";
      const auto printed = run(step.command, folder);
      if (agrees(step.output, printed)) continue;
      if (!update) {
        ADD_FAILURE() << GetParam() << ", line " << step.first_line << ": $ " << step.command
                      << "\nprints\n"
                      << joined(printed) << "and the page shows\n"
                      << joined(step.output)
                      << "REGULUS_UPDATE_MANUAL=1 build/bin/manual accepts it";
        continue;
      }
      const auto begin = page.lines.begin() + std::ptrdiff_t(step.first_line) + moved;
      page.lines.insert(page.lines.erase(begin, begin + std::ptrdiff_t(step.output.size())),
                        printed.begin(), printed.end());
      moved += std::ptrdiff_t(printed.size()) - std::ptrdiff_t(step.output.size());
    }
  }
  if (update) write_page(kSource / GetParam(), page);
}

std::string name_of(const ::testing::TestParamInfo<std::string>& page) {
  std::string name = page.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Pages, Manual, ::testing::ValuesIn(pages()), name_of);

}  // namespace
}  // namespace regulus::detail::test
