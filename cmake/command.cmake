# SPDX-License-Identifier: Apache-2.0
# trueaxis::trueaxis adds every format in and out and the report to the core; the commands are built on it.
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
set(TRUEAXIS_HDF5_DEFAULT ON)
if(WIN32)  # libraries are static, and Debian has no HDF5
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
  set(TRUEAXIS_STATIC_ZLIB zlib)
  set(TRUEAXIS_HDF5_DEFAULT OFF)
endif()
pkg_check_modules(INTERCHANGE REQUIRED IMPORTED_TARGET libzip ${TRUEAXIS_STATIC_ZLIB} pugixml libmd)
option(TRUEAXIS_HDF5 "Read HDF5 and MATLAB files" ${TRUEAXIS_HDF5_DEFAULT})
if(TRUEAXIS_HDF5)
  pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5 matio)
  # Debian's folder of HDF5 has links to libraries that are where the system looks: no run path.
  list(APPEND CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES ${HDF5_LIBRARY_DIRS})
  list(FILTER CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES INCLUDE REGEX "^/usr/|^/lib")
  list(FILTER TRUEAXIS_FILES EXCLUDE REGEX "/interchange/no_hdf5\\.cpp$")
else()
  list(FILTER TRUEAXIS_FILES EXCLUDE REGEX "/interchange/(hdf5|matlab)\\.cpp$")
endif()

