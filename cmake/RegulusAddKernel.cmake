# SPDX-License-Identifier: Apache-2.0
# regulus_add_kernel(TARGET MODEL robot.toml | SOURCE robot.cpp MOTION name
#                    [ISA avx512 avx2 portable] [NAMESPACE ns] [NAME name]
#                    [RANGE p=LO:HI ...] [TOLERANCE group=E ...] [ALPHA a] [FROM_TEXT])
#
# A library TARGET that checks pieces of one motion of a robot: the kernel is generated if the model
# or the generator has changed, and compiled for each instruction set with the flags it needs.
#
#   MODEL      model file, relative to the current source folder
#   SOURCE     instead, the model in C++: a file that defines regulus_model()
#              (codegen/model/robot/AUTHORS.md). Needs the component codegen, and runs on this machine
#   MOTION     one of its motions; may be left out if there is only one
#   ISA        instruction sets; the program chooses one at run time, and portable is always
#              included. Default: all of the target processor's family
#   NAME       of the headers NAME.h (C) and NAME.hpp (C++) and of the symbols in them. Default: TARGET
#   NAMESPACE  of the C++ header. Default: NAME
#   RANGE, TOLERANCE, ALPHA   change the motion or the model, as the options of `regulus check`
#   FROM_TEXT  compile the kernel's C++ text by this project's compiler. Otherwise the command compiles
#              it in process, which takes a twentieth of the time, if the program is for x86-64 Linux as
#              this machine is, without sanitizers, and the command finds its compiler
#
# Defines   TARGET, a static library that links Regulus::runtime and has its headers' folder; it has
#           the class NS::Checker and the functions NAME_checker_new, NAME_check.
# Requires  find_package(Regulus COMPONENTS runtime), or Regulus's own tree; CXX enabled. The
#           command regulus runs on this machine. It is the package's command, unless
#           REGULUS_HOST_TOOL names another, for example to compile for another processor or root.
# Errors    fatal, with a message, for a missing argument or file, an unknown instruction set, or
#           flags that break directed rounding (-ffast-math). A mistake in a model stops the build
#           with file and line.
set(REGULUS_HOST_TOOL "" CACHE FILEPATH "The command regulus that generates kernels; empty: the package's own")

# The command to run, and the dependencies of a kernel.
function(_regulus_host_tool tool)
  if(REGULUS_HOST_TOOL)
    if(NOT EXISTS ${REGULUS_HOST_TOOL})
      message(FATAL_ERROR "regulus_add_kernel: there is no REGULUS_HOST_TOOL ${REGULUS_HOST_TOOL}")
    endif()
    set(${tool} ${REGULUS_HOST_TOOL} PARENT_SCOPE)
  elseif(TARGET Regulus::regulus)
    set(${tool} Regulus::regulus PARENT_SCOPE)
  else()
    message(FATAL_ERROR "regulus_add_kernel: the command regulus is not installed beside the package; "
                        "set REGULUS_HOST_TOOL to one that runs on this machine")
  endif()
endfunction()

# Instruction sets in the order of the list; portable is always included.
function(_regulus_instruction_sets chosen)
  foreach(isa IN LISTS ARGN)
    if(NOT isa IN_LIST REGULUS_ISA_NAMES)
      message(FATAL_ERROR "regulus_add_kernel: ISA found '${isa}', expected some of: ${REGULUS_ISA_NAMES}")
    elseif(NOT isa IN_LIST REGULUS_ISA_BUILT)
      message(FATAL_ERROR "regulus_add_kernel: ISA ${isa}: processors of the family "
                          "'${CMAKE_SYSTEM_PROCESSOR}' do not have it")
    endif()
  endforeach()
  set(sets ${ARGN})
  if(NOT sets)
    set(sets ${REGULUS_ISA_BUILT})
  endif()
  list(APPEND sets portable)
  list(REMOVE_DUPLICATES sets)
  set(${chosen} ${sets} PARENT_SCOPE)
endfunction()

