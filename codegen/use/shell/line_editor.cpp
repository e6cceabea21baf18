// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/line_editor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cwchar>
#include <iostream>

#ifdef REGULUS_LIBEDIT
#include <histedit.h>
#endif

#include "codegen/support/terminal_width.hpp"
#include "codegen/support/wrapped_text.hpp"
#include "codegen/use/command/terminal.hpp"
#include "codegen/use/shell/shell_completion.hpp"

namespace regulus::detail {

std::filesystem::path history_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/')
    return std::filesystem::path(state) / "regulus" / "history";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return std::filesystem::path(home) / ".local" / "state" / "regulus" / "history";
}

#ifdef REGULUS_LIBEDIT

namespace {

constexpr int kLinesKept = 1000;

/// Creates the file, if there is none, only for its owner, because lines may be private. It does
/// not change the umask, because other threads use it, too.
void make_private(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::create_directories(file.parent_path(), error))
    std::filesystem::permissions(file.parent_path(), std::filesystem::perms::owner_all, error);
  const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (made < 0) return;
  ::fchmod(made, S_IRUSR | S_IWUSR);
  ::close(made);
}

/// Blocks SIGINT during its lifetime: a signal between the prompt and the read would be lost.
class InterruptsWait {
 public:
  InterruptsWait() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    pthread_sigmask(SIG_BLOCK, &set, &before_);
  }
  ~InterruptsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  InterruptsWait(const InterruptsWait&) = delete;
  InterruptsWait& operator=(const InterruptsWait&) = delete;

  [[nodiscard]] const sigset_t& before() const noexcept { return before_; }

 private:
  sigset_t before_{};
};

/// Begins and ends a sequence that moves no cursor.
constexpr char kEscape = '\1';

/// The last character is plain: libedit prints a sequence together with the character after it.
std::string in_bold(const std::string& text) {
  const auto sequence = [](const char* bytes) { return kEscape + std::string(bytes) + kEscape; };
  return sequence("\033[1m") + text.substr(0, text.size() - 1) + sequence("\033[0m") + text.back();
}

/// Input is UTF-8 unless the environment names another encoding.
void choose_encoding() {
  std::setlocale(LC_CTYPE, "");
  if (MB_CUR_MAX == 1) std::setlocale(LC_CTYPE, "C.UTF-8");
}

}  // namespace

struct LineEditor::Library {
  EditLine* line = el_init("regulus", stdin, stdout, stderr);
  History* history = history_init();
  HistEvent event{};
  std::string prompt;
  std::filesystem::path file;
  Complete complete;
  const InterruptsWait* waiting = nullptr;  ///< while a line is read

  static Library& of(EditLine* line) {
    Library* library = nullptr;
    el_get(line, EL_CLIENTDATA, &library);
    return *library;
  }

  static const char* show_prompt(EditLine* line) { return of(line).prompt.c_str(); }

  /// Reads one character for el_gets. Returns 1, at the end of the input 0, otherwise −1.
  static int read_character(EditLine* line, wchar_t* character) {
    std::mbstate_t state{};
    for (;;) {
      pollfd input{STDIN_FILENO, POLLIN, 0};
      if (ppoll(&input, 1, nullptr, &of(line).waiting->before()) < 0) return -1;
      char byte = 0;
      const ssize_t count = read(STDIN_FILENO, &byte, 1);
      if (count <= 0) return static_cast<int>(count);
      if (byte == 0) continue;  // an end of the input, typed before the terminal went raw
      const std::size_t used = std::mbrtowc(character, &byte, 1, &state);
      if (used <= 1) return 1;
      if (used == static_cast<std::size_t>(-2)) continue;
      *character = L'?';  // no character of the encoding
      return 1;
    }
  }

  /// Returns the words on lines that fit.
  static std::string listed(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : "  ") + word;
    return wrapped(line, columns_of_terminal(STDOUT_FILENO), 0);
  }

  /// Adds the common beginning of all completions; if there is none, lists them.
  static unsigned char on_tab(EditLine* line, int) {
    Library& library = of(line);
    const LineInfo* info = el_line(line);
    const std::string before(info->buffer, info->cursor);
    const std::vector<std::string> words = library.complete(before);
    if (words.empty()) return CC_REFRESH_BEEP;
    const std::size_t typed = before.size() - (before.find_last_of(" \t") + 1);
    std::string more = common_beginning(words).substr(typed);
    if (words.size() == 1 && !words[0].ends_with('/') && !words[0].ends_with('=')) more += ' ';
    if (more.empty()) {
      std::cout << '\n' << listed(words) << std::endl;
      return CC_REDISPLAY;
    }
    el_insertstr(line, more.c_str());
    return CC_REFRESH;
  }

  void save() {
    if (file.empty()) return;
    make_private(file);
    ::history(history, &event, H_SAVE, file.c_str());
  }

  ~Library() {
    history_end(history);
    el_end(line);
  }
};

LineEditor::LineEditor(std::filesystem::path history, Complete complete)
    : library_((choose_encoding(), std::make_unique<Library>())) {
  Library& l = *library_;
  l.file = std::move(history);
  l.complete = std::move(complete);
  el_set(l.line, EL_CLIENTDATA, &l);
  el_set(l.line, EL_PROMPT_ESC, &Library::show_prompt, kEscape);
  el_set(l.line, EL_EDITOR, "emacs");
  el_set(l.line, EL_SIGNAL, 0);
  el_set(l.line, EL_GETCFN, &Library::read_character);
  el_set(l.line, EL_ADDFN, "regulus-complete", "complete a word", &Library::on_tab);
  el_set(l.line, EL_BIND, "^I", "regulus-complete", nullptr);
  ::history(l.history, &l.event, H_SETSIZE, kLinesKept);
  ::history(l.history, &l.event, H_SETUNIQUE, 1);
  if (!l.file.empty()) ::history(l.history, &l.event, H_LOAD, l.file.c_str());
  el_set(l.line, EL_HIST, ::history, l.history);
}

std::optional<std::string> LineEditor::next(const std::string& prompt) {
  const InterruptsWait waiting;
  library_->prompt = takes_colours(STDOUT_FILENO) ? in_bold(prompt) : prompt;
  library_->waiting = &waiting;
  int count = 0;
  errno = 0;
  const char* typed = el_gets(library_->line, &count);
  if (typed == nullptr) {
    if (errno != EINTR) return std::nullopt;
    std::cout << std::endl;
    el_reset(library_->line);
    return "";
  }
  std::string line(typed, static_cast<std::size_t>(count));
  while (line.ends_with('\n')) line.pop_back();
  if (line.find_first_not_of(" \t") != std::string::npos) {
    ::history(library_->history, &library_->event, H_ENTER, line.c_str());
    library_->save();
  }
  return line;
}

#else

struct LineEditor::Library {};

LineEditor::LineEditor(std::filesystem::path, Complete) : library_(std::make_unique<Library>()) {}

std::optional<std::string> LineEditor::next(const std::string& prompt) {
  std::cout << prompt << std::flush;
  std::string line;
  errno = 0;
  if (std::getline(std::cin, line)) return line;
  if (errno != EINTR) return std::nullopt;
  std::cin.clear();
  clearerr(stdin);
  std::cout << std::endl;
  return "";
}

#endif

LineEditor::~LineEditor() = default;

}  // namespace regulus::detail
