// SPDX-License-Identifier: GPL-3.0-or-later
// Tests pipes without a writer, folders, and endless files.
#include "runtime/verifier/input_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/certificate_texts.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using verifier::InputFile;
using verifier::Outcome;

class AnInput : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  [[nodiscard]] std::string pipe() const {
    const std::string path = file("pipe");
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }

 private:
  TemporaryDirectory directory_;
};

void expect_trouble(const std::string& path, const std::string& why) {
  try {
    const InputFile input(path);
    ADD_FAILURE() << path << " was opened";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

int exit_code_of(const std::string& command) {
  const int status = std::system((command + " 2>/dev/null >/dev/null").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const std::string kVerify = REGULUS_BINARY_DIR "/bin/regulus-verify ";

TEST_F(AnInput, IsNotWaitedForWhereNobodyWritesIt) {
  const std::string nobody = pipe();
  expect_trouble(nobody, "nobody writes");
  expect_trouble(file(""), "directory");
  expect_trouble(file("none"), "No such file");
  EXPECT_EQ(exit_code_of(kVerify + nobody), 74);
  EXPECT_EQ(exit_code_of(kVerify + file("")), 74);
  EXPECT_EQ(exit_code_of(kVerify + file("none")), 74);
  EXPECT_EQ(exit_code_of(kVerify + "/dev/zero"), 1);
}

TEST_F(AnInput, MayBeAPipeThatHasBeenWritten) {
  const std::string text = scalar_question("x") + kOneLeaf;
  const std::string written = pipe();
  const int reader = ::open(written.c_str(), O_RDONLY | O_NONBLOCK);
  const int writer = ::open(written.c_str(), O_WRONLY);
  ASSERT_EQ(::write(writer, text.data(), text.size()), ssize_t(text.size()));
  ::close(writer);
  InputFile bytes(written);
  ::close(reader);
  std::istream stream(&bytes);
  EXPECT_EQ(verifier::verify(stream).outcome, Outcome::kVerified);
}

TEST_F(AnInput, MayBeStandardInput) {
  std::ofstream(file("proof")) << scalar_question("x") << kOneLeaf;
  EXPECT_EQ(exit_code_of(kVerify + "/dev/stdin <" + file("proof")), 0);
  EXPECT_EQ(exit_code_of("cat " + file("proof") + " | " + kVerify + "/dev/stdin"), 0);
}

TEST_F(AnInput, HasALargestSize) {
  const std::string text = scalar_question("x") + kOneLeaf;
  verifier::Options options;
  options.max_bytes = text.size();
  EXPECT_EQ(verify_text(text, options).outcome, Outcome::kVerified);
  --options.max_bytes;
  const auto v = verify_text(text, options);
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_NE(v.reason.find("too large"), std::string::npos) << v.reason;
  std::ofstream(file("model")) << text;
  EXPECT_EQ(verifier::read_text(file("model"), text.size()), text);
  EXPECT_THROW(static_cast<void>(verifier::read_text(file("model"), text.size() - 1)),
               std::runtime_error);
}

}  // namespace
}  // namespace regulus::detail::test
