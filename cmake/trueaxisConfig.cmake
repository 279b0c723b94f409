# SPDX-License-Identifier: Apache-2.0
# find_package(trueaxis COMPONENTS core) gives trueaxis::core.
include(CMakeFindDependencyMacro)
find_dependency(Ceres)
find_dependency(Eigen3)
find_dependency(fmt)
find_dependency(PkgConfig)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
include("${CMAKE_CURRENT_LIST_DIR}/trueaxisCoreTargets.cmake")
set(trueaxis_core_FOUND TRUE)