# Flags that would reach the kernel from outside.
function(_regulus_refuse_unsound_surroundings)
  get_directory_property(options COMPILE_OPTIONS)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  regulus_refuse_unsound_flags("${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_${type}}" "${options}")
endfunction()

# True if the command can compile kernels for this project.
function(_regulus_compiles_objects result tool)
  set(${result} FALSE PARENT_SCOPE)
  get_directory_property(options COMPILE_OPTIONS)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  if(REGULUS_HOST_TOOL OR CMAKE_CROSSCOMPILING OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux"
     OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
     OR "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${options}" MATCHES "-fsanitize|-m32|-mx32")
    return()
  endif()
  if(NOT TARGET regulus_clang_plugin AND NOT DEFINED CACHE{REGULUS_COMPILES_OBJECTS}) # not Regulus's own tree
    set(trial ${CMAKE_BINARY_DIR}/CMakeFiles/regulus_trial)
    file(WRITE ${trial}/trial.toml "regulus = 1\nname = \"trial\"\n[pose]\nx = \"1\"\n"
                                   "[matrix]\nrows = [[\"x\"]]\n[motion.trial]\nx = [1, 2]\n")
    get_target_property(command ${tool} LOCATION)
    execute_process(COMMAND ${command} generate ${trial}/trial.toml -o ${trial} --isa portable --object --quiet
                    RESULT_VARIABLE fault OUTPUT_QUIET ERROR_QUIET)
    if(fault STREQUAL "0")
      set(REGULUS_COMPILES_OBJECTS TRUE CACHE INTERNAL "The command regulus compiles kernels")
    else()
      set(REGULUS_COMPILES_OBJECTS FALSE CACHE INTERNAL "The command regulus compiles kernels")
    endif()
  endif()
  if(TARGET regulus_clang_plugin OR REGULUS_COMPILES_OBJECTS)
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Adds the files, by one run of the generator, and their library. `compiled`: the command compiles the
# kernel.
function(_regulus_kernel_library target name isas compiled)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.kernel)
  set(files ${folder}/${name}.h ${folder}/${name}.hpp ${folder}/${name}.cpp ${folder}/${name}_kernel.inc)
  set(kernels "")
  set(object_option "")
  foreach(isa IN LISTS isas)
    list(APPEND files ${folder}/${name}_${isa}.cpp)
    if(compiled)
      list(APPEND kernels ${folder}/${name}_${isa}.o)
      set(object_option --object)
      set_source_files_properties(${folder}/${name}_${isa}.o PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
      set_source_files_properties(${folder}/${name}_${isa}.cpp PROPERTIES HEADER_FILE_ONLY TRUE)
      continue()
    endif()
    # -fno-lto: the caller of a kernel sets its rounding, so it must not inline the kernel.
    set_source_files_properties(${folder}/${name}_${isa}.cpp PROPERTIES
      COMPILE_OPTIONS "${REGULUS_ISA_FLAGS_${isa}};-fno-lto" OBJECT_DEPENDS ${folder}/${name}_kernel.inc)
  endforeach()
  cmake_parse_arguments(PARSE_ARGV 4 run "" "" "COMMAND;DEPENDS")
  list(JOIN isas "," isa_list)
  add_custom_command(
    OUTPUT ${files} ${kernels}
    COMMAND ${run_COMMAND} --name ${name} --isa ${isa_list} -o ${folder} ${object_option} --quiet
    DEPENDS ${run_DEPENDS}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    COMMENT "Generating the kernel ${name}"
    VERBATIM)
  add_library(${target} STATIC ${files} ${kernels})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${folder}>)
  target_link_libraries(${target} PUBLIC Regulus::runtime)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON POSITION_INDEPENDENT_CODE ON INTERPROCEDURAL_OPTIMIZATION OFF)
endfunction()

