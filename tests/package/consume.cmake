# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD=<build tree> -DSOURCE=<project> -DSCRATCH=<folder> -DCOMPILER=<c++> -DFLAGS=… -P consume.cmake
# The project without Apache ECharts still configures. The core installed in a scratch prefix is found by the
# examples and by a program that calls every public function, which are built apart from the project and run; the
# command is installed with everything else.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY COMMAND_ECHO STDOUT)
endfunction()
set(tools -G Ninja "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=Release)

file(REMOVE_RECURSE "${SCRATCH}")
run("${CMAKE_COMMAND}" ${tools} -S "${SOURCE}" -B "${SCRATCH}/core" -DTRUEAXIS_ECHARTS=/nonexistent)
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/core_prefix" --component core)
foreach(project examples tests/package/every_function)
  run("${CMAKE_COMMAND}" ${tools} -S "${SOURCE}/${project}" -B "${SCRATCH}/${project}"
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/core_prefix")
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/${project}")
  run("${CMAKE_CTEST_COMMAND}" --test-dir "${SCRATCH}/${project}" --output-on-failure)
endforeach()
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix")
run("${SCRATCH}/prefix/bin/trueaxis" --version)
