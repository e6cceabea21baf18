# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=… -DSOURCE_DIR=… -DHEADERS=a.hpp,b.hpp -DPROGRAM=c.hpp -P embed_headers.cmake
# Writes a C++ file with the texts of the headers and of the self-test program.
cmake_minimum_required(VERSION 3.25)

# A string literal of at most 65 536 characters is what every compiler accepts.
function(literal result file)
  file(READ ${SOURCE_DIR}/${file} text)
  if(text MATCHES "\\)regulus\"")
    message(FATAL_ERROR "${file} contains the delimiter of the literal it is put into")
  endif()
  set(${result} "R\"regulus(${text})regulus\"" PARENT_SCOPE)
endfunction()

set(entries "")
string(REPLACE "," ";" HEADERS "${HEADERS}")
foreach(header IN LISTS HEADERS)
  literal(text ${header})
  string(APPEND entries "    {\"runtime/kernel/${header}\", ${text}},\n")
endforeach()
literal(program ${PROGRAM})

file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
// Written by runtime/kernel/embed_headers.cmake.
#include \"runtime/kernel/kernel_headers.hpp\"

#include \"runtime/kernel/self_test.hpp\"

namespace regulus::detail {
namespace {
constexpr KernelHeader kHeaders[] = {
${entries}};
}  // namespace

std::span<const KernelHeader> kernel_headers() noexcept { return kHeaders; }
}  // namespace regulus::detail

namespace regulus {
const char* const kSelfTestSource = ${program};
}  // namespace regulus
")
