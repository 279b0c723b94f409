# SPDX-License-Identifier: Apache-2.0
# The Python package trueaxis: one module of C++ (python/src) and what is written in Python around it.
pybind11_add_module(trueaxis_python MODULE NO_EXTRAS python/src/command.cpp python/src/lathe.cpp python/src/machine.cpp
  python/src/module.cpp python/src/points.cpp python/src/stream.cpp)
target_link_libraries(trueaxis_python PRIVATE trueaxis_cli nlohmann_json::nlohmann_json)
trueaxis_link_core_first(trueaxis_python)
set_target_properties(trueaxis_python PROPERTIES OUTPUT_NAME _core UNITY_BUILD ${TRUEAXIS_UNITY} UNITY_BUILD_BATCH_SIZE 0
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/python/trueaxis")

# The package of this build, for tests and for PYTHONPATH: its Python files are links into the source.
file(GLOB TRUEAXIS_PYTHON_FILES RELATIVE "${PROJECT_SOURCE_DIR}/python" CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/python/trueaxis/*.py" "${PROJECT_SOURCE_DIR}/python/trueaxis/*.pyi" "${PROJECT_SOURCE_DIR}/python/trueaxis/py.typed")
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/python/trueaxis")
foreach(file IN LISTS TRUEAXIS_PYTHON_FILES)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/python/${file}" "${PROJECT_BINARY_DIR}/python/${file}" SYMBOLIC)
endforeach()

if(TRUEAXIS_TESTS)
  file(GLOB tests CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/tests/test_*.py")
  foreach(test IN LISTS tests)
    get_filename_component(name "${test}" NAME_WE)
    add_test(NAME python.${name} COMMAND "${Python_EXECUTABLE}" -m pytest -q -p no:cacheprovider "${test}")
    set_tests_properties(python.${name} PROPERTIES LABELS python TIMEOUT 400 ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;MPLBACKEND=Agg;TRUEAXIS_COMMAND=$<TARGET_FILE:trueaxis>;TRUEAXIS_BUILD=${PROJECT_BINARY_DIR}")
  endforeach()
  set_tests_properties(python.test_install PROPERTIES COST 100 RESOURCE_LOCK build)  # it builds
endif()
