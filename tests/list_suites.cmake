# SPDX-License-Identifier: Apache-2.0
# Writes the tests of ctest of a test program, a process for each suite: PROGRAM, GROUP (the label), FIRST (suites that take
# long), LINUXCNC (suites that need LinuxCNC, which has one memory of HAL and one tool table for the whole machine), OUT.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_VARIABLE all COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." suites "\n${all}")
# Skipped is what skips all of its tests: a failure next to a skipped test is a failure.
set(skipped [=[\[  PASSED  \] 0 tests\.\n\[  SKIPPED \] [0-9]+ tests?, listed below:(\n\[  SKIPPED \] [A-Za-z0-9_./]+)+\n*$]=])
set(text "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  set(properties "LABELS ${GROUP} SKIP_REGULAR_EXPRESSION [==[${skipped}]==]")
  if(suite IN_LIST FIRST)
    string(APPEND properties " COST 100")
  endif()
  if(LINUXCNC AND suite MATCHES "${LINUXCNC}")
    string(APPEND properties " RESOURCE_LOCK linuxcnc")
  endif()
  string(APPEND text "add_test([=[${GROUP}.${suite}]=] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
    "set_tests_properties([=[${GROUP}.${suite}]=] PROPERTIES ${properties})\n")
endforeach()
file(WRITE "${OUT}" "${text}")
