# SPDX-License-Identifier: Apache-2.0
# What is installed, and the Debian packages made of it (cpack -G DEB): trueaxis, libtrueaxis-dev, python3-trueaxis.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Component core: the library. Files and report have no header of their own.
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/trueaxis")
install(TARGETS trueaxis_core EXPORT trueaxisCoreTargets COMPONENT core ARCHIVE FILE_SET HEADERS)
install(EXPORT trueaxisCoreTargets NAMESPACE trueaxis:: DESTINATION ${package} COMPONENT core)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/trueaxisConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES cmake/trueaxisConfig.cmake "${PROJECT_BINARY_DIR}/trueaxisConfigVersion.cmake"
  DESTINATION ${package} COMPONENT core)
if(TRUEAXIS_CORE_ONLY)
  return()
endif()

# Component command: the program with its page, completions, documentation and the data that the documentation uses.
install(TARGETS trueaxis RUNTIME COMPONENT command)
install(FILES "${PROJECT_BINARY_DIR}/trueaxis.bash" RENAME trueaxis
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT command)
set(zsh "${CMAKE_INSTALL_DATADIR}/zsh")  # zsh looks for packages and for /usr/local in folders of different names
install(FILES "${PROJECT_BINARY_DIR}/_trueaxis" DESTINATION ${zsh}/vendor-completions COMPONENT command EXCLUDE_FROM_ALL)
install(FILES "${PROJECT_BINARY_DIR}/_trueaxis" DESTINATION ${zsh}/site-functions COMPONENT local)
install(FILES "${PROJECT_BINARY_DIR}/trueaxis.1.gz" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
install(DIRECTORY docs data DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command PATTERN LICENSE EXCLUDE)
if(TARGET trueaxis-mpi)
  install(TARGETS trueaxis-mpi RUNTIME COMPONENT local)
endif()

# Component python: where Debian's interpreter looks for packages. Elsewhere pip installs it.
if(TARGET trueaxis_python)
  install(TARGETS trueaxis_python LIBRARY DESTINATION lib/python3/dist-packages/trueaxis COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY python/trueaxis DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL
    PATTERN __pycache__ EXCLUDE)
endif()

# The Debian packages. The library's names are those of its exact versions: their object code is in ours.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "TrueAxis maintainers <trueaxis@packages.invalid>" CACHE STRING "Maintainer of the packages")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~deb12)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL command core)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(about "A probe streams readings while the spindle of a lathe turns. TrueAxis
identifies where the reference surfaces of the clamped part are, states the
uncertainty, names the causes of what does not fit, and writes correction
tables and programs that cut true to the part as it is clamped.")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME trueaxis)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "python3-trueaxis, libtrueaxis-dev")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "axis of a clamped part from probe readings\n${about}")

# range(VARIABLE PACKAGE VERSION): "PACKAGE (>= 9.1), PACKAGE (<< 9.2~)".
function(trueaxis_range variable package version)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" from "${version}")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  set(${variable} "${package} (>= ${from}), ${package} (<< ${CMAKE_MATCH_1}.${next}~)" PARENT_SCOPE)
endfunction()
trueaxis_range(ceres libceres-dev "${Ceres_VERSION}")
trueaxis_range(fmt libfmt-dev "${fmt_VERSION}")
trueaxis_range(hwy libhwy-dev "${HWY_VERSION}")
set(CPACK_DEBIAN_CORE_PACKAGE_NAME libtrueaxis-dev)
set(CPACK_DEBIAN_CORE_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_CORE_PACKAGE_DEPENDS "${ceres}, ${fmt}, ${hwy}, libeigen3-dev (>= 3.4), pkgconf | pkg-config")
set(CPACK_DEBIAN_CORE_PACKAGE_RECOMMENDS "cmake, g++")
set(CPACK_DEBIAN_CORE_DESCRIPTION
    "axis of a clamped part from probe readings - C++ library\n${about}\n\nThis package has the static library, its headers and its CMake package.")

if(TARGET trueaxis_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  trueaxis_range(interpreter python3 "${Python_VERSION}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-trueaxis)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${interpreter}, python3-numpy (>= 1:1.20)")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-pandas)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/cmake/debian/postinst" "${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
    "axis of a clamped part from probe readings - Python module\n${about}\n\nThis package has the Python module with its type stubs.")
endif()

# What each package has in its folder of documentation.
set(papers "${PROJECT_BINARY_DIR}/debian")
set(names notice zrender d3 expat)
set(files third_party/echarts/NOTICE third_party/echarts/LICENSE-zrender third_party/echarts/LICENSE-d3 data/measured/LICENSE)
foreach(name file IN ZIP_LISTS names files)
  file(READ ${file} text)
  string(STRIP "${text}" text)
  string(REGEX REPLACE "\n[ \t]*\n" "\n.\n" text "${text}")
  string(REPLACE "\n" "\n " ${name} " ${text}")
endforeach()
configure_file(cmake/debian/copyright.in "${papers}/copyright" @ONLY)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, which the script sets
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(name ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  configure_file(cmake/debian/changelog.in "${papers}/${name}/changelog.Debian" @ONLY)
  configure_file(CHANGELOG.md "${papers}/${name}/changelog" COPYONLY)
  execute_process(COMMAND gzip -9nf changelog changelog.Debian WORKING_DIRECTORY "${papers}/${name}" COMMAND_ERROR_IS_FATAL ANY)
  install(FILES "${papers}/${name}/changelog.gz" "${papers}/${name}/changelog.Debian.gz" "${papers}/copyright"
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
