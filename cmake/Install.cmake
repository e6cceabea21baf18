# SPDX-License-Identifier: Apache-2.0
# cmake --install. No installed file depends on its place, so the folder can be moved.
#
#   --component runtime      files to build a program with a kernel: library, headers, CMake
#                               package, pkg-config file; with search, its threaded part
#   --component codegen      the commands, with models and documentation
#   --component mpi          regulus-mpi and its page of the manual
#   --component python       the module for Python
#   --component jit          plugins that the commands open for a compilation
#   --component development  libraries and headers of the front end and of the in-process compiler
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/ComponentLibraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/PublicHeaders.cmake)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Regulus)
# Next to bin, in the folder for libraries (codegen/kernel/jit/clang_compiler.cpp), and deep enough that
# CPack does not treat plugins as libraries and call ldconfig.
set(plugin_dir lib/regulus/plugins)

# regulus_export(NAME COMPONENT): the library and the file that defines its imported target.
function(regulus_export name component)
  install(TARGETS regulus_component_${name} EXPORT Regulus_${name}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT Regulus_${name} NAMESPACE Regulus:: FILE Regulus_${name}.cmake
          DESTINATION ${package_dir} COMPONENT ${component})
endfunction()

# regulus_install_headers(COMPONENT HEADERS...): installs them and the headers that they include,
# each with its path in the repository.
function(regulus_install_headers component)
  regulus_with_includes(headers ${PROJECT_SOURCE_DIR} ${ARGN})
  foreach(header IN LISTS headers)
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regulus/${folder}
            COMPONENT ${component})
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
endfunction()

# regulus_install_licences(FOLDER COMPONENT): installs the licences under Debian's file name.
function(regulus_install_licences folder component)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${folder} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE-APACHE-2.0 ${PROJECT_SOURCE_DIR}/LICENSE-GPL-3.0
          DESTINATION ${folder} COMPONENT ${component})
endfunction()

regulus_export(runtime runtime)
regulus_install_licences(${CMAKE_INSTALL_DATADIR}/doc/libregulus-dev runtime)
if(REGULUS_SEARCH)
  regulus_export(search runtime)
endif()
regulus_install_headers(runtime ${REGULUS_RUNTIME_HEADERS})
if(REGULUS_SEARCH)
  regulus_install_headers(runtime ${REGULUS_SEARCH_HEADERS})
endif()
install(FILES ${REGULUS_CONFIGURED_HEADERS}/regulus/filter.h
              ${REGULUS_CONFIGURED_HEADERS}/regulus/floating_point_flags.hpp
              ${REGULUS_CONFIGURED_HEADERS}/regulus/instruction_set_flags.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regulus COMPONENT runtime)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/package/RegulusConfig.cmake.in ${PROJECT_BINARY_DIR}/package/RegulusConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/RegulusConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/RegulusConfig.cmake
              ${PROJECT_BINARY_DIR}/package/RegulusConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FloatingPoint.cmake
              ${CMAKE_CURRENT_LIST_DIR}/InstructionSets.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RegulusAddKernel.cmake
        DESTINATION ${package_dir} COMPONENT runtime)

file(RELATIVE_PATH prefix_from_pkgconfig ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})
list(JOIN REGULUS_FLOATING_POINT_FLAGS " " floating_point_flags)
foreach(isa IN LISTS REGULUS_ISA_NAMES)
  list(JOIN REGULUS_ISA_FLAGS_${isa} " " ${isa}_flags)
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/package/regulus-runtime.pc.in
               ${PROJECT_BINARY_DIR}/package/regulus-runtime.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/regulus-runtime.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT runtime)

if(REGULUS_CODEGEN)
  # The libraries of this machine that are not in a standard folder, mainly LLVM's.
  set_target_properties(regulus regulus-verify regulus_pack_plugin regulus_clang_plugin
                        PROPERTIES INSTALL_RPATH_USE_LINK_PATH TRUE)
  install(TARGETS regulus EXPORT Regulus_command
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT codegen)
  install(TARGETS regulus-verify RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT codegen)
  install(EXPORT Regulus_command NAMESPACE Regulus:: FILE Regulus_command.cmake
          DESTINATION ${package_dir} COMPONENT codegen)
  if(REGULUS_MPI)
    set_target_properties(regulus-mpi PROPERTIES INSTALL_RPATH_USE_LINK_PATH TRUE)
    install(TARGETS regulus-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
    install(FILES ${PROJECT_BINARY_DIR}/share/doc/regulus-mpi/CLUSTER.md
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regulus-mpi COMPONENT mpi)
    install(FILES ${PROJECT_BINARY_DIR}/codegen/use/mpi/regulus-mpi.1
            DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT mpi)
    regulus_install_licences(${CMAKE_INSTALL_DATADIR}/doc/regulus-mpi mpi)
  endif()
  if(REGULUS_PYTHON)
    include(${CMAKE_CURRENT_LIST_DIR}/InstallPython.cmake)
  endif()
  install(TARGETS regulus_pack_plugin regulus_clang_plugin
          LIBRARY DESTINATION ${plugin_dir} COMPONENT jit)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/models DESTINATION ${CMAKE_INSTALL_DATADIR}/regulus
          COMPONENT codegen FILES_MATCHING PATTERN "*.toml")
  install(FILES ${PROJECT_SOURCE_DIR}/codegen/model/file/model.schema.json ${PROJECT_BINARY_DIR}/share/regulus/schema/report.schema.json
          DESTINATION ${CMAKE_INSTALL_DATADIR}/regulus/schema COMPONENT codegen)
  if(REGULUS_PAGE_TEMPLATE)
    install(FILES ${REGULUS_PAGE_TEMPLATE} DESTINATION ${CMAKE_INSTALL_DATADIR}/regulus COMPONENT codegen OPTIONAL)
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime/formal DESTINATION ${CMAKE_INSTALL_DATADIR}/regulus
          COMPONENT codegen FILES_MATCHING PATTERN "*.v" PATTERN "*.ml" PATTERN _CoqProject PATTERN "*.md")
  include(${CMAKE_CURRENT_LIST_DIR}/ManualPages.cmake)
  regulus_install_licences(${CMAKE_INSTALL_DATADIR}/doc/regulus codegen)

  regulus_export(codegen development)
  regulus_export(jit development)
  regulus_install_headers(development ${REGULUS_DEVELOPMENT_HEADERS})
  install(FILES ${REGULUS_CONFIGURED_HEADERS}/regulus/version.hpp ${REGULUS_CONFIGURED_HEADERS}/regulus/regulus.hpp
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regulus COMPONENT development)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/Arb.cmake ${CMAKE_CURRENT_LIST_DIR}/PkgConfigTarget.cmake
                ${CMAKE_CURRENT_LIST_DIR}/CodegenDependencies.cmake
                ${CMAKE_CURRENT_LIST_DIR}/package/plugin_folder.cpp
                ${PROJECT_SOURCE_DIR}/codegen/model/robot/examples/write_model.cpp
          DESTINATION ${package_dir} COMPONENT development)
endif()