# The model file of a robot in C++: a program of that source and our main writes it.
function(_regulus_model_of_source target source model)
  if(NOT TARGET Regulus::codegen)
    message(FATAL_ERROR "regulus_add_kernel(${target}): SOURCE needs find_package(Regulus COMPONENTS codegen)")
  elseif(CMAKE_CROSSCOMPILING)
    message(FATAL_ERROR "regulus_add_kernel(${target}): SOURCE is run on this machine, and everything here is "
                        "compiled for another; write its model file here and give that as MODEL")
  endif()
  set(main ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/write_model.cpp)
  if(NOT EXISTS ${main}) # Regulus's own tree
    set(main ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../codegen/model/robot/examples/write_model.cpp)
  endif()
  add_executable(${target}_model ${source} ${main})
  target_link_libraries(${target}_model PRIVATE Regulus::codegen)
  add_custom_command(
    OUTPUT ${model}
    COMMAND ${target}_model > ${model}.part
    COMMAND ${CMAKE_COMMAND} -E rename ${model}.part ${model}
    DEPENDS ${target}_model
    COMMENT "Writing the model ${target}"
    VERBATIM)
endfunction()

function(regulus_add_kernel target)
  # Here, because the lists may not have been read in the caller's folder.
  include(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/FloatingPoint.cmake)
  include(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/InstructionSets.cmake)
  cmake_parse_arguments(PARSE_ARGV 1 kernel "FROM_TEXT" "MODEL;SOURCE;MOTION;NAMESPACE;NAME;ALPHA" "ISA;RANGE;TOLERANCE")
  if(kernel_UNPARSED_ARGUMENTS OR kernel_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "regulus_add_kernel(${target}): found '${kernel_UNPARSED_ARGUMENTS}'"
                        "${kernel_KEYWORDS_MISSING_VALUES}, expected MODEL file | SOURCE file [MOTION name] [ISA ...] "
                        "[NAMESPACE ns] [NAME name] [RANGE ...] [TOLERANCE ...] [ALPHA a] [FROM_TEXT]")
  endif()
  if(kernel_MODEL AND kernel_SOURCE)
    message(FATAL_ERROR "regulus_add_kernel(${target}): found MODEL and SOURCE, expected one of them")
  elseif(NOT kernel_MODEL AND NOT kernel_SOURCE)
    message(FATAL_ERROR "regulus_add_kernel(${target}): MODEL is missing")
  endif()
  get_filename_component(model ${kernel_MODEL}${kernel_SOURCE} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT EXISTS ${model})
    message(FATAL_ERROR "regulus_add_kernel(${target}): there is no model file ${model}")
  endif()
  if(kernel_SOURCE)
    set(kernel_MODEL ${CMAKE_CURRENT_BINARY_DIR}/${target}.toml)
    _regulus_model_of_source(${target} ${model} ${kernel_MODEL})
    set(model ${kernel_MODEL})
  endif()
  if(NOT kernel_NAME)
    set(kernel_NAME ${target})
  endif()
  _regulus_refuse_unsound_surroundings()
  _regulus_instruction_sets(isas ${kernel_ISA})
  _regulus_host_tool(tool)
  set(changes "")
  foreach(range IN LISTS kernel_RANGE)
    list(APPEND changes --range ${range})
  endforeach()
  foreach(tolerance IN LISTS kernel_TOLERANCE)
    list(APPEND changes --tolerance ${tolerance})
  endforeach()
  if(kernel_ALPHA)
    list(APPEND changes --alpha ${kernel_ALPHA})
  endif()
  if(kernel_NAMESPACE)
    list(APPEND changes --namespace ${kernel_NAMESPACE})
  endif()
  set(compiled FALSE)
  set(compiler "")
  if(NOT kernel_FROM_TEXT)
    _regulus_compiles_objects(compiled ${tool})
  endif()
  if(compiled AND TARGET regulus_clang_plugin)
    set(compiler regulus_clang_plugin)
  endif()
  _regulus_kernel_library(${target} ${kernel_NAME} "${isas}" ${compiled}
    COMMAND ${tool} generate ${kernel_MODEL} ${kernel_MOTION} ${changes}
    DEPENDS ${model} ${tool} ${compiler})
endfunction()
