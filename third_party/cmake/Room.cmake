# How every target of the project is compiled, and how a room becomes a library.

# Contraction is off everywhere: a*b+c means two roundings unless fma is written out, so that results
# are the same at every optimisation level, in every kernel and on every machine.
add_library(viete_compile INTERFACE)
target_compile_features(viete_compile INTERFACE cxx_std_20)
target_compile_options(viete_compile INTERFACE
  -Wall -Wextra -Wconversion -Wno-sign-conversion -ffp-contract=off)
# GCC 12 warns of std::string's own + (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(viete_compile INTERFACE -Wno-restrict)
endif()
if(VIETE_SANITIZE)
  target_compile_options(viete_compile INTERFACE -fsanitize=${VIETE_SANITIZE} -fno-omit-frame-pointer -g1)
  target_link_options(viete_compile INTERFACE -fsanitize=${VIETE_SANITIZE})
endif()

# Kernels are vectorised at -O3 only (GCC 12); their bits are the same at every level. Under a sanitizer that takes
# minutes a file and finds no more.
set(VIETE_KERNEL_OPTIONS "")
if(NOT VIETE_SANITIZE)
  set(VIETE_KERNEL_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O3>)
elseif(VIETE_SANITIZE MATCHES address)
  # Following the lifetime of every register of an unrolled kernel takes GCC a quarter of an hour a file.
  set(VIETE_KERNEL_OPTIONS -fno-sanitize-address-use-after-scope)
endif()

# Several sources of a room are compiled as one: headers are read once, which halves the time of the whole build.
option(VIETE_UNITY "Compile the sources of the rooms that allow it in batches" ON)

# viete_room(deform [UNITY] SOURCES a.cpp ... USES viete::mesh ... PRIVATE_USES dep::eigen ...)
# makes target viete::deform with include prefix "deform/". UNITY: no two of its sources use a name for two things.
function(viete_room room)
  cmake_parse_arguments(ARG "UNITY" "" "SOURCES;USES;PRIVATE_USES" ${ARGN})
  # What a library uses inside is no business of who finds it installed.
  list(TRANSFORM ARG_PRIVATE_USES REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  add_library(viete_${room} STATIC ${ARG_SOURCES})
  add_library(viete::${room} ALIAS viete_${room})
  set_target_properties(viete_${room} PROPERTIES EXPORT_NAME ${room} CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  if(ARG_UNITY AND VIETE_UNITY)
    set_target_properties(viete_${room} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
  target_include_directories(viete_${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_compile_features(viete_${room} PUBLIC cxx_std_20)
  target_link_libraries(viete_${room} PUBLIC ${ARG_USES} PRIVATE ${ARG_PRIVATE_USES} $<BUILD_INTERFACE:viete_compile>)
endfunction()
