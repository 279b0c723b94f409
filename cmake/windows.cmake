# SPDX-License-Identifier: Apache-2.0
# Toolchain file: programs for Windows by Debian's mingw-w64, with nothing but what Windows itself has.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(trueaxis_mingw x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${trueaxis_mingw}-gcc-posix)
set(CMAKE_CXX_COMPILER ${trueaxis_mingw}-g++-posix)
set(CMAKE_ASM_COMPILER ${trueaxis_mingw}-gcc-posix)
set(CMAKE_RC_COMPILER ${trueaxis_mingw}-windres)
# Windows aligns a stack to 16 bytes and GCC cannot align it further (its bug 54412): no move of a vector relies on it.
set(CMAKE_CXX_FLAGS_INIT "-Wa,-muse-unaligned-vector-move")
# Stacks are as large as on Linux, and the same program has the same bytes.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608 -Wl,--no-insert-timestamp")
set(CMAKE_FIND_ROOT_PATH "${CMAKE_CURRENT_LIST_DIR}/../build/windows/libraries" /usr/${trueaxis_mingw})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