file(GLOB TRUEAXIS_ASSETS CONFIGURE_DEPENDS src/report/*.js src/report/*.css src/report/*.html)
# Words, JSON and pages take as long to optimise as to compile and are written once a run; what reads and writes whole
# streams is optimised in full.
set(TRUEAXIS_WORDS ${TRUEAXIS_FILES})
list(FILTER TRUEAXIS_WORDS EXCLUDE REGEX "/src/(format|recording|interchange|measure)/|\\.S$")
list(REMOVE_ITEM TRUEAXIS_FILES ${TRUEAXIS_WORDS})
add_library(trueaxis_words OBJECT ${TRUEAXIS_WORDS})
target_compile_options(trueaxis_words PRIVATE $<$<CONFIG:Release>:-O1>)
add_library(trueaxis_lib STATIC ${TRUEAXIS_FILES})
add_library(trueaxis::trueaxis ALIAS trueaxis_lib)
set_target_properties(trueaxis_lib PROPERTIES OUTPUT_NAME trueaxis EXPORT_NAME trueaxis)
foreach(target trueaxis_words trueaxis_lib)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PRIVATE src)
  target_compile_definitions(${target} PRIVATE TRUEAXIS_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PUBLIC trueaxis_core PRIVATE $<BUILD_INTERFACE:trueaxis_flags> Eigen3::Eigen
    nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus fmt::fmt PkgConfig::XXHASH PkgConfig::INTERCHANGE $<TARGET_NAME_IF_EXISTS:PkgConfig::HDF5>)
  trueaxis_compile_rooms_as_one(${target})
endforeach()
target_sources(trueaxis_lib PRIVATE $<TARGET_OBJECTS:trueaxis_words>)
trueaxis_read_once(trueaxis_words <nlohmann/json.hpp> <fmt/format.h> <map>)
set_source_files_properties(src/report/assets.S PROPERTIES COMPILE_DEFINITIONS TRUEAXIS_ECHARTS="${TRUEAXIS_ECHARTS}"
  OBJECT_DEPENDS "${TRUEAXIS_ECHARTS};${TRUEAXIS_ASSETS}")

# A journal says which build wrote it: a hash of the library's files, one small source.
file(GLOB_RECURSE TRUEAXIS_PRIVATE_HEADERS CONFIGURE_DEPENDS src/*.hpp)
list(FILTER TRUEAXIS_PRIVATE_HEADERS EXCLUDE REGEX "/src/(cli|mpi)/")
set(TRUEAXIS_HASHED ${TRUEAXIS_SOURCES} ${TRUEAXIS_HEADERS} ${TRUEAXIS_PRIVATE_HEADERS} ${TRUEAXIS_ASSETS})
list(TRANSFORM TRUEAXIS_HASHED REPLACE "^${PROJECT_SOURCE_DIR}/" "")
list(SORT TRUEAXIS_HASHED)
add_custom_command(OUTPUT "${PROJECT_BINARY_DIR}/build_id.cpp"
  COMMAND "${CMAKE_COMMAND}" "-DFILES=${TRUEAXIS_HASHED}" "-DOUT=${PROJECT_BINARY_DIR}/build_id.cpp"
    -P src/base/build_id.cmake
  DEPENDS ${TRUEAXIS_HASHED} src/base/build_id.cmake
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" COMMENT "Build id" VERBATIM)
target_sources(trueaxis_lib PRIVATE "${PROJECT_BINARY_DIR}/build_id.cpp")

# Studies beside the library: what only the command needs.
file(GLOB_RECURSE TRUEAXIS_STUDIES CONFIGURE_DEPENDS studies/*.cpp studies/*.S)
file(GLOB_RECURSE TRUEAXIS_STUDY_SCRIPTS CONFIGURE_DEPENDS studies/*.js)
add_library(trueaxis_studies STATIC ${TRUEAXIS_STUDIES})
set_target_properties(trueaxis_studies PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(trueaxis_studies PUBLIC "${PROJECT_SOURCE_DIR}" PRIVATE src)
target_compile_definitions(trueaxis_studies PRIVATE TRUEAXIS_VERSION="${PROJECT_VERSION}")
target_link_libraries(trueaxis_studies PUBLIC trueaxis_lib PRIVATE trueaxis_flags
  Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt)
trueaxis_compile_rooms_as_one(trueaxis_studies)
set_source_files_properties(studies/published/assets.S PROPERTIES OBJECT_DEPENDS "${TRUEAXIS_STUDY_SCRIPTS}")

# The commands, once for both programs. CLI11 is all headers, and what they make is not worth optimising.
file(GLOB TRUEAXIS_CLI CONFIGURE_DEPENDS src/cli/*.cpp)
list(REMOVE_ITEM TRUEAXIS_CLI "${PROJECT_SOURCE_DIR}/src/cli/main.cpp")
add_library(trueaxis_cli STATIC ${TRUEAXIS_CLI})
set_target_properties(trueaxis_cli PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(trueaxis_cli PUBLIC src)
target_compile_definitions(trueaxis_cli PUBLIC TRUEAXIS_VERSION="${PROJECT_VERSION}")
target_link_libraries(trueaxis_cli PUBLIC trueaxis_studies trueaxis_flags CLI11::CLI11 fmt::fmt)
target_compile_options(trueaxis_cli PUBLIC $<$<CONFIG:Release>:-O1>)
trueaxis_compile_rooms_as_one(trueaxis_cli)
add_executable(trueaxis src/cli/main.cpp)
target_link_libraries(trueaxis PRIVATE trueaxis_cli glog::glog)
trueaxis_link_core_first(trueaxis)
if(WIN32)
  enable_language(RC)
  target_sources(trueaxis PRIVATE src/platform/trueaxis.rc)
  find_library(TRUEAXIS_MATHEMATICS mathematics REQUIRED)  # in place of those of Windows
  target_link_libraries(trueaxis PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,${TRUEAXIS_MATHEMATICS}>")
endif()
# What is made of its tables of options is installed beside it.
if(NOT CMAKE_CROSSCOMPILING)
  add_custom_command(TARGET trueaxis POST_BUILD
    COMMAND trueaxis completion bash > "${PROJECT_BINARY_DIR}/trueaxis.bash"
    COMMAND trueaxis completion zsh > "${PROJECT_BINARY_DIR}/_trueaxis"
    COMMAND trueaxis man > "${PROJECT_BINARY_DIR}/trueaxis.1"
    COMMAND gzip -9nc "${PROJECT_BINARY_DIR}/trueaxis.1" > "${PROJECT_BINARY_DIR}/trueaxis.1.gz" VERBATIM)
endif()

# The same sweeps on several machines, where Open MPI is installed.
find_package(MPI QUIET COMPONENTS CXX)
if(MPI_CXX_FOUND)
  file(GLOB TRUEAXIS_MPI CONFIGURE_DEPENDS src/mpi/*.cpp)
  add_executable(trueaxis-mpi ${TRUEAXIS_MPI})
  target_compile_definitions(trueaxis-mpi PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(trueaxis-mpi PRIVATE trueaxis_cli glog::glog MPI::MPI_CXX)
  trueaxis_link_core_first(trueaxis-mpi)
endif()
