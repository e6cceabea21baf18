// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/filter_file.hpp"

#include <dlfcn.h>

#include <cfenv>
#include <cstdint>
#include <filesystem>

#include "codegen/model/file/read_file.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/shared_object.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kSymbol = "regulus_filter";
constexpr const char* kRemedy = "build it as a shared object with regulus/filter.h";

InputError not_loaded(const std::string& path, const std::string& why) {
  return InputError::statement(path, 0, "the filter cannot be loaded: " + why, kRemedy);
}

constexpr std::uint64_t kLargestFilter = std::uint64_t{256} << 20;

/// Throws InputError unless the file may be loaded: dlopen itself would crash on a truncated file.
std::string contents(const std::string& path) {
  std::string bytes = read_file(path, kLargestFilter, Readable::kFile);
  if (const auto fault = find_fault_in_shared_object(bytes)) throw not_loaded(path, *fault);
  return bytes;
}

/// Restores the floating-point environment, because the initialisers of a file built with
/// -ffast-math set flush-to-zero. Makes the path absolute, because dlopen would search for a bare
/// name elsewhere.
void* load(const std::string& path) {
  std::fenv_t kept;
  std::fegetenv(&kept);
  void* const library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  std::fesetenv(&kept);
  return library;
}

}  // namespace

void FilterFile::Close::operator()(void* library) const noexcept { dlclose(library); }

FilterFile::FilterFile(const std::string& path)
    : path_(path), sha256_(detail::sha256(contents(path))), library_(load(path)) {
  if (!library_) throw not_loaded(path, dlerror());
  filter_ = static_cast<const regulus_filter_interface*>(dlsym(library_.get(), kSymbol));
  if (filter_ == nullptr)
    throw InputError::statement(path, 0, "the shared object has no symbol " + std::string(kSymbol),
                                "define it as regulus/filter.h declares it");
  if (const auto fault = find_fault(*filter_))
    throw InputError::statement(path, 0, *fault, "regulus/filter.h describes the interface");
}

}  // namespace regulus::detail
