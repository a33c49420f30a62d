# 64-bit Windows 10 and 11 by Debian's mingw-w64: one file without a library of its own (`make windows`).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
# The stack has 16 bytes of alignment here, and g++ moves AVX registers to it as if it had 32 (GCC bug 54412): the
# assembler takes moves that need none. And templates have more sections than the usual object file counts.
# Nor may a caller count on the registers that the function in its own file leaves alone: the linker keeps one copy of an
# inline function, of a file that was perhaps compiled with other options. On ELF g++ knows that.
set(CMAKE_C_FLAGS_INIT "-fno-ipa-ra")
set(CMAKE_CXX_FLAGS_INIT "-fno-ipa-ra -D_WIN32_WINNT=0x0A00 -Wa,-muse-unaligned-vector-move,-mbig-obj -Wno-array-bounds")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -s")
