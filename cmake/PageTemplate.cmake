# SPDX-License-Identifier: GPL-3.0-or-later
# share/regulus/page.html, the page that `regulus report` fills: TypeScript of codegen/answer/page/web, bundled
# with three.js by esbuild. Packages come from npm at configuration, as package-lock.json pins them. Without
# npm or its packages everything else is built, and `regulus report` says what is missing.
option(REGULUS_PAGE "Build the page of `regulus report`, if npm and its packages are there" ON)
set(REGULUS_PAGE_TEMPLATE "" CACHE INTERNAL "The built page; empty: there is none")
if(NOT REGULUS_PAGE)
  return()
endif()
find_program(REGULUS_NPM npm)
find_program(REGULUS_NODE NAMES node nodejs)
if(NOT REGULUS_NPM OR NOT REGULUS_NODE)
  message(STATUS "npm not found: `regulus report` will be missing its page (Debian: npm)")
  return()
endif()

set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(work ${CMAKE_CURRENT_BINARY_DIR}/web)
set(REGULUS_PAGE_WORK ${work} CACHE INTERNAL "The folder with the packages of the page")

# regulus_get_packages(FOLDER WORK RESULT): gets the packages of FOLDER/package-lock.json into WORK, unless
# they are there; RESULT is false, after a warning, if npm cannot.
function(regulus_get_packages folder work result)
  set(${result} TRUE PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/package.json ${folder}/package-lock.json)
  file(SHA256 ${folder}/package-lock.json wanted)
  set(installed "")
  if(EXISTS ${work}/installed-lock)
    file(READ ${work}/installed-lock installed)
  endif()
  if(installed STREQUAL wanted)
    return()
  endif()
  file(MAKE_DIRECTORY ${work})
  foreach(file IN ITEMS package.json package-lock.json .npmrc)
    configure_file(${folder}/${file} ${work}/${file} COPYONLY)
  endforeach()
  message(STATUS "Getting the packages of ${folder}/package-lock.json with npm")
  execute_process(COMMAND ${REGULUS_NPM} ci --ignore-scripts --fetch-retries=1 --fetch-timeout=60000
                  WORKING_DIRECTORY ${work} TIMEOUT 300
                  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT failed)
    file(WRITE ${work}/installed-lock ${wanted})
    return()
  endif()
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  if(lines)
    list(SUBLIST lines 0 6 lines)
  endif()
  list(JOIN lines "\n  " output)
  message(WARNING "npm could not get the packages of ${folder} (${failed}). Everything that does not need them is "
                  "built. Run cmake again with a network.\n  ${output}")
  set(${result} FALSE PARENT_SCOPE)
endfunction()

regulus_get_packages(${web} ${work} have_packages)
if(NOT have_packages)
  return()
endif()

file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/build.mjs ${web}/tsconfig.json)
set(page_template ${PROJECT_BINARY_DIR}/share/regulus/page.html)
add_custom_command(
  OUTPUT ${page_template}
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${work}/src
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/src ${work}/src
  COMMAND ${CMAKE_COMMAND} -E copy ${web}/build.mjs ${web}/tsconfig.json ${work}
  COMMAND ${REGULUS_NODE} build.mjs ${page_template}
  WORKING_DIRECTORY ${work}
  DEPENDS ${page_sources} ${web}/package-lock.json
  COMMENT "Building the page of regulus report"
  VERBATIM)
add_custom_target(regulus_page_template ALL DEPENDS ${page_template})
set(REGULUS_PAGE_TEMPLATE ${page_template} CACHE INTERNAL "The built page; empty: there is none")
