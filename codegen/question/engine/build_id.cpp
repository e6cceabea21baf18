// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <exception>
#include <string_view>

#include "codegen/kernel/jit/plugin.hpp"

namespace regulus::detail {
namespace {

/// Returns the build id in the notes of one segment; empty if there is none.
///
/// Requires  the segment is mapped, as those of a loaded object are.
std::string_view build_id_in(std::string_view notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    notes.remove_prefix(sizeof note);
    const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
    const std::size_t name_size = padded(note.n_namesz), size = padded(note.n_descsz);
    if (name_size > notes.size() || size > notes.size() - name_size) return {};
    const bool is_gnu = notes.substr(0, note.n_namesz) == std::string_view("GNU", 4);
    if (is_gnu && note.n_type == NT_GNU_BUILD_ID) return notes.substr(name_size, note.n_descsz);
    notes.remove_prefix(name_size + size);
  }
  return {};
}

std::string_view build_id_of(const dl_phdr_info& object) {
  for (unsigned i = 0; i < object.dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object.dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* begin = reinterpret_cast<const char*>(object.dlpi_addr + segment.p_vaddr);
    if (const auto id = build_id_in({begin, segment.p_memsz}); !id.empty()) return id;
  }
  return {};
}

/// The page that the operating system maps is not part of the program, and has no file.
bool is_of_the_system(std::string_view file) { return file.starts_with("linux-"); }

void append_object(const dl_phdr_info& object, std::string& text) {
  const std::string_view file = object.dlpi_name;
  if (is_of_the_system(file)) return;
  const std::string_view id = build_id_of(object);
  for (const char byte : id) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  if (id.empty()) text += file_identity(file.empty() ? "/proc/self/exe" : std::string(file));
  text += '\n';
}

struct Identity {
  std::string text;
  std::exception_ptr failure;
};

/// Called by C code: it must not throw, even if memory runs out.
int visit_object(dl_phdr_info* object, std::size_t, void* data) noexcept {
  auto& identity = *static_cast<Identity*>(data);
  try {
    append_object(*object, identity.text);
    return 0;
  } catch (...) {
    identity.failure = std::current_exception();
    return 1;
  }
}

std::string loaded_objects() {
  Identity identity;
  ::dl_iterate_phdr(visit_object, &identity);
  if (identity.failure) std::rethrow_exception(identity.failure);
  return identity.text;
}

}  // namespace

/// Constant in a process: a compiler that is loaded later has its own identity.
std::string build_id() {
  static const std::string identity = loaded_objects();
  return identity;
}

}  // namespace regulus::detail
