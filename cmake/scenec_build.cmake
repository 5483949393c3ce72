# Compiler settings shared by every target, and the rule "a folder is a library".

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

find_program(SCENEC_CCACHE ccache)
if(SCENEC_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SCENEC_CCACHE})
endif()

add_library(scenec_options INTERFACE)
# No fused multiply-add behind our back and no fast-math: watertight kernels and equal bytes on
# every CPU depend on it (docs/decisions, numerics rules).
target_compile_options(scenec_options INTERFACE
  -ffp-contract=off -fno-fast-math
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor
  -Wold-style-cast -Woverloaded-virtual -Wnull-dereference -Wimplicit-fallthrough -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports false positives of these from inlined library code.
  target_compile_options(scenec_options INTERFACE
    -Wno-null-dereference -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized
    -Wno-stringop-overread -Wno-dangling-pointer)
endif()
if(SCENEC_SANITIZE)
  target_compile_options(scenec_options INTERFACE -fsanitize=${SCENEC_SANITIZE} -fno-omit-frame-pointer -g)
  target_link_options(scenec_options INTERFACE -fsanitize=${SCENEC_SANITIZE})
endif()
if(SCENEC_FUZZ)
  # Coverage for libFuzzer in every library; a finding of a sanitizer ends the run.
  # clang sees inside libstdc++ that some of it is deprecated.
  target_compile_options(scenec_options INTERFACE
    -fsanitize=fuzzer-no-link -fno-sanitize-recover=all -Wno-deprecated-declarations)
endif()

# Third-party headers are system headers: their warnings are not ours.
function(scenec_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(NOT sources)  # a folder that has no code yet
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp "")
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  endif()
  add_library(scenec_${name} STATIC ${sources})
  target_include_directories(scenec_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(scenec_${name} PUBLIC scenec_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
