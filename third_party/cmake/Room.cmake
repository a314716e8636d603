# Compile settings of all targets, and functions that define the library of a room.

# -ffp-contract=off: the compiler must not replace a * b + c by fma(a, b, c), which rounds only once. Results
# are then the same at every optimisation level, in every kernel and on every machine.
add_library(viete_compile INTERFACE)
target_compile_features(viete_compile INTERFACE cxx_std_20)
target_compile_options(viete_compile INTERFACE
  -Wall -Wextra -Wconversion -Wno-sign-conversion -ffp-contract=off)
option(VIETE_WERROR "Compiler warnings are errors" OFF)
if(VIETE_WERROR)
  target_compile_options(viete_compile INTERFACE -Werror)
endif()
# If the enclosing project sets neither a build type nor an optimisation level, uses -O2.
if(NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
  target_compile_options(viete_compile INTERFACE $<$<STREQUAL:$<CONFIG>,>:-O2>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Warnings of GCC's optimiser: each version gives other ones for correct code. The sanitizers find real faults.
  target_compile_options(viete_compile INTERFACE
    -Wno-array-bounds -Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
  # GCC collects its garbage less often: compiles in seven eighths of the time, with up to 0.4 GB more memory per compiler.
  target_compile_options(viete_compile INTERFACE --param=ggc-min-heapsize=1000000)
endif()
if(VIETE_SANITIZE)
  target_compile_options(viete_compile INTERFACE -fsanitize=${VIETE_SANITIZE} -fno-omit-frame-pointer -g1)
  target_link_options(viete_compile INTERFACE -fsanitize=${VIETE_SANITIZE})
endif()

# GCC 12 vectorises loops only at -O3. With sanitizers, -O3 takes minutes per file and finds no more errors.
set(VIETE_KERNEL_OPTIONS "")
if(NOT VIETE_SANITIZE)
  set(VIETE_KERNEL_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O3>)
elseif(VIETE_SANITIZE MATCHES address)
  # Use-after-scope checks take GCC fifteen minutes per unrolled kernel.
  set(VIETE_KERNEL_OPTIONS -fno-sanitize-address-use-after-scope)
endif()
# Rooms that compute: as kernels, unless the flags set an optimisation level.
set(VIETE_FASTEST "")
if(NOT VIETE_SANITIZE AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
  set(VIETE_FASTEST ${VIETE_KERNEL_OPTIONS})
endif()

# Highway's NEON code needs AES. Highway turns AES on for a part of each file, but GCC places some
# constructors outside this part. This option turns AES on for the whole file.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  list(APPEND VIETE_KERNEL_OPTIONS -march=armv8-a+crypto)
endif()

# `all` compiles kernels for all instruction sets; the program selects the best set at run time. `native`
# compiles only the set of this machine: in half the time, but the program only runs on similar machines.
set(VIETE_KERNELS all CACHE STRING "Instruction sets of the kernels: all or native")
set_property(CACHE VIETE_KERNELS PROPERTY STRINGS all native)
if(NOT VIETE_KERNELS MATCHES "^(all|native)$")
  message(FATAL_ERROR "VIETE_KERNELS is \"${VIETE_KERNELS}\": use all or native")
endif()
set(VIETE_KERNELS_LEFT_OUT 0)
if(VIETE_KERNELS STREQUAL native AND NOT CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null
    OUTPUT_VARIABLE macros RESULT_VARIABLE failed ERROR_QUIET)
  if(failed)
    message(STATUS "VIETE_KERNELS: the compiler does not know this processor; compiling all kernels")
  elseif(macros MATCHES "__AVX512VL__" AND macros MATCHES "__AVX512DQ__" AND macros MATCHES "__AVX512BW__")
    set(VIETE_KERNELS_LEFT_OUT HWY_AVX2)
  elseif(macros MATCHES "__AVX2__" AND macros MATCHES "__FMA__" AND macros MATCHES "__BMI2__")
    set(VIETE_KERNELS_LEFT_OUT HWY_AVX3)
  endif()
endif()

# Marks sources as kernels. Highway compiles each kernel once per instruction set, outside unity batches.
function(viete_kernels)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS "${VIETE_KERNEL_OPTIONS}")
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_DEFINITIONS "VIETE_KERNELS_LEFT_OUT=${VIETE_KERNELS_LEFT_OUT}")
  set_property(SOURCE ${ARGN} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
  set_property(GLOBAL APPEND PROPERTY VIETE_KERNEL_SOURCES ${ARGN})  # for tests/rules
endfunction()

# Compiles the sources of a room as one unit. This halves the build time: each header is read only once.
option(VIETE_UNITY "Compile the sources of a room as one unit" ON)

# Lowers the optimisation of targets without heavy computation. Compiling takes two thirds of the time.
function(viete_quickly_compiled target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# No optimisation, for tests: compiles in half the time.
function(viete_test_code target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O0>)
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)  # an empty std::optional fails a test everywhere
endfunction()

# `unity`: compiles the sources of the target as one unit. `quick`: lowers the optimisation.
function(viete_compiled target unity quick)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  if(unity AND VIETE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
  if(quick)
    viete_quickly_compiled(${target})
  endif()
endfunction()

# viete_room(deform [UNITY] [QUICK] SOURCES a.cpp ... QUICK_SOURCES b.cpp ... USES viete::mesh ... PRIVATE_USES dep::eigen ...)
# makes target viete::deform with include prefix "deform/". UNITY: compiles sources as one unit; their internal
# names must not collide. QUICK, QUICK_SOURCES: lower optimisation for the room or for some of its sources.
function(viete_room room)
  cmake_parse_arguments(ARG "UNITY;QUICK" "" "SOURCES;QUICK_SOURCES;USES;PRIVATE_USES" ${ARGN})
  # Private dependencies are not exported.
  list(TRANSFORM ARG_PRIVATE_USES REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  add_library(viete_${room} STATIC ${ARG_SOURCES})
  add_library(viete::${room} ALIAS viete_${room})
  set_target_properties(viete_${room} PROPERTIES EXPORT_NAME ${room})
  viete_compiled(viete_${room} ${ARG_UNITY} ${ARG_QUICK})
  target_include_directories(viete_${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_compile_features(viete_${room} PUBLIC cxx_std_20)
  target_link_libraries(viete_${room} PUBLIC ${ARG_USES} PRIVATE ${ARG_PRIVATE_USES} $<BUILD_INTERFACE:viete_compile>)
  if(ARG_QUICK_SOURCES)
    add_library(viete_${room}_quick OBJECT ${ARG_QUICK_SOURCES})
    viete_compiled(viete_${room}_quick ${ARG_UNITY} ON)
    target_include_directories(viete_${room}_quick PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(viete_${room}_quick PRIVATE ${ARG_USES} ${ARG_PRIVATE_USES} viete_compile)
    target_sources(viete_${room} PRIVATE $<TARGET_OBJECTS:viete_${room}_quick>)
  endif()
endfunction()

# viete_public_headers(sym3 exp.h ...): public headers of a room, included as <viete/sym3/exp.h> in an install and in the build.
# In both places, the headers include each other by such names.
function(viete_public_headers room)
  set(include_dir ${PROJECT_BINARY_DIR}/include)
  foreach(header IN LISTS ARGN)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${header})
    set(public ${include_dir}/viete/${room}/${header})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(READ ${source} text)
    string(REPLACE "#include \"${room}/" "#include \"viete/${room}/" text "${text}")
    file(CONFIGURE OUTPUT ${public} CONTENT "${text}" @ONLY)
    set_property(TARGET viete_${room} APPEND PROPERTY PUBLIC_HEADER ${public})
  endforeach()
  target_include_directories(viete_${room} INTERFACE $<BUILD_INTERFACE:${include_dir}>)
endfunction()
