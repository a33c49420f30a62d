# A browser, by Debian's emscripten (`make browser-lab`). Its C library and headers, and a clang of its own: called directly, so
# that precompiled headers and ccache work as elsewhere. Not the 14 that em++ calls: what that compiles cannot catch an exception
# in a program with threads (decision 0026). em++ links, and its own scripts want modules of Debian's node.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(PHY_BROWSER TRUE)
set(PHY_SYSROOT /usr/share/emscripten/cache/sysroot)
set(CMAKE_C_COMPILER clang-16)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_AR /usr/bin/llvm-ar-14 CACHE FILEPATH "")
set(CMAKE_RANLIB /usr/bin/llvm-ranlib-14 CACHE FILEPATH "")
set(CMAKE_C_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_CXX_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH ${PHY_SYSROOT})
# As em++ calls it with -pthread (em++ -v): the same objects are linked with threads and without. SSE2 is what emscripten's
# headers make of the 128-bit registers of WebAssembly. No MMX. Eigen takes clang for GCC 4.2, and writes instructions of SSE
# as text before 6.3 (as 10 times 6 and 3) and from 6 on. It divides products by its registers, 16 of SSE2 with 64 bits.
set(phy_flags "--sysroot=${PHY_SYSROOT} -isystem ${PHY_SYSROOT}/include/compat -DEMSCRIPTEN -D__EMSCRIPTEN_major__=3 -D__EMSCRIPTEN_minor__=1 -D__EMSCRIPTEN_tiny__=6 \
-D_LIBCPP_ABI_VERSION=2 -Dunix -D__unix -D__unix__ -D__SSE__=1 -D__SSE2__=1 -DEIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16 -D__MMINTRIN_H -fgnuc-version=5.13.0 -msimd128 -fwasm-exceptions \
-pthread -D__EMSCRIPTEN_PTHREADS__=1 -mllvm -combiner-global-alias-analysis=false -mllvm -enable-emscripten-sjlj -mllvm -disable-lsr")
set(CMAKE_C_FLAGS_INIT "${phy_flags}")
set(CMAKE_CXX_FLAGS_INIT "${phy_flags} -include ${CMAKE_CURRENT_LIST_DIR}/library.hpp")
set(CMAKE_CXX_LINK_EXECUTABLE "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs em++ -fwasm-exceptions <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
