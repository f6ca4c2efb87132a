# SPDX-License-Identifier: GPL-3.0-or-later

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Boost REQUIRED) # headers only
find_package(Threads REQUIRED)
find_package(PNG REQUIRED)

# libharu writes the pattern's PDF; it has no package file for CMake.
find_path(HARU_INCLUDE_DIR hpdf.h REQUIRED DOC "The folder of libharu's hpdf.h")
find_library(HARU_LIBRARY NAMES hpdf hpdfs libhpdf REQUIRED DOC "The library libharu")
add_library(dcharts_haru INTERFACE)
target_include_directories(dcharts_haru SYSTEM INTERFACE ${HARU_INCLUDE_DIR})
target_link_libraries(dcharts_haru INTERFACE ${HARU_LIBRARY})

if(DCHARTS_PLUGIN_PYMESHLAB OR DCHARTS_PLUGIN_2025 OR DCHARTS_PLUGIN_2020)
  find_package(Qt5 REQUIRED COMPONENTS Core Gui Widgets Xml OpenGL)
endif()
if(DCHARTS_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
