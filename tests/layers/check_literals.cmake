# Finds small floating literals in the code of shapes: a tolerance has to be an error bound that
# the value carries, never a constant (docs/architecture.md). Powers of two in hexadecimal are
# ranges of the number format, not tolerances; comments may say what they like.
#   cmake -D SOURCE_DIR=<root> -P check_literals.cmake
cmake_minimum_required(VERSION 3.25)

file(GLOB files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/backend/geometry/*.?pp
  ${SOURCE_DIR}/backend/accel/*.?pp)
if(NOT files)
  message(FATAL_ERROR "no shape code below ${SOURCE_DIR}")
endif()

set(failures "")
foreach(file ${files})
  # As one string: semicolons and brackets would make a list of it.
  file(READ ${SOURCE_DIR}/${file} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  # 1e-4 and smaller exponents, and 0.000...: everything below 1e-3 that can be written in decimal.
  string(REGEX MATCHALL
    "[^A-Za-z0-9_.]([0-9]+\\.?[0-9]*|\\.[0-9]+)[eE]-(0*[4-9]|0*[1-9][0-9]+)|[^A-Za-z0-9_.]0?\\.000[0-9]*"
    found "${text}")
  if(found)
    list(APPEND failures "${file}: ${found}")
  endif()
endforeach()

if(failures)
  list(JOIN failures "\n  " text)
  message(FATAL_ERROR "absolute epsilon in shape code:\n  ${text}")
endif()
list(LENGTH files count)
message(STATUS "${count} files of shape code hold no absolute epsilon")
