# SPDX-License-Identifier: GPL-3.0-or-later
# The package regulus for Python: for a system in the folder of Debian, in a wheel at its root, with
# the plugins and the models, which are then not those of a system.
set_target_properties(regulus_python PROPERTIES INSTALL_RPATH_USE_LINK_PATH TRUE)
if(DEFINED SKBUILD)
  set(python_dir .)
  install(TARGETS regulus_pack_plugin regulus_clang_plugin
          LIBRARY DESTINATION regulus/plugins COMPONENT wheel)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/models DESTINATION regulus
          COMPONENT wheel FILES_MATCHING PATTERN "*.toml")
  install(FILES ${PROJECT_BINARY_DIR}/share/regulus/page.html DESTINATION regulus
          COMPONENT wheel OPTIONAL)
else()
  set(python_dir lib/python3/dist-packages)
endif()
install(TARGETS regulus_python LIBRARY DESTINATION ${python_dir}/regulus COMPONENT python)
file(GLOB python_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/codegen/use/python/regulus/*.py
     ${PROJECT_SOURCE_DIR}/codegen/use/python/regulus/*.pyi ${PROJECT_SOURCE_DIR}/codegen/use/python/regulus/py.typed)
install(FILES ${python_sources} ${PROJECT_BINARY_DIR}/codegen/answer/reports.py DESTINATION ${python_dir}/regulus COMPONENT python)
if(NOT DEFINED SKBUILD)
  install(FILES ${PROJECT_BINARY_DIR}/share/doc/python3-regulus/PYTHON.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-regulus COMPONENT python)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/codegen/use/python/examples
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-regulus COMPONENT python FILES_MATCHING PATTERN "*.ipynb")
  regulus_install_licences(${CMAKE_INSTALL_DATADIR}/doc/python3-regulus python)
endif()
