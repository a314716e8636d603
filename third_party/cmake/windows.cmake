# Toolchain: compiles for 64-bit Windows with Debian's MinGW. VIETE_WINDOWS_PREFIX: the folder of the dependencies, which
# third_party/windows.sh builds. Programs are linked statically: they need no library that Windows lacks.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
# GCC aligns its stack to 16 bytes on Windows, but assumes 32 for AVX (GCC bug 54412): use moves that need no alignment. Unity batches have more sections than the usual object format allows.
set(CMAKE_CXX_FLAGS_INIT -Wa,-muse-unaligned-vector-move,-mbig-obj)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES VIETE_WINDOWS_PREFIX)
set(CMAKE_FIND_ROOT_PATH ${VIETE_WINDOWS_PREFIX})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${VIETE_WINDOWS_PREFIX}/lib/pkgconfig)
