# SPDX-License-Identifier: GPL-3.0-or-later
# How everything is compiled. The target dcharts_options carries what is only for our own code, such as warnings.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Templates of vcglib and Eigen are compiled into host and plugin alike, with other types and flags: keep ours to us.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

# Eigen's own threads would make sums depend on their number.
add_compile_definitions(EIGEN_DONT_PARALLELIZE)

if(WIN32)
  add_compile_definitions(NOMINMAX) # else its headers take the names min and max
endif()

add_library(dcharts_options INTERFACE)
if(MSVC)
  add_compile_options(/bigobj /utf-8) # templates of Eigen make many sections; texts in the code are UTF-8
  target_compile_options(dcharts_options INTERFACE /W4 /permissive- /fp:precise)
else()
  # No fused multiply-add: the same input gives the same bytes whatever the processor has.
  add_compile_options(-ffp-contract=off)
  target_compile_options(dcharts_options INTERFACE -Wall -Wextra -Wshadow)
endif()

if(DCHARTS_SANITIZE)
  add_compile_options(-fsanitize=${DCHARTS_SANITIZE} -fno-omit-frame-pointer)
  # These four checks at every access to memory double the time to compile; where they matter most, address tells too.
  if(DCHARTS_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  endif()
  add_link_options(-fsanitize=${DCHARTS_SANITIZE})
endif()

if(DCHARTS_LIBFUZZER)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "DCHARTS_LIBFUZZER needs Clang: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
